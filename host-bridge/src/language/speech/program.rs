//! Running the programs that hear, and their files.

use std::fs;
use std::io;
use std::path::Path;
use std::process::{Command, Stdio};

use super::error::SpeechError;
use super::sound;

/// The samples of a recording, any that sox reads.
///
/// # Errors
/// [`SpeechError`].
pub fn samples(recording: &Path) -> Result<Vec<i16>, SpeechError> {
    fs::metadata(recording).map_err(file(recording))?;
    let rate = sound::RATE.to_string();
    let mut command = Command::new("sox");
    command.arg("-R").arg(recording);
    command.args([
        "-t",
        "raw",
        "-r",
        rate.as_str(),
        "-c",
        "1",
        "-b",
        "16",
        "-e",
        "signed",
        "-",
    ]);
    run("sox", &mut command).map(|bytes| sound::of_bytes(&bytes))
}

pub(super) fn write(path: &Path, text: &str) -> Result<(), SpeechError> {
    fs::write(path, text).map_err(file(path))
}

pub(super) fn file(path: &Path) -> impl FnOnce(io::Error) -> SpeechError + use<> {
    let path = path.to_owned();
    move |source| SpeechError::File { path, source }
}

/// Runs a program; what it wrote on standard output.
pub(super) fn run(program: &str, command: &mut Command) -> Result<Vec<u8>, SpeechError> {
    let failed = |why: String| SpeechError::Program {
        program: program.to_owned(),
        why,
    };
    let command = command.stdin(Stdio::null()).stderr(Stdio::piped());
    let output = command.output().map_err(|e| failed(e.to_string()))?;
    if output.status.success() {
        return Ok(output.stdout);
    }
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    Err(failed(
        said.lines().last().unwrap_or("it failed").to_owned(),
    ))
}
