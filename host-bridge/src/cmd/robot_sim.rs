//! `deictic robot-sim`: a simulated robot behind a link.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use deictic_core::command::seal::Refused;
use miette::{IntoDiagnostic, Result};
use serde_json::json;

use super::files::Files;
use super::trust::read;
use crate::link::Pair;
use crate::robot::end::{End, Listener, Served};
use crate::robot::sim::Sim;
use crate::robot::way::Way;

/// Serve a simulated robot over a link, for `deictic run --robot`
///
/// ```text
/// $ deictic robot-sim --listen can:vcan0 --key robot.key
/// $ deictic run --board inside --robot can:vcan0 --robot-key robot.key
/// ```
///
/// It does what the command set says (docs/robot.md): each command at most once, and nothing without
/// its host's heartbeat.
#[derive(Args, Clone, Debug)]
#[command(verbatim_doc_comment)]
pub struct RobotSim {
    /// Where: can:INTERFACE, can:INTERFACE,fd for CAN FD, slcan:PORT, serial:PORT, tcp:127.0.0.1:PORT, slcan:tcp:127.0.0.1:PORT;
    /// serial:pty and slcan:pty make a pseudo-terminal and name it
    #[arg(long, value_name = "ADDRESS")]
    listen: String,
    /// Listen only to a bridge that has this key, but for a halt: a file of 64 hexadecimal digits; `cargo xtask key`
    /// makes one
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
    /// How many times as fast as a careful arm it moves
    #[arg(long, default_value_t = 1.0, value_parser = super::haste, allow_negative_numbers = true)]
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
        let mut trust = "--insecure-robot".to_owned();
        if let Some(path) = &self.key {
            served = served.with_key(&read(path)?).into_diagnostic()?;
            trust = format!("--robot-key {}", path.display());
        }
        if self.json {
            println!("{}", json!({ "event": "listening", "address": address }));
        } else {
            println!(
                "the simulated robot listens: deictic run --board inside --robot {address} {trust}"
            );
        }
        let mut last = String::new();
        let (mut told, mut next) = (Refused::default(), Instant::now());
        loop {
            let failed = served.turn(Duration::from_millis(100));
            let refused = served.gate().refused();
            if refused != told && Instant::now() >= next {
                (told, next) = (refused, Instant::now() + TELL);
                self.tell(refused);
            }
            let Some(error) = failed else { continue };
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

impl RobotSim {
    /// Says how many messages were not taken so far.
    fn tell(&self, of: Refused) {
        let (unsealed, forged, replayed) = (of.unsealed, of.forged, of.replayed);
        if self.json {
            let refused = json!({
                "event": "refused", "unsealed": unsealed, "forged": forged, "replayed": replayed
            });
            println!("{refused}");
        } else {
            eprintln!(
                "messages not taken so far: {unsealed} in clear, {forged} with a wrong tag, {replayed} replayed"
            );
        }
    }
}

/// How often it is said at most how many messages were not taken.
const TELL: Duration = Duration::from_secs(1);

/// Tells this start from others.
fn boot() -> u16 {
    std::process::id() as u16
}
