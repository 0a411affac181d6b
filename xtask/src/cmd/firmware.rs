use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use crate::board::{self, Board};
use crate::cmd::setup;

/// Build the unit's release images and print where they are.
#[derive(Args)]
pub struct Firmware {
    /// Only this board's
    #[arg(long)]
    board: Option<Board>,
    /// With this key (`cargo xtask key` makes one), beside the plain ones
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
}

impl Firmware {
    pub fn run(self) -> Result<()> {
        let toolchain = setup::ensure()?;
        for board in Board::ALL {
            if self.board.is_none_or(|only| only == board) {
                let image = match &self.key {
                    None => board::build(&toolchain, board)?,
                    Some(key) => board::build_keyed(&toolchain, board, &key.canonicalize()?)?,
                };
                println!("{}", image.display());
            }
        }
        Ok(())
    }
}
