//! `deictic gestures aim`: how a person aims.

use std::path::PathBuf;
use std::time::Duration;

use clap::{ArgGroup, Args};
use deictic_core::category::Category;
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::message::Configuration;
use miette::{IntoDiagnostic, Result, WrapErr};

use super::files::Files;
use super::sensing::drain;
use super::{advice, counted, paint};
use crate::diagnose::quoted;
use crate::explain;
use crate::hand::aim::{Aimed, Pointings, aim, write};
use crate::hand::source::{Address, Source};
use crate::link;
use crate::scene::Tabletop;
use crate::unit::{Event, GestureUnit};
use crate::vocabulary::Lexicon;

/// Find out how one person aims
///
/// ```text
/// $ deictic gestures aim cup can cube drawer --hand leap --scene desk.toml --out anna.aim
/// $ deictic run --board qemu --hand leap --scene desk.toml --aim anna.aim
///
/// $ deictic gestures aim cup can cube drawer --board serial:/dev/ttyACM0 --out anna.aim
/// $ deictic run --board serial:/dev/ttyACM0 --aim anna.aim
/// ```
///
/// The second way is that of a sensor on the unit's own line: the unit passes on what it sees.
///
/// The person points at these things of the scene, one after the other, for a second each, and closes
/// the hand, or takes it away, in between. What is found goes in place of the scene's `[sensor]`. Three
/// things are enough, six are better, far apart from each other.
#[derive(Args, Clone, Debug)]
#[command(verbatim_doc_comment, group(ArgGroup::new("eyes").required(true).args(["hand", "board"])))]
pub(super) struct Aim {
    /// What to point at, in this order
    #[arg(value_name = "THING", required = true)]
    things: Vec<String>,
    /// The hand sensor at this machine: leap, mediapipe:FILE, file:RECORDING, or a made-up person
    #[arg(long, value_name = "SENSOR")]
    hand: Option<Address>,
    /// The unit whose own sensor sees the hand: serial:PORT@BAUD, tcp:HOST:PORT, can:INTERFACE, qemu:SENSOR-PORT
    #[arg(long, value_name = "ADDRESS")]
    board: Option<link::Address>,
    #[command(flatten)]
    files: Files,
    /// Where to write the aim (TOML)
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

impl Aim {
    /// Runs the command.
    ///
    /// # Errors
    /// A report with what was wrong and what to do.
    pub fn run(self) -> Result<()> {
        let (lexicon, table) = self.files.read()?;
        let targets: Vec<[f32; 3]> = self
            .things
            .iter()
            .map(|name| place(name, &table, &lexicon))
            .collect::<Result<_>>()?;
        let mut eyes = self.open(&table, &lexicon)?;
        let mut pointings = Pointings::new(&table, &lexicon);
        let mut pointed = Vec::new();
        self.ask(0);
        let mut more = true;
        while more && pointed.len() < targets.len() {
            let before = pointed.len();
            more = eyes.look(|sample| {
                if let (Some(ray), Some(target)) =
                    (pointings.push(&sample), targets.get(pointed.len()))
                {
                    pointed.push((ray, *target));
                }
            })?;
            if pointed.len() > before {
                self.ask(pointed.len());
            }
        }
        let Aimed { settings, turned } =
            aim(table.hand(), &pointed).map_err(|e| advice(&e, e.remedy()))?;
        let out = self.out.display().to_string();
        let text = write(&settings).into_diagnostic()?;
        std::fs::write(&self.out, text)
            .into_diagnostic()
            .wrap_err_with(|| format!("cannot write {out}"))?;
        anstream::println!(
            "{} pointed at: turned by {:.1} degrees, misses by {:.1} degrees: {out}",
            counted(pointed.len(), "thing"),
            turned.to_degrees(),
            settings.aim.sigma.to_degrees()
        );
        Ok(())
    }

    fn open(&self, table: &Tabletop, lexicon: &Lexicon) -> Result<Eyes> {
        if let Some(address) = &self.hand {
            return Ok(Eyes::Here(Source::open(address, table, lexicon)?));
        }
        let board = self.board.clone().unwrap_or(link::Address::Inside);
        let configuration = Configuration::DEFAULT;
        let (vocabulary, scene) = (lexicon.vocabulary(), table.scene());
        let mut unit = GestureUnit::connect(&board, vocabulary, scene, configuration)?;
        unit.relay()?;
        Ok(Eyes::Unit(Box::new(unit)))
    }

    fn ask(&self, number: usize) {
        if let Some(name) = self.things.get(number) {
            anstream::println!("point at {}, then close the hand", paint::good(name));
        }
    }
}

/// Where samples come from.
enum Eyes {
    /// A sensor at this machine.
    Here(Source),
    /// A unit that passes on what its own sensor sends.
    Unit(Box<GestureUnit>),
}

impl Eyes {
    /// Takes what has come, waiting for a moment; `false` when there will be no more.
    fn look(&mut self, mut take: impl FnMut(Sample)) -> Result<bool> {
        let odd = |what: String| anstream::eprintln!("{}", paint::bad(what));
        let unit = match self {
            Self::Here(source) => {
                let more = drain(source, take, |error| odd(error.to_string()));
                std::thread::sleep(Duration::from_millis(2));
                return Ok(more);
            }
            Self::Unit(unit) => unit,
        };
        for event in unit.poll(Duration::from_millis(5)) {
            match event {
                Event::Sample(sample) => take(*sample),
                Event::Fault(fault) => odd(explain::fault(&fault).what),
                Event::Lost(loss) => {
                    let lost = explain::loss(&loss);
                    return Err(advice(lost.what, lost.remedy));
                }
                _ => {}
            }
        }
        Ok(true)
    }
}

fn place(name: &str, table: &Tabletop, lexicon: &Lexicon) -> Result<[f32; 3]> {
    let thing = [Category::OBJECT, Category::STORAGE]
        .into_iter()
        .find_map(|category| table.find(category, lexicon.option(category, name)?));
    thing.map(|thing| thing.position).ok_or_else(|| {
        let things = table.scene().entities().iter();
        let names: Vec<String> = things
            .map(|t| lexicon.option_name(t.category, t.option))
            .collect();
        advice(
            format!("there is no \"{name}\" on the table"),
            format!("there are {}", quoted(names.iter().map(String::as_str))),
        )
    })
}
