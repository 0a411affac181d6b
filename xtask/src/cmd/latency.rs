use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};
use clap::Args;
use serde::Deserialize;

use crate::cmd::can::build;
use crate::guest::{self, INTERFACE};
use crate::process;

/// Measure how soon a decision that leaves the unit is accepted by a robot, over every link.
///
/// Prints the median, the 99th percentile and the longest, in microseconds, of all of it and of the bridge's own share:
/// from the decision's last byte to the command's first, and from the acceptance's last byte to the session's saying
/// so. The unit and the robot are in the same process, so a link's time is that of this kernel's ends of it. CAN is
/// measured on an interface of this machine, or in a Linux of its own, whose clock and scheduler are then part of it.
#[derive(Args)]
pub struct Latency {
    /// Commands over every link
    #[arg(long, default_value_t = 10_000)]
    commands: u32,
    /// Print lines of JSON, for programs
    #[arg(long)]
    json: bool,
}

const TEST: &str = "robot_latency";

/// What the test prints of a link.
#[derive(Deserialize)]
struct Told {
    link: String,
    p50: u64,
    p99: u64,
    longest: u64,
    bridge_p50: u64,
    bridge_p99: u64,
    bridge_longest: u64,
}

impl Latency {
    pub fn run(self) -> Result<()> {
        let test = build(&[TEST], &["--release"])?
            .pop()
            .context("no test was built")?;
        let here = |can: bool| {
            let mut command = Command::new(&test);
            command.args(["--nocapture", "--test-threads", "1"]);
            command.env("DEICTIC_COMMANDS", self.commands.to_string());
            command.envs(can.then_some(("DEICTIC_CAN", INTERFACE)));
            let output = command.stderr(Stdio::inherit()).output()?;
            ensure!(output.status.success(), "the measurement failed");
            Ok(String::from_utf8_lossy(&output.stdout).into_owned())
        };
        self.print(&here(false)?)?;
        if !guest::is_possible() {
            eprintln!("skipped can:{INTERFACE}: {}", guest::MISSING);
        } else if guest::has_can() {
            self.print(&here(true)?)?;
        } else {
            let lines = format!(
                "export DEICTIC_CAN={INTERFACE} DEICTIC_COMMANDS={}\n'{}' --nocapture --test-threads 1",
                self.commands,
                test.display()
            );
            // A command takes a few milliseconds, and a guest on a busy machine several times that.
            self.print(&guest::run(&lines, None, 120 + self.commands / 20)?)?;
        }
        Ok(())
    }

    fn print(&self, printed: &str) -> Result<()> {
        let told = printed
            .lines()
            .filter_map(|line| line.find('{').and_then(|at| line.get(at..)))
            .filter(|line| line.contains(r#""event":"latency""#));
        if self.json {
            told.for_each(|line| println!("{line}"));
            return Ok(());
        }
        let head = [
            "link",
            "p50",
            "p99",
            "longest",
            "bridge p50",
            "bridge p99",
            "bridge longest",
        ];
        let mut table = vec![head.map(str::to_owned).to_vec()];
        for line in told {
            let Told {
                link,
                p50,
                p99,
                longest,
                bridge_p50,
                bridge_p99,
                bridge_longest,
            } = serde_json::from_str(line)?;
            let figures = [p50, p99, longest, bridge_p50, bridge_p99, bridge_longest];
            let figures = figures.map(|us| us.to_string());
            table.push(std::iter::once(link).chain(figures).collect());
        }
        process::print_columns(&table);
        Ok(())
    }
}
