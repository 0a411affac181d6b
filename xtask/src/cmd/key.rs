use std::fs::{self, File, OpenOptions};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;

use crate::process;

/// Make a key for one board, or one robot.
///
/// `DEICTIC_KEY=FILE cargo run --release ...` in firmware/ flashes the board with it, and `deictic run --key FILE` shows
/// to have it; a robot's goes to `deictic robot-sim --key FILE` and `deictic run --robot-key FILE`. Each gets one of its
/// own. An existing file is not overwritten.
#[derive(Args)]
pub struct MakeKey {
    /// Where to put it
    file: PathBuf,
}

impl MakeKey {
    pub fn run(self) -> Result<()> {
        make(&self.file)?;
        let path = fs::canonicalize(&self.file)?;
        println!(
            "of a board, flash it: DEICTIC_KEY={} cargo run --release --features nucleo-g474re --bin nucleo-g474re",
            path.display()
        );
        println!(
            "      and use it:      deictic run --key {}",
            path.display()
        );
        println!(
            "or of a robot: deictic robot-sim --key {0}, and deictic run --robot-key {0}",
            path.display()
        );
        Ok(())
    }
}

/// Makes a key in a file that is not there yet, and that its owner alone may read.
pub fn make(path: &Path) -> Result<()> {
    let mut bytes = [0_u8; 32];
    File::open("/dev/urandom")
        .and_then(|mut random| random.read_exact(&mut bytes))
        .context("there are no random numbers at /dev/urandom")?;
    let digits: String = bytes.iter().map(|b| format!("{b:02x}")).collect();
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let mut file = options
        .open(path)
        .with_context(|| format!("cannot make {}", path.display()))?;
    Ok(writeln!(file, "{digits}")?)
}

/// The key of this checkout's trials, made when it is first asked for.
pub fn for_trials() -> Result<PathBuf> {
    let path = process::target().join("trial.key");
    if !path.is_file() {
        make(&path)?;
    }
    Ok(path)
}
