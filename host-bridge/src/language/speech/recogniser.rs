//! The recognisers that sound is given to.

use std::path::Path;
use std::str::FromStr;

use super::error::SpeechError;
use super::moonshine::{self, Moonshine};
use super::phrases::Expected;
use super::pocketsphinx::{self, Pocketsphinx};
use crate::language::Spoken;
use crate::language::pack::Pack;
use crate::vocabulary::Lexicon;

/// Which recogniser.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// Moonshine where it is installed, with pocketsphinx for a second opinion where that is; else
    /// pocketsphinx.
    #[default]
    Best,
    /// Moonshine alone.
    Moonshine,
    /// Debian's pocketsphinx.
    Pocketsphinx,
}

impl FromStr for Kind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "best" => Ok(Self::Best),
            "moonshine" => Ok(Self::Moonshine),
            "pocketsphinx" => Ok(Self::Pocketsphinx),
            _ => Err("there are: best, moonshine, pocketsphinx".into()),
        }
    }
}

/// A recogniser with the rules of a vocabulary.
#[derive(Debug)]
pub enum Recogniser {
    /// From the package `moonshine-voice`, and pocketsphinx for a second opinion.
    Moonshine(Box<Moonshine>, Option<Pocketsphinx>),
    /// Debian's.
    Pocketsphinx(Pocketsphinx),
}

impl Recogniser {
    /// Opens one; `sphinx` is the folder of pocketsphinx's model.
    ///
    /// # Errors
    /// [`SpeechError`] when it is not installed, or the vocabulary has nothing that it can hear.
    pub fn open(
        kind: Kind,
        lexicon: &Lexicon,
        pack: &Pack,
        sphinx: &Path,
    ) -> Result<Self, SpeechError> {
        let moonshine = |folder: &Path, second| {
            let opened = Moonshine::new(lexicon, pack, folder)?;
            Ok(Self::Moonshine(Box::new(opened), second))
        };
        match (kind, moonshine::installed()) {
            (Kind::Best, Some(folder)) => {
                let second = pocketsphinx::installed(sphinx);
                let second = second.then(|| Pocketsphinx::new(lexicon, pack, sphinx));
                moonshine(&folder, second.transpose()?)
            }
            (Kind::Moonshine, Some(folder)) => moonshine(&folder, None),
            (Kind::Moonshine, None) => Err(SpeechError::Model {
                path: moonshine::place(),
                why: "Moonshine is not installed there".into(),
            }),
            _ => Pocketsphinx::new(lexicon, pack, sphinx).map(Self::Pocketsphinx),
        }
    }

    /// Its name, as [`Kind`] is written.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Moonshine(..) => "moonshine",
            Self::Pocketsphinx(_) => "pocketsphinx",
        }
    }

    /// What is said in one utterance, samples of [`super::sound::RATE`].
    ///
    /// # Errors
    /// [`SpeechError`].
    pub fn hear(&mut self, samples: &[i16], expected: Expected) -> Result<Spoken, SpeechError> {
        match self {
            Self::Moonshine(first, second) => first.hear(samples, expected, second.as_ref()),
            Self::Pocketsphinx(pocketsphinx) => pocketsphinx.hear(samples, expected),
        }
    }
}
