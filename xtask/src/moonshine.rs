//! Moonshine, the better recogniser of speech: a model and its runtime in one package (90 MB from PyPI).

use std::path::PathBuf;

use anyhow::{Context, Result};

use crate::process;
use crate::python::Environment;

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
    let python = Environment::create(&process::target().join("moonshine-python"))?;
    let mut pip = python.install();
    pip.args(["--retries", "1", "--no-deps", "--target"]);
    process::run(pip.arg(&place).arg(PACKAGE)).context("Moonshine cannot be fetched from PyPI")?;
    Ok(place)
}
