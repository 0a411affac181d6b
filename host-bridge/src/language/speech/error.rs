//! Why nothing was heard, and what the person can do about it.

use std::io;
use std::path::PathBuf;

use crate::language::LanguageError;

/// Why nothing was heard.
#[derive(Debug, thiserror::Error)]
pub enum SpeechError {
    /// A program that is not installed, or that failed.
    #[error("{program}: {why}")]
    Program {
        /// Which.
        program: String,
        /// What it said.
        why: String,
    },
    /// A file that could not be read or written.
    #[error("{}: {source}", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A model that cannot be used.
    #[error("{}: {why}", path.display())]
    Model {
        /// Where it is.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// The vocabulary has nothing that this recogniser can hear.
    #[error("no action of the vocabulary can be pronounced in this language")]
    NoGrammar,
    /// Nothing was understood.
    #[error(transparent)]
    Language(#[from] LanguageError),
}

impl SpeechError {
    /// What the person can do about it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Program { .. } => {
                "install Debian's packages pocketsphinx, pocketsphinx-en-us, sox and alsa-utils"
                    .into()
            }
            Self::File { .. } => "check that the file is there and can be read".into(),
            Self::Model { .. } => {
                "`cargo xtask setup` installs it; or hear with `--recogniser pocketsphinx`".into()
            }
            Self::NoGrammar => "plug in a recogniser of that language by its lines".into(),
            Self::Language(error) => error.remedy(),
        }
    }
}
