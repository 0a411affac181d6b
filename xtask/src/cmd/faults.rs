use anyhow::Result;
use clap::Args;

use crate::process::{self, cargo};

/// Play sessions over lines that lose, damage, cut, double, delay and overtake frames, with boards that restart and
/// robots that die, and send damaged frames; stop at the first that breaks what must hold.
///
/// Everything follows from the seed. The rules are in tests/src/network/trial.rs.
#[derive(Args)]
pub struct Faults {
    /// How many sessions.
    #[arg(long, default_value_t = 100_000)]
    sessions: u64,
    /// How many damaged frames.
    #[arg(long, default_value_t = 1_000_000)]
    frames: u64,
    /// The first session's seed; the others count up from it.
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

impl Faults {
    pub fn run(self) -> Result<()> {
        let mut faults = cargo();
        faults.args([
            "run",
            "--quiet",
            "--release",
            "--package",
            "deictic-tests",
            "--bin",
            "faults",
            "--",
        ]);
        faults.args([self.sessions, self.frames, self.seed].map(|n| n.to_string()));
        process::run(&mut faults)
    }
}
