//! Programs from PyPI, each in a virtual environment of its own.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use crate::process;

/// A Python that packages can be added to.
pub struct Environment {
    place: PathBuf,
}

impl Environment {
    /// A new one at this place.
    pub fn create(place: &Path) -> Result<Self> {
        process::run(Command::new("python3").args(["-m", "venv"]).arg(place))
            .context("Python's venv is needed: `apt-get install python3-venv`")?;
        let place = place.to_owned();
        Ok(Self { place })
    }

    /// Its interpreter.
    pub fn interpreter(&self) -> PathBuf {
        self.place.join("bin/python")
    }

    /// `pip install`, to be told what.
    pub fn install(&self) -> Command {
        let mut pip = Command::new(self.place.join("bin/pip"));
        pip.args(["install", "--quiet"]);
        pip
    }
}

/// A Python with python-can and cantools, made beside the other build products.
pub fn with_can() -> Result<PathBuf> {
    let place = process::target().join("robot-tools");
    let ready = place.join("ready");
    if !ready.is_file() {
        let python = Environment::create(&place)?;
        process::run(python.install().args(CAN_PACKAGES))?;
        std::fs::write(&ready, "")?;
    }
    Ok(Environment { place }.interpreter())
}

/// The releases that this was tested with; pyserial is what python-can reaches adapters through.
const CAN_PACKAGES: [&str; 3] = ["python-can==4.5.0", "cantools==40.2.1", "pyserial==3.5"];
