use std::fs::{self, File, OpenOptions};
use std::io::{Read, Write};
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;

/// Make a key for one board.
///
/// `DEICTIC_KEY=FILE cargo run --release ...` in firmware/ flashes the board with it, and `deictic run --key FILE` shows
/// to have it. Every board gets one of its own. An existing file is not overwritten.
#[derive(Args)]
pub struct MakeKey {
    /// Where to put it
    file: PathBuf,
}

impl MakeKey {
    pub fn run(self) -> Result<()> {
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
            .open(&self.file)
            .with_context(|| format!("cannot make {}", self.file.display()))?;
        writeln!(file, "{digits}")?;
        let path = fs::canonicalize(&self.file)?;
        println!(
            "flash it: DEICTIC_KEY={} cargo run --release --features nucleo-g474re --bin nucleo-g474re",
            path.display()
        );
        println!("use it:   deictic run --key {}", path.display());
        Ok(())
    }
}
