//! Recordings: the very bytes of a sensor's serial line, one framed sample after the other.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use deictic_core::gesture::line::{FRAMED, SensorLine, send};
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::stuffing::Outbox;

use super::SourceError;

/// Reads a recording.
///
/// # Errors
/// [`SourceError`]: it cannot be read, is no recording, or a frame in it is damaged.
pub fn read(path: &Path) -> Result<Vec<Sample>, SourceError> {
    let what = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|cause| SourceError::Unopened {
        what: what.clone(),
        cause,
    })?;
    let mut line = SensorLine::new();
    let mut samples = Vec::new();
    let mut number = 0;
    for byte in bytes {
        let Some(sample) = line.push(byte) else {
            continue;
        };
        number += 1;
        match sample {
            Ok(sample) => samples.push(sample),
            Err(_) if samples.is_empty() => return Err(SourceError::NoRecording(what)),
            Err(error) => return Err(SourceError::Unsound { number, error }),
        }
    }
    if samples.is_empty() {
        return Err(SourceError::NoRecording(what));
    }
    Ok(samples)
}

/// Bytes of a sample on a sensor's serial line; none for one that has no such form.
#[must_use]
pub fn framed(sample: &Sample) -> Vec<u8> {
    let mut out = Outbox::<FRAMED>::new();
    match send(sample, &mut out) {
        Ok(()) => out.waiting().to_vec(),
        Err(_) => Vec::new(),
    }
}

/// Writes a recording while it is made.
pub struct Recorder(BufWriter<File>);

impl Recorder {
    /// Begins a recording; one that is there is written over.
    ///
    /// # Errors
    /// [`SourceError::Unopened`]
    pub fn create(path: &Path) -> Result<Self, SourceError> {
        let created = File::create(path).map_err(|cause| SourceError::Unopened {
            what: path.display().to_string(),
            cause,
        })?;
        Ok(Self(BufWriter::new(created)))
    }

    /// Appends a sample.
    ///
    /// # Errors
    /// [`SourceError::Broken`], as a full disk gives.
    pub fn push(&mut self, sample: &Sample) -> Result<(), SourceError> {
        self.0
            .write_all(&framed(sample))
            .map_err(SourceError::Broken)
    }

    /// Ends the recording.
    ///
    /// # Errors
    /// [`SourceError::Broken`], as a full disk gives.
    pub fn finish(mut self) -> Result<(), SourceError> {
        self.0.flush().map_err(SourceError::Broken)
    }
}
