//! A synthesised voice, and what recognisers need that is installed or not.

use std::path::{Path, PathBuf};
use std::process::Command;

use deictic::language::speech::pocketsphinx::MODEL;
use tempfile::TempDir;

/// Whether there are a voice and a recogniser; if not, it is said that a test is skipped.
pub fn installed() -> bool {
    let there = |program: &str| Command::new(program).arg("--version").output().is_ok();
    let programs = ["espeak-ng", "sox", "pocketsphinx_batch"];
    let all = programs.into_iter().all(there) && Path::new(MODEL).exists();
    if !all {
        eprintln!("skipped: espeak-ng, sox or pocketsphinx is not installed");
    }
    all
}

/// A recording of a text.
pub fn speak(folder: &TempDir, name: &str, text: &str) -> PathBuf {
    let file = folder.path().join(name);
    let mut espeak = Command::new("espeak-ng");
    espeak
        .args(["-v", "en-us", "-s", "140", "-w"])
        .arg(&file)
        .arg(text);
    assert!(espeak.status().unwrap().success());
    file
}

/// Runs sox.
pub fn sox(arguments: &[&str]) {
    let status = Command::new("sox").args(arguments).status();
    assert!(status.unwrap().success(), "sox {arguments:?}");
}
