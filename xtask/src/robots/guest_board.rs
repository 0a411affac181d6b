//! The demo in a guest that has CAN, on a robot at its CAN interface, decided by the unit on the emulated board outside:
//! a pseudo-terminal is QEMU's serial line at one end and the guest's /dev/ttyS0 at the other.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

use anyhow::{Context, Result};

use super::played::{Bridge, Row, rows_in};
use crate::cmd::key;
use crate::guest::{self, INTERFACE};
use crate::qemu::{self, Link};

/// How long the guest may take, in seconds.
const PATIENCE: u32 = 300;

/// A running board, ended whatever happens.
struct Board(Child);

impl Drop for Board {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Boots the image; gives the terminal at which its host link is.
fn boot(image: &std::path::Path) -> Result<(Board, String)> {
    let mut qemu: Command = qemu::command(image, &Link::Terminal);
    let mut board = Board(qemu.stdout(Stdio::piped()).spawn()?);
    let output = board.0.stdout.take().context("QEMU has no output")?;
    let mut lines = BufReader::new(output).lines().map_while(Result::ok);
    // "char device redirected to /dev/pts/3 (label serial0)"
    let named = lines.find_map(|line| {
        let (_, rest) = line.split_once("redirected to ")?;
        rest.split_whitespace().next().map(str::to_owned)
    });
    std::thread::spawn(move || lines.for_each(drop));
    Ok((board, named.context("QEMU names no terminal")?))
}

/// Plays the demo there; without an image the unit is in the bridge's process.
pub fn play(bridge: &Bridge) -> Result<Vec<Row>> {
    let board = bridge.image.as_deref().map(boot).transpose()?;
    let terminal = board.as_ref().map(|(_, terminal)| terminal.as_str());
    let unit = match terminal {
        Some(_) => "serial:/dev/ttyS0",
        None => "inside",
    };
    let robot = format!("can:{INTERFACE}");
    let key = key::for_trials()?;
    let key = key.display();
    let far = bridge.line(&format!("robot-sim --listen {robot} --key '{key}'"));
    // Nobody else reaches the pseudo-terminal.
    let trust = format!("--robot-key '{key}' --insecure-robot");
    let near = bridge.line(&format!("play --robot {robot} --board {unit} {trust}"));
    let lines = format!("{far} >/dev/null 2>&1 &\n{near}");
    rows_in(&guest::run(&lines, terminal, PATIENCE)?)
}
