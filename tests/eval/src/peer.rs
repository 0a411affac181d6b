//! The same decision in numpy, run by whatever Python is there.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use serde::Deserialize;
use thiserror::Error;

use crate::record::CATEGORIES;

/// The peer's own source, so that the program needs no folder beside it.
const SOURCE: &str = include_str!("../peers/reference.py");

/// What the peer prints.
#[derive(Debug, Deserialize)]
pub struct Report {
    /// How many decisions it made.
    pub decisions: usize,
    /// How long it took, reading not counted.
    pub seconds: f64,
    /// Its settled options by set and sample.
    pub answers: BTreeMap<String, Vec<[i16; CATEGORIES]>>,
}

/// Why the peer gave no report.
#[derive(Debug, Error)]
pub enum PeerError {
    /// Python cannot be started.
    #[error("`{python}` cannot be started: {cause}")]
    Start {
        /// The command.
        python: String,
        /// The system's reason.
        cause: std::io::Error,
    },
    /// It failed; most often numpy is missing.
    #[error("`{python}` gave no answers (does it have numpy?): {stderr}")]
    Failed {
        /// The command.
        python: String,
        /// The last line of what it wrote to standard error, or what is wrong with what it printed.
        stderr: String,
    },
}

/// Lets numpy decide every sample in a folder, `repeats` times.
///
/// # Errors
/// [`PeerError`] when there is no Python with numpy.
pub fn run(python: &str, sets: &Path, repeats: usize) -> Result<Report, PeerError> {
    let output = Command::new(python)
        .arg("-c")
        .arg(SOURCE)
        .arg(sets)
        .arg(repeats.to_string())
        .output()
        .map_err(|cause| PeerError::Start {
            python: python.to_owned(),
            cause,
        })?;
    let failed = |stderr: String| PeerError::Failed {
        python: python.to_owned(),
        stderr,
    };
    if !output.status.success() {
        let text = String::from_utf8_lossy(&output.stderr);
        return Err(failed(text.lines().last().unwrap_or_default().to_owned()));
    }
    serde_json::from_slice(&output.stdout).map_err(|e| failed(e.to_string()))
}
