//! Recognisers, sensors and scenes that fail in a session: nothing is done of what nobody could hear, it is said what is wrong and
//! what to do, and the program does not end as if all were well.

use std::ffi::OsStr;
use std::io::Write;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use deictic::language::speech::pocketsphinx::MODEL;
use serde_json::Value;
use tempfile::TempDir;

fn deictic() -> Command {
    Command::new(env!("CARGO_BIN_EXE_deictic"))
}

fn run(arguments: &[&str], input: &[u8]) -> Output {
    let mut command = deictic();
    command.args(["run", "--board", "inside", "--haste", "1000", "--json"]);
    output(command.args(arguments), input)
}

fn output(command: &mut Command, input: &[u8]) -> Output {
    let command = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
    // The program may end before it has read everything.
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output().unwrap()
}

fn objects(output: &Output) -> Vec<Value> {
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    let lines = text.lines().map(|line| serde_json::from_str(line).unwrap());
    lines.collect()
}

fn has(objects: &[Value], event: &str) -> bool {
    objects.iter().any(|o| o["event"] == event)
}

/// The error that the program ended with, and what it says to do.
fn error(output: &Output) -> (String, String) {
    let objects = objects(output);
    let last = objects.last().unwrap();
    let text = |key: &str| last[key].as_str().unwrap_or_default().to_owned();
    (text("error"), text("remedy"))
}

fn is_refused(output: &Output, what: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && said.contains(what), "{said}");
    assert!(!said.contains("panicked"), "{said}");
}

#[test]
fn a_source_of_speech_that_fails_has_nothing_done_and_ends_the_session() {
    let folder = TempDir::new().unwrap();
    let junk = folder.path().join("junk.wav");
    std::fs::write(&junk, "no sound at all").unwrap();
    let junk = junk.display().to_string();
    let mut sources = vec!["lines:nosuchprogram", "samples:echo no device >&2; exit 1"];
    if Command::new("sox").arg("--version").output().is_ok() && Path::new(MODEL).exists() {
        sources.push(&junk);
    } else {
        eprintln!("not with a recording: sox or pocketsphinx is not installed");
        sources.truncate(1);
    }
    for source in sources {
        let output = run(&["--show", "pick cup", "--speech", source], b"");
        let (error, remedy) = error(&output);
        assert_eq!(output.status.code(), Some(1), "{source}");
        assert!(error.contains("nothing is heard from"), "{source}: {error}");
        assert!(!remedy.is_empty(), "{source}");
        let happened = objects(&output);
        assert!(has(&happened, "withheld"), "{source}: {happened:#?}");
        assert!(!has(&happened, "decided"), "{source}: {happened:#?}");
    }
}

/// A recogniser that was there when the session began and is not any more: its program is taken out of the path
/// by a folder of its own that has all other programs.
#[test]
fn a_recogniser_that_fails_has_the_gesture_withheld() {
    let programs = ["sox", "espeak-ng", "pocketsphinx_batch"];
    let there = |program: &&str| Command::new(program).arg("--version").output().is_ok();
    if !programs.iter().all(there) || !Path::new(MODEL).exists() {
        eprintln!("skipped: espeak-ng, sox or pocketsphinx is not installed");
        return;
    }
    let folder = TempDir::new().unwrap();
    let (said, path) = (folder.path().join("said.wav"), folder.path().join("bin"));
    let mut espeak = Command::new("espeak-ng");
    let spoken = espeak
        .arg("-w")
        .arg(&said)
        .arg("don't pick the cup")
        .status();
    assert!(spoken.unwrap().success());
    std::fs::create_dir(&path).unwrap();
    let found = Command::new("sh").args(["-c", "command -v sox"]).output();
    let sox = String::from_utf8(found.unwrap().stdout).unwrap();
    std::os::unix::fs::symlink(sox.trim(), path.join("sox")).unwrap();
    let said = said.display().to_string();
    let mut command = deictic();
    command.args(["run", "--board", "inside", "--haste", "1000", "--json"]);
    command.args([
        "--window",
        "60000",
        "--show",
        "pick cup",
        "--recogniser",
        "pocketsphinx",
    ]);
    let output = output(command.args(["--speech", &said]).env("PATH", &path), b"");
    let happened = objects(&output);
    assert_eq!(output.status.code(), Some(2), "{happened:#?}");
    let unheard = happened.iter().find(|o| o["event"] == "unheard").unwrap();
    assert!(
        unheard["why"]
            .as_str()
            .unwrap()
            .contains("pocketsphinx_batch")
    );
    assert!(unheard["remedy"].as_str().unwrap().contains("install"));
    assert!(
        has(&happened, "withheld") && !has(&happened, "decided"),
        "{happened:#?}"
    );
}

#[test]
fn a_hand_sensor_that_sends_what_cannot_be_is_no_success() {
    let hand = ["--say", "release", "--hand", "mediapipe:-"];
    let output = run(&hand, b"{\"timestamp_ms\": 1}\nnonsense\n");
    let happened = objects(&output);
    let odd = happened
        .iter()
        .find(|o| o["event"] == "odd-sensor")
        .unwrap();
    assert!(odd["why"].as_str().unwrap().contains("message 2"), "{odd}");
    assert!(!odd["remedy"].as_str().unwrap().is_empty());
    assert_eq!(output.status.code(), Some(2), "{happened:#?}");
    let mut watched = deictic();
    watched.args(["hand", "--board", "inside", "--hand", "mediapipe:-"]);
    is_refused(&self::output(&mut watched, b"nonsense\n"), "message 1");
}

#[test]
fn a_scene_that_breaks_while_it_is_watched_is_told_as_a_scene_and_a_change_in_a_line() {
    let folder = TempDir::new().unwrap();
    let scene = folder.path().join("desk.toml");
    let vocabulary = concat!(env!("CARGO_MANIFEST_DIR"), "/data/tabletop.toml");
    let table = include_str!("../data/scenes/table.toml").replace("../tabletop.toml", vocabulary);
    std::fs::write(&scene, table).unwrap();
    let mut command = deictic();
    command
        .args(["run", "--board", "inside", "--watch", "--scene"])
        .arg(&scene);
    let command = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    writeln!(input, r#"{{"remove": {{"object": "cup"}}}}"#).unwrap();
    let mut output = std::io::BufReader::new(child.stdout.take().unwrap());
    let mut until = |wanted: &str| {
        let patience = Instant::now() + Duration::from_secs(60);
        let mut all = String::new();
        while !all.contains(wanted) {
            assert!(Instant::now() < patience, "{wanted}: {all}");
            let mut line = String::new();
            assert!(
                std::io::BufRead::read_line(&mut output, &mut line).unwrap() > 0,
                "{all}"
            );
            all += &line;
        }
        all
    };
    until("table    cup gone");
    std::fs::write(&scene, "things = nonsense").unwrap();
    let told = until("scene    ");
    assert!(!told.contains("heard"), "{told}");
    drop(input);
    child.wait().unwrap();
}

#[test]
fn what_cannot_be_at_the_command_line_is_refused_there() {
    let text = OsStr::from_bytes(b"pick \xff cup");
    let mut decide = deictic();
    is_refused(
        &output(decide.args(["decide", "--say"]).arg(text), b""),
        "UTF-8",
    );
    for haste in ["0", "-1", "nan", "inf"] {
        let mut sim = deictic();
        sim.args(["robot-sim", "--listen", "serial:pty", "--haste", haste]);
        is_refused(&output(&mut sim, b""), "careful arm");
        let mut play = deictic();
        is_refused(
            &output(
                play.args(["play", "--board", "inside", "--haste", haste]),
                b"",
            ),
            "careful arm",
        );
    }
    is_refused(
        &run(&["--say", "release", "--window", "0"], b""),
        "20..=3600000",
    );
    for listen in [
        "can:nosuchcan0",
        "serial:/dev/nosuchport",
        "slcan:/dev/nosuchport",
    ] {
        let mut sim = deictic();
        is_refused(
            &output(sim.args(["robot-sim", "--listen", listen]), b""),
            "nosuch",
        );
    }
}
