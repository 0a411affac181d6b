//! `deictic robot-sim`: a simulated robot behind a link.

use std::time::Duration;

use clap::Args;
use miette::{IntoDiagnostic, Result};
use serde_json::json;

use super::files::Files;
use crate::link::Pair;
use crate::robot::end::{End, Listener, Served};
use crate::robot::sim::Sim;
use crate::robot::way::Way;

/// Serve a simulated robot over a link, for `deictic run --robot`
///
/// ```text
/// $ deictic robot-sim --listen can:vcan0
/// $ deictic run --board inside --robot can:vcan0
/// ```
///
/// It does what the command set says (docs/robot.md): each command at most once, and nothing without
/// its host's heartbeat.
#[derive(Args, Clone, Debug)]
#[command(verbatim_doc_comment)]
pub struct RobotSim {
    /// Where: can:INTERFACE, slcan:PORT, serial:PORT, tcp:127.0.0.1:PORT, slcan:tcp:127.0.0.1:PORT;
    /// serial:pty and slcan:pty make a pseudo-terminal and name it
    #[arg(long, value_name = "ADDRESS")]
    listen: String,
    /// How many times as fast as a careful arm it moves
    #[arg(long, default_value_t = 1.0)]
    haste: f32,
    #[command(flatten)]
    files: Files,
    /// Print JSON lines, for programs
    #[arg(long)]
    json: bool,
}

impl RobotSim {
    /// Serves until it is ended.
    ///
    /// # Errors
    /// A report with what was wrong and what to do.
    pub fn run(self) -> Result<()> {
        let (lexicon, table) = self.files.read()?;
        let listener = match self.listen.strip_suffix(":pty") {
            Some(kind @ ("serial" | "slcan")) => Listener::Pair {
                pair: Pair::open().into_diagnostic()?,
                adapter: kind == "slcan",
            },
            _ => Listener::open(&self.listen.parse::<Way>().into_diagnostic()?)?,
        };
        let address = listener.address();
        let end = End::new(Box::new(Sim::new(self.haste)), lexicon, boot())
            .with_measures(table.measures().clone());
        let mut served = Served::new(end, listener);
        if self.json {
            println!("{}", json!({ "event": "listening", "address": address }));
        } else {
            println!("the simulated robot listens: deictic run --board inside --robot {address}");
        }
        let mut last = String::new();
        loop {
            let Some(error) = served.turn(Duration::from_millis(100)) else {
                continue;
            };
            // One that cannot be opened fails again and again, and is told once.
            let error = crate::diagnose::in_full(&error);
            if error != last {
                if self.json {
                    println!("{}", json!({ "event": "link", "error": error }));
                } else {
                    eprintln!("the link: {error}");
                }
                last = error;
            }
        }
    }
}

/// Tells this start from others.
fn boot() -> u16 {
    std::process::id() as u16
}
