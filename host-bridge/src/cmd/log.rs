//! The log of a session: what became of each command.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::Path;

use miette::{IntoDiagnostic, Result, WrapErr};

use crate::session::Happening;
use crate::session::journal::Journal;
use crate::vocabulary::Lexicon;

/// A log, to a file or to nowhere.
#[derive(Debug)]
pub struct Log {
    file: Option<File>,
    journal: Journal,
}

impl Log {
    /// Opens the file to write to its end.
    ///
    /// # Errors
    /// When it cannot be opened.
    pub fn open(path: Option<&Path>) -> Result<Self> {
        let open = |path: &Path| {
            OpenOptions::new()
                .create(true)
                .append(true)
                .open(path)
                .into_diagnostic()
                .wrap_err_with(|| format!("{} cannot be written", path.display()))
        };
        Ok(Self {
            file: path.map(open).transpose()?,
            journal: Journal::default(),
        })
    }

    /// Writes a line when a command is over.
    ///
    /// # Errors
    /// When the file cannot be written any more.
    pub fn hear(&mut self, happening: &Happening, lexicon: &Lexicon) -> Result<()> {
        let record = self.journal.hear(happening, lexicon);
        let (Some(file), Some(record)) = (&mut self.file, record) else {
            return Ok(());
        };
        let mut line = serde_json::to_vec(&record).into_diagnostic()?;
        line.push(b'\n');
        file.write_all(&line)
            .into_diagnostic()
            .wrap_err("the log cannot be written any more")
    }
}
