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
}

impl Firmware {
    pub fn run(self) -> Result<()> {
        let toolchain = setup::ensure()?;
        for board in Board::ALL {
            if self.board.is_none_or(|only| only == board) {
                println!("{}", board::build(&toolchain, board)?.display());
            }
        }
        Ok(())
    }
}
