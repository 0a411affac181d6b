use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Result, bail, ensure};
use clap::Args;

use crate::guest::{self, INTERFACE, has_can};
use crate::process::{self, cargo};

/// Try the robot's links on a real CAN interface of Linux.
///
/// Makes a virtual interface where this machine's kernel has CAN; elsewhere boots a Linux of its own (Debian's
/// user-mode-linux, with this machine's files read-only) and makes it there. The tests are those of `robot_can`,
/// `robot_can_faults`, `robot_wires` and `robot_latency`; candump, cansend and slcand are the witnesses.
#[derive(Args)]
pub struct Can;

const TESTS: [&str; 5] = [
    "robot_can",
    "robot_can_flexible",
    "robot_can_faults",
    "robot_wires",
    "robot_latency",
];

/// How long the guest may take, in seconds.
const PATIENCE: u32 = 300;

impl Can {
    pub fn run(self) -> Result<()> {
        if !guest::is_possible() {
            bail!("{}", guest::MISSING);
        }
        let tests = build(&TESTS, &[])?;
        if has_can() {
            here(&tests)
        } else {
            in_a_guest(&tests)
        }
    }
}

fn here(tests: &[PathBuf]) -> Result<()> {
    eprintln!("on this machine's {INTERFACE}");
    for test in tests {
        let mut command = Command::new(test);
        command.args(["--nocapture", "--test-threads", "1"]);
        command.env("DEICTIC_CAN", INTERFACE);
        process::run(&mut command)?;
    }
    Ok(())
}

fn in_a_guest(tests: &[PathBuf]) -> Result<()> {
    eprintln!("in a Linux of its own, as this kernel has no CAN");
    let tests: Vec<String> = tests
        .iter()
        .map(|test| format!("'{}' --nocapture --test-threads 1", test.display()))
        .collect();
    let lines = format!("export DEICTIC_CAN={INTERFACE}\n{}", tests.join(" && "));
    println!("{}", guest::run(&lines, None, PATIENCE)?);
    Ok(())
}

/// Builds tests of the bridge, `profile` being arguments to cargo; gives their programs.
pub fn build(tests: &[&str], profile: &[&str]) -> Result<Vec<PathBuf>> {
    let mut command = cargo();
    command.args([
        "test",
        "--package",
        "deictic",
        "--no-run",
        "--message-format",
        "json",
    ]);
    command.args(profile);
    for test in tests {
        command.args(["--test", test]);
    }
    let output = command.stderr(Stdio::inherit()).output()?;
    ensure!(output.status.success(), "the tests cannot be built");
    let said = String::from_utf8_lossy(&output.stdout);
    let programs = said.lines().filter_map(|line| {
        let (_, rest) = line.split_once("\"executable\":\"")?;
        rest.split_once('"')
            .map(|(path, _)| Path::new(path).to_owned())
    });
    let is_test = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        // A dash and a digest follow.
        TESTS
            .iter()
            .any(|test| name.rsplit_once('-').is_some_and(|(of, _)| of == *test))
    };
    let programs: Vec<_> = programs.filter(is_test).collect();
    ensure!(
        programs.len() == tests.len(),
        "cargo names other tests: {programs:?}"
    );
    Ok(programs)
}
