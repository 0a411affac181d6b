//! `deictic`: the host bridge of the gesture unit.

use std::process::ExitCode;

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
    Run(cmd::run::Run),
    Play(cmd::play::Play),
    Scene(cmd::scene::Scene),
    Setups(cmd::setups::Setups),
}

fn main() -> miette::Result<ExitCode> {
    match Cli::parse().command {
        Command::Decide(decide) => decide.run()?,
        Command::Run(run) => return run.run().map(ExitCode::from),
        Command::Play(play) => play.run()?,
        Command::Scene(scene) => scene.run()?,
        Command::Setups(setups) => setups.run()?,
    }
    Ok(ExitCode::SUCCESS)
}
