//! The unit's image with a key, on an emulated board: it plays the demo with a bridge that has the same key, and nobody
//! else moves anything.
//!
//! `DEICTIC_IMAGE_MPS2_AN386_KEYED` names the image and `DEICTIC_IMAGE_KEY` the file that it was built with; `cargo
//! xtask test` makes both. Skipped, with a word, where none is named.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use deictic::link::IMAGE_VARIABLE;
use serde_json::Value;

/// The image and its key.
fn keyed() -> Option<(PathBuf, PathBuf)> {
    let named = |variable| std::env::var_os(variable).map(PathBuf::from);
    let both = named("DEICTIC_IMAGE_MPS2_AN386_KEYED").zip(named("DEICTIC_IMAGE_KEY"));
    if both.is_none() {
        eprintln!("skipped: no image with a key; `cargo xtask test` builds one");
    }
    both
}

/// Plays the demo on the board with this image.
fn play(board: &str, image: &Path, key: Option<&Path>) -> Output {
    let mut bridge = Command::new(env!("CARGO_BIN_EXE_deictic"));
    bridge.args(["play", "--json", "--haste", "20", "--board", board]);
    if let Some(key) = key {
        bridge.arg("--key").arg(key);
    }
    bridge.env(IMAGE_VARIABLE, image).output().unwrap()
}

/// What was decided for every command, and what the robot did.
fn rows(played: &Output) -> Vec<(Value, String)> {
    let error = String::from_utf8_lossy(&played.stderr);
    assert!(played.status.success(), "{error}");
    let said = String::from_utf8_lossy(&played.stdout);
    let last: Value = serde_json::from_str(said.lines().last().unwrap()).unwrap();
    let row = |row: &Value| {
        let robot = row["robot"].as_str().unwrap();
        // Where a stop meets the arm is a matter of time.
        let ending = robot.split(": ").next().unwrap();
        (row["decided"].clone(), ending.to_owned())
    };
    last["rows"].as_array().unwrap().iter().map(row).collect()
}

/// The session has ended with one line, which says why nothing was played.
fn assert_refused(played: &Output, why: &str) {
    assert!(!played.status.success());
    let said = String::from_utf8_lossy(&played.stdout);
    let error: Value = serde_json::from_str(&said).unwrap();
    assert!(error["error"].as_str().unwrap().contains(why), "{said}");
}

#[test]
fn with_its_key_the_board_plays_the_demo() {
    let Some((image, key)) = keyed() else { return };
    let on_board = rows(&play("qemu", &image, Some(&key)));
    assert_eq!(on_board.len(), 20);
    assert_eq!(on_board, rows(&play("inside", &image, None)));
}

#[test]
fn without_its_key_nothing_is_played() {
    let Some((image, _)) = keyed() else { return };
    let other = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(other.path(), "5a".repeat(32)).unwrap();
    let refusals = [
        (None, "the unit wants to see a key"),
        (Some(other.path()), "the unit has another key"),
    ];
    for (key, why) in refusals {
        assert_refused(&play("qemu", &image, key), why);
    }
}

#[test]
fn a_board_without_a_key_is_not_believed() {
    let Some((_, key)) = keyed() else { return };
    let Some(plain) = std::env::var_os(IMAGE_VARIABLE) else {
        eprintln!("skipped: no image without a key; `cargo xtask test` builds one");
        return;
    };
    let played = play("qemu", Path::new(&plain), Some(&key));
    assert_refused(&played, "the unit has no key");
}
