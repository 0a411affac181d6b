//! Moonshine, the better recogniser of speech: a model and its runtime in one package (90 MB from PyPI).

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result};

use crate::process;

/// The release that the recogniser was tested with. Later ones fetch their models when they are run.
const PACKAGE: &str = "moonshine-voice==0.0.59";

/// The environment variable that tells the bridge where it is.
pub const VARIABLE: &str = "DEICTIC_MOONSHINE";

/// Installs it beside the other build products; gives where.
pub fn install() -> Result<PathBuf> {
    let place = process::target().join("moonshine");
    if place.join("moonshine_voice/assets/tiny-en").is_dir() {
        return Ok(place);
    }
    eprintln!("installing {PACKAGE}");
    let python = process::target().join("moonshine-python");
    process::run(Command::new("python3").args(["-m", "venv"]).arg(&python))
        .context("Python's venv is needed: `apt-get install python3-venv`")?;
    let mut pip = Command::new(python.join("bin/pip"));
    pip.args(["install", "--quiet", "--retries", "1", "--no-deps"]);
    process::run(pip.arg("--target").arg(&place).arg(PACKAGE))
        .context("Moonshine cannot be fetched from PyPI")?;
    Ok(place)
}
