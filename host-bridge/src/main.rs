//! `deictic`: the host bridge of the gesture unit.

use clap::{Parser, Subcommand};
use deictic::cmd;

/// Tell and show a robot what to do
#[derive(Parser)]
#[command(version, about, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Decide(cmd::decide::Decide),
    Setups(cmd::setups::Setups),
}

fn main() -> miette::Result<()> {
    match Cli::parse().command {
        Command::Decide(decide) => decide.run(),
        Command::Setups(setups) => setups.run(),
    }
}
