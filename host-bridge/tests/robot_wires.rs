//! The simulated robot behind every link that it can be reached over, with a key and without: the demo's twenty commands,
//! which depend on each other, end alike on all of them.
//!
//! `DEICTIC_CAN` names a CAN interface of this machine, such as vcan0; with it that link alone is tried,
//! without it all others. `cargo xtask can` makes one, if need be in a Linux of its own.

use std::fmt::Write as _;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command as Process, Stdio};
use std::thread;

use serde_json::Value;

/// The interface that the tests may use.
fn interface() -> Option<String> {
    let named = std::env::var("DEICTIC_CAN").ok();
    if named.is_none() {
        eprintln!(
            "can: skipped, since DEICTIC_CAN names no interface; `cargo xtask can` makes one"
        );
    }
    named
}

/// Where the simulated robot is to listen, and whether it has a key.
fn places() -> Vec<(String, bool)> {
    // A guest that has CAN has one processor: the links that are everywhere are tried outside.
    if let Some(name) = interface() {
        return vec![(format!("can:{name}"), true)];
    }
    let everywhere = [
        ("tcp:127.0.0.1:0", false),
        ("serial:pty", true),
        ("slcan:pty", true),
        ("slcan:tcp:127.0.0.1:0", false),
    ];
    everywhere.map(|(at, key)| (at.to_owned(), key)).to_vec()
}

/// A key in a file.
fn key() -> tempfile::NamedTempFile {
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), "5a".repeat(32)).unwrap();
    file
}

/// A robot in a process of its own.
struct Far(Child);

impl Far {
    fn listening(at: &str, key: Option<&Path>) -> (Self, String) {
        let mut process = Process::new(env!("CARGO_BIN_EXE_deictic"));
        process.args(["robot-sim", "--json", "--haste", "8", "--listen", at]);
        if let Some(key) = key {
            process.arg("--key").arg(key);
        }
        let mut child = process.stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        let mut output = BufReader::new(child.stdout.take().unwrap());
        output.read_line(&mut line).unwrap();
        // What else it says is of no interest, but it must be able to say it.
        thread::spawn(move || output.lines().map_while(Result::ok).for_each(drop));
        let told: Value = serde_json::from_str(&line).unwrap();
        (Self(child), told["address"].as_str().unwrap().to_owned())
    }
}

impl Drop for Far {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// How every command of the demo ends with this robot. Where a stop meets the arm is not compared.
fn endings(robot: &str, key: Option<&Path>) -> Vec<String> {
    let mut process = Process::new(env!("CARGO_BIN_EXE_deictic"));
    process.args(["play", "--json", "--haste", "8", "--robot", robot]);
    match key {
        Some(key) => process.arg("--robot-key").arg(key),
        None => process.arg("--insecure-robot"),
    };
    let output = process.output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success(),
        "{robot}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    let last: Value = serde_json::from_str(said.lines().last().unwrap()).unwrap();
    let rows = last["rows"].as_array().unwrap();
    let ending = |row: &Value| {
        let robot = row["robot"].as_str().unwrap();
        let robot = robot
            .split_once(": ")
            .filter(|(what, _)| *what == "stopped");
        let robot = robot.map_or(row["robot"].as_str().unwrap(), |(what, _)| what);
        format!("{} -> {robot}", row["decided"])
    };
    rows.iter().map(ending).collect()
}

#[test]
fn twenty_commands_end_alike_over_every_link() {
    let near = thread::spawn(|| endings("sim", None));
    let far = places().into_iter().map(|(at, sealed)| {
        thread::spawn(move || {
            let file = sealed.then(key);
            let key = file.as_ref().map(|file| file.path());
            let (_far, address) = Far::listening(&at, key);
            (at, endings(&address, key))
        })
    });
    let far: Vec<_> = far.collect();
    let near = near.join().unwrap();
    assert_eq!(near.len(), 20);
    assert!(
        near.iter().filter(|e| e.ends_with("-> done")).count() >= 12,
        "{near:#?}"
    );
    let mut table = String::from("command: ending with the robot in this process");
    let far: Vec<_> = far.into_iter().map(|link| link.join().unwrap()).collect();
    for (at, _) in &far {
        let _ = write!(table, " | {at}");
    }
    for (i, ending) in near.iter().enumerate() {
        let _ = write!(table, "\n{:2} {ending}", i + 1);
        for (_, endings) in &far {
            let same = endings.get(i) == Some(ending);
            let _ = write!(table, " | {}", if same { "same" } else { "DIFFERENT" });
        }
    }
    println!("{table}");
    for (at, endings) in far {
        assert_eq!(endings, near, "over {at}");
    }
}
