use std::collections::BTreeMap;

use anyhow::{Result, bail};
use clap::Args;
use serde::Serialize;

use crate::board::{self, Board};
use crate::budget::{self, Figures, Golden, Image, WorstCase};
use crate::cmd::setup;
use crate::toolchain::Toolchain;

/// Measure the unit's image against its golden figures: flash, RAM, worst-case stack, instructions of a decision, of the
/// dearest frame of a hand, and of saying and hearing a frame, sealed and not.
///
/// Fails when a figure is above its golden one (tests/expected/budget-BOARD-COMPILER.json) or above what the project
/// promises. Instructions are counted in QEMU, where 1 takes 1024 ns of the board's time; the rest is read from the
/// image. Whole conversations with the image in QEMU, its stack painted, must stay within the static figure of the stack. With --json: {"flash_bytes": n, "ram_bytes": n, "stack_bytes": n, "instructions": {"hand": n, "m3": n, ...},
/// ...}.
#[derive(Args)]
pub struct Budget {
    /// Whose image
    #[arg(long, default_value = "mps2-an386")]
    board: Board,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Record the figures as the golden ones
    #[arg(long)]
    bless: bool,
}

/// Everything `--json` prints.
#[derive(Serialize)]
struct Report {
    board: &'static str,
    toolchain: String,
    #[serde(flatten)]
    figures: Figures,
    stack: WorstCase,
    /// The most stack that whole conversations used, where they can be held.
    high_water_bytes: Option<u32>,
    assumptions: &'static [&'static str],
    golden: Option<Figures>,
    limits: Figures,
}

/// What the names of the seal's functions contain.
const SEAL: [&str; 4] = [
    "hmac::",
    "sha2::",
    "protocol::seal::",
    "protocol::lock::opened",
];

/// What the stack's figure rests on besides the machine code.
const ASSUMPTIONS: &[&str] = &[
    "interrupts keep the one priority they have after reset, so one handler runs at a time",
    "a faulting handler, then an NMI, on top of the deepest interrupt on top of the deepest path",
    "the mapping symbols tell code from data",
];

impl Budget {
    pub fn run(self) -> Result<()> {
        let toolchain = setup::ensure()?;
        let report = Report::measure(&toolchain, self.board)?;
        if self.bless {
            Golden::new(self.board, &toolchain.label()).write(&report.figures)?;
        }
        if self.json {
            println!("{}", serde_json::to_string_pretty(&report)?);
        } else {
            report.print();
        }
        report.judge(self.bless)
    }

    /// Both boards, for `cargo xtask test`.
    pub fn check(toolchain: &Toolchain) -> Result<()> {
        for board in Board::ALL {
            let report = Report::measure(toolchain, board)?;
            report.print();
            report.judge(false)?;
        }
        Ok(())
    }
}

impl Report {
    fn measure(toolchain: &Toolchain, board: Board) -> Result<Self> {
        let path = board::build(toolchain, board)?;
        let image = Image::read(&path)?;
        let stack = budget::worst_case(&image);
        let (instructions, high_water_bytes) = match board {
            Board::Mps2An386 => (budget::count(toolchain)?, Some(budget::high_water(&path)?)),
            Board::NucleoG474re => (BTreeMap::new(), None),
        };
        Ok(Self {
            board: board.name(),
            toolchain: toolchain.label(),
            figures: Figures {
                flash_bytes: image.flash_bytes,
                ram_bytes: image.ram_bytes,
                stack_bytes: u64::from(stack.bytes),
                seal_flash_bytes: image.bytes_of(&SEAL),
                instructions,
            },
            stack,
            high_water_bytes,
            assumptions: ASSUMPTIONS,
            golden: Golden::new(board, &toolchain.label()).read()?,
            limits: Figures::limits(),
        })
    }

    fn print(&self) {
        println!("{} under {}", self.board, self.toolchain);
        println!("  {:<28} {:>9} {:>9} {:>9}", "", "now", "golden", "limit");
        for (name, now) in self.figures.named() {
            let show =
                |figure: Option<u64>| figure.map_or("-".to_owned(), |figure| figure.to_string());
            let golden = show(self.golden.as_ref().and_then(|golden| golden.get(&name)));
            println!(
                "  {name:<28} {now:>9} {golden:>9} {:>9}",
                show(self.limits.get(&name))
            );
        }
        if let Some(used) = self.high_water_bytes {
            println!("  {:<28} {used:>9}", "stack used in conversations");
        }
        println!("  worst-case stack:");
        for (title, path) in [
            ("loop", &self.stack.thread),
            ("interrupt", &self.stack.interrupt),
            ("HardFault", &self.stack.hard_fault),
            ("NMI", &self.stack.nmi),
        ] {
            println!("    {:>5} {title}", path.bytes);
            for (name, bytes) in &path.calls {
                println!("      {bytes:>5} {name}");
            }
        }
        for blind_spot in &self.stack.blind_spots {
            println!("    not covered: {blind_spot}");
        }
    }

    /// Fails on any figure above its golden one or its limit, and on stack that was not covered.
    fn judge(&self, blessed: bool) -> Result<()> {
        let mut over = Vec::new();
        if let Some(used) = self.high_water_bytes
            && u64::from(used) > self.figures.stack_bytes
        {
            over.push(format!(
                "conversations use {used} bytes of stack, more than the {} of the static figure",
                self.figures.stack_bytes
            ));
        }
        for (name, now) in self.figures.named() {
            let golden = self.golden.as_ref().and_then(|golden| golden.get(&name));
            match (golden, self.limits.get(&name)) {
                (_, Some(limit)) if now > limit => {
                    over.push(format!("{name} is {now}, above the limit {limit}"))
                }
                (Some(golden), _) if now > golden && !blessed => {
                    over.push(format!("{name} is {now}, above the golden {golden}"));
                }
                (Some(golden), _) if now < golden && !blessed => {
                    eprintln!(
                        "{name} is {now}, below the golden {golden}: record it with `cargo xtask budget --bless`"
                    );
                }
                _ => {}
            }
        }
        over.extend(
            self.stack
                .blind_spots
                .iter()
                .map(|spot| format!("the stack figure misses: {spot}")),
        );
        if self.golden.is_none() && !blessed {
            eprintln!(
                "{} has no golden figures under {}: only the limits were checked",
                self.board, self.toolchain
            );
        }
        if !over.is_empty() {
            bail!(
                "{}:\n  {}\nMake it smaller, or record the new figures with `cargo xtask budget --board {} --bless` and \
                 say why in the commit",
                self.board,
                over.join("\n  "),
                self.board
            );
        }
        Ok(())
    }
}
