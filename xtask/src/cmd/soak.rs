use anyhow::Result;
use clap::Args;

use crate::board;
use crate::cmd::setup;
use crate::process::{self, cargo};

/// Operate the unit's image in QEMU for long, its time passing 25 times as fast as ours, under faults of the line, the
/// board, the robot, the table and the clocks.
///
/// Every command must end in one way that is told, the robot do nothing that was not told once on the scene that was
/// there, the unit's statistics be what it has said, and the memory of this end stay what it was. The faults follow from
/// the seed; when they meet a command does not, as the emulation runs beside this machine's other work.
#[derive(Args)]
pub struct Soak {
    /// How long, in minutes of the board's time
    #[arg(long, default_value_t = 60)]
    minutes: u64,
    /// What the faults follow from
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

impl Soak {
    pub fn run(self) -> Result<()> {
        let image = board::build_hasty(&setup::ensure()?)?;
        let mut soak = cargo();
        soak.args(["run", "--quiet", "--release", "--package", "deictic-tests"]);
        soak.args(["--bin", "soak", "--"]);
        soak.args([self.minutes * 60, self.seed].map(|n| n.to_string()));
        soak.env("DEICTIC_IMAGE_HASTY", image);
        process::run(&mut soak)
    }
}
