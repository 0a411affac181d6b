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
    Understand(cmd::understand::Understand),
    Run(Box<cmd::run::Run>),
    Play(cmd::play::Play),
    Scene(cmd::scene::Scene),
    Setups(cmd::setups::Setups),
    Hand(cmd::hand::Hand),
    Gestures(cmd::gestures::Gestures),
    RobotSim(cmd::robot_sim::RobotSim),
}

fn main() -> miette::Result<ExitCode> {
    let json = std::env::args_os().any(|argument| argument == "--json");
    match Cli::parse().command.run() {
        Err(report) if json => {
            let help = report.help().map(|help| help.to_string());
            let error = serde_json::json!({ "error": report.to_string(), "remedy": help });
            anstream::println!("{error}");
            Ok(ExitCode::FAILURE)
        }
        result => result,
    }
}

impl Command {
    fn run(self) -> miette::Result<ExitCode> {
        match self {
            Self::Decide(decide) => decide.run()?,
            Self::Understand(understand) => understand.run()?,
            Self::Run(run) => return run.run().map(ExitCode::from),
            Self::Play(play) => play.run()?,
            Self::Setups(setups) => setups.run()?,
            Self::RobotSim(robot_sim) => robot_sim.run()?,
            Self::Scene(scene) => scene.run()?,
            Self::Hand(hand) => hand.run()?,
            Self::Gestures(gestures) => gestures.run()?,
        }
        Ok(ExitCode::SUCCESS)
    }
}
