//! `deictic-eval`: see `--help`.

mod cmd;

use clap::Parser;

/// The paper's experiments with Deictic's core.
#[derive(Parser)]
#[command(version, propagate_version = true)]
struct Args {
    #[command(subcommand)]
    command: cmd::Command,
}

fn main() -> anyhow::Result<()> {
    Args::parse().command.run()
}
