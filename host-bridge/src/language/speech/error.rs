//! Why nothing was heard, and what the person can do about it.

use std::io;
use std::path::PathBuf;

use super::source::Source;
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
    /// What speech came from has failed.
    #[error("nothing is heard from {from} any more: {why}")]
    Ended {
        /// What it was.
        from: Source,
        /// What it said last.
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
            Self::Ended { from, .. } => match from {
                Source::Microphone => "connect a microphone (`arecord -l` lists those that are there), or take another's sound with \
                     --speech samples:COMMAND"
                    .into(),
                Source::Recording(_) => "give a recording that sox reads: `sox FILE -n stat` tells".into(),
                Source::Samples(_) | Source::Lines(_) => {
                    "run the command by itself and mend what it says; it is to write until it is ended".into()
                }
            },
            Self::File { .. } => "check that the file is there and can be read".into(),
            Self::Model { .. } => {
                "`cargo xtask setup` installs it; or hear with `--recogniser pocketsphinx`".into()
            }
            Self::NoGrammar => "plug in a recogniser of that language by its lines".into(),
            Self::Language(error) => error.remedy(),
        }
    }
}
