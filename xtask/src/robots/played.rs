//! The demo played by the bridge on one robot, and what became of each command.

use std::ffi::OsString;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};

use crate::board::Board;
use crate::process::{self, cargo};

/// One command.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Row {
    /// What was said.
    pub said: String,
    /// What was shown.
    pub shown: String,
    /// What the unit decided.
    pub decided: Vec<String>,
    /// What the robot did.
    pub robot: String,
}

impl Row {
    /// How it ended, wherever a stop met the arm.
    pub fn ending(&self) -> &str {
        match self.robot.split_once(": ") {
            Some(("stopped", _)) => "stopped",
            _ => &self.robot,
        }
    }

    /// Whether another robot ended it alike, on the same decisions.
    pub fn is_as(&self, other: &Self) -> bool {
        self.decided == other.decided && self.ending() == other.ending()
    }
}

/// The summary that a played session prints last.
#[derive(Deserialize)]
struct Summary {
    rows: Vec<Row>,
}

/// The rows in what a session has printed.
pub fn rows_in(printed: &str) -> Result<Vec<Row>> {
    let summary = printed
        .lines()
        .find(|line| line.contains(r#""event":"summary""#));
    let summary = summary.context("the session has no summary")?;
    Ok(serde_json::from_str::<Summary>(summary.trim())?.rows)
}

/// The bridge's program, and the unit that it plays with.
pub struct Bridge {
    program: PathBuf,
    /// The image of the unit in QEMU; none for the unit in the bridge's process.
    pub image: Option<PathBuf>,
}

impl Bridge {
    /// Builds the bridge.
    pub fn build(image: Option<PathBuf>) -> Result<Self> {
        process::run(cargo().args(["build", "--quiet", "--package", "deictic"]))?;
        Self::built(image)
    }

    /// The bridge that was built beside this program.
    pub fn built(image: Option<PathBuf>) -> Result<Self> {
        let this = std::env::current_exe().context("cannot find this program")?;
        let program = this.with_file_name("deictic");
        Ok(Self { program, image })
    }

    /// The bridge with these arguments.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(&self.program);
        command.args(arguments).args(["--haste", HASTE, "--json"]);
        command
    }

    /// The same as a line of shell.
    pub fn line(&self, arguments: &str) -> String {
        let program = self.program.display();
        format!("'{program}' {arguments} --haste {HASTE} --json")
    }

    /// Plays the demo on a robot, with its key where it has one.
    pub fn play(&self, robot: &str, key: Option<&Path>) -> Result<Vec<Row>> {
        let board = if self.image.is_some() {
            "qemu"
        } else {
            "inside"
        };
        let mut command = self.command(&["play", "--robot", robot, "--board", board]);
        if let Some(key) = key {
            command.arg("--robot-key").arg(key);
        }
        let image = self.image.iter().map(OsString::from);
        command.envs(image.map(|image| (Board::Mps2An386.image_variable(), image)));
        let output = command.stderr(Stdio::inherit()).output()?;
        let printed = String::from_utf8_lossy(&output.stdout);
        rows_in(&printed).with_context(|| format!("the session with {robot} failed"))
    }
}

/// How many times as fast as a careful arm the simulated one moves.
const HASTE: &str = "4";

/// A simulated robot in a process of its own, ended whatever happens.
pub struct Far(Child);

impl Far {
    /// One that listens there to who has this key; gives where it is found as well.
    pub fn listening(bridge: &Bridge, at: &str, key: &Path) -> Result<(Self, String)> {
        #[derive(Deserialize)]
        struct Told {
            address: String,
        }
        let mut command = bridge.command(&["robot-sim", "--listen", at]);
        command.arg("--key").arg(key);
        let mut far = Self(command.stdout(Stdio::piped()).spawn()?);
        let mut line = String::new();
        let output = far.0.stdout.take().context("it has no output")?;
        let mut output = BufReader::new(output);
        output.read_line(&mut line)?;
        // What else it says is of no interest, but it must be able to say it.
        std::thread::spawn(move || output.lines().map_while(Result::ok).for_each(drop));
        let told: Told =
            serde_json::from_str(&line).with_context(|| format!("no robot listens at {at}"))?;
        Ok((far, told.address))
    }
}

impl Drop for Far {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}
