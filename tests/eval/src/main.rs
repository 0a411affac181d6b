//! `deictic-eval`: see `--help`.

mod cmd;

use std::process::ExitCode;

use clap::Parser;

/// The paper's experiments with Deictic's core.
#[derive(Parser)]
#[command(version, propagate_version = true)]
struct Args {
    #[command(subcommand)]
    command: cmd::Command,
}

fn main() -> ExitCode {
    // A reader that has seen enough (`| head`) ends the program, as it ends other tools.
    sigpipe::reset();
    match Args::parse().command.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
