//! Gestures that a user has recorded, as a file that `deictic gestures learn` writes.

use std::path::Path;

use deictic_core::gesture::mapping::STROKES;
use deictic_core::gesture::stroke::Templates;
use deictic_core::gesture::stroke_table::NAMES;
use deictic_core::gesture::template::{Scale, Template};
use deictic_core::protocol::hand::{LEARNED, TEMPLATES_PART, TemplatesPart};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Gestures that a unit is taught.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Taught {
    /// Whether the gestures that a unit knows without being taught are told apart as well.
    pub known: bool,
    /// Names, in the order of numbers, which follow those of the gestures a unit knows.
    pub gestures: Vec<String>,
    /// How distances become probabilities.
    pub scale: Scale,
    /// Examples of each.
    #[serde(rename = "template", default)]
    pub templates: Vec<Template>,
}

impl Default for Taught {
    fn default() -> Self {
        Self {
            known: true,
            gestures: Vec::new(),
            scale: *Templates::KNOWN.scale,
            templates: Vec::new(),
        }
    }
}

/// Why a file of gestures cannot be used.
#[derive(Debug, Error)]
pub enum TaughtError {
    /// It cannot be read.
    #[error("cannot read the gestures in {path}: {cause}")]
    Unreadable {
        /// The file.
        path: String,
        /// What the system said.
        #[source]
        cause: std::io::Error,
    },
    /// It is not TOML, or not of this shape.
    #[error("{path} holds no gestures: {cause}")]
    Syntax {
        /// The file.
        path: String,
        /// What is wrong.
        #[source]
        cause: toml::de::Error,
    },
    /// A gesture without a name, or with another's.
    #[error("{path}: gesture {number} has no name of its own")]
    Nameless {
        /// The file.
        path: String,
        /// Which one of `gestures`, counted from 1.
        number: usize,
    },
    /// More than a unit holds.
    #[error(
        "{path}: {gestures} gestures with {templates} examples; a unit tells {STROKES} apart and holds {LEARNED} examples"
    )]
    TooMany {
        /// The file.
        path: String,
        /// How many gestures, those that a unit knows included.
        gestures: usize,
        /// How many examples.
        templates: usize,
    },
}

impl TaughtError {
    /// What the person can do about it.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Unreadable { .. } => {
                "give a file that `deictic gestures learn --out` has written"
            }
            Self::Syntax { .. } => "write it anew with `deictic gestures learn`",
            Self::Nameless { .. } => {
                "name each in `gestures`, as the vocabulary names it; those that a unit knows keep theirs"
            }
            Self::TooMany { .. } => {
                "learn fewer gestures, fewer examples of each (--each), or --only those"
            }
        }
    }
}

impl Taught {
    /// Reads a file.
    ///
    /// # Errors
    /// [`TaughtError`]
    pub fn read(path: &Path) -> Result<Self, TaughtError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|cause| TaughtError::Unreadable {
            path: name.clone(),
            cause,
        })?;
        let taught: Self = toml::from_str(&text).map_err(|cause| TaughtError::Syntax {
            path: name.clone(),
            cause,
        })?;
        taught.check(&name)?;
        Ok(taught)
    }

    /// Holds that a unit has room for it, and that every gesture has a name of its own.
    ///
    /// # Errors
    /// [`TaughtError::TooMany`], [`TaughtError::Nameless`], naming `path`.
    pub fn check(&self, path: &str) -> Result<(), TaughtError> {
        let others: &[&str] = if self.known { &NAMES } else { &[] };
        for (i, name) in self.gestures.iter().enumerate() {
            let before = self.gestures.iter().take(i);
            let taken = before.map(String::as_str).chain(others.iter().copied());
            if name.trim().is_empty() || taken.into_iter().any(|other| other == name) {
                let (path, number) = (path.to_owned(), i + 1);
                return Err(TaughtError::Nameless { path, number });
            }
        }
        let gestures = self.gestures.len() + if self.known { known() } else { 0 };
        let templates = self.templates.len();
        if gestures > STROKES || templates > LEARNED {
            return Err(TaughtError::TooMany {
                path: path.to_owned(),
                gestures,
                templates,
            });
        }
        Ok(())
    }

    /// The messages that teach it.
    #[must_use]
    pub fn parts(&self) -> Vec<TemplatesPart> {
        let small = |n: usize| u8::try_from(n).unwrap_or(u8::MAX);
        let part = |(i, templates): (usize, &[Template])| TemplatesPart {
            total: small(self.templates.len()),
            first: small(i * TEMPLATES_PART),
            known: self.known,
            scale: self.scale,
            templates: templates.iter().copied().collect(),
        };
        let mut parts: Vec<TemplatesPart> = self
            .templates
            .chunks(TEMPLATES_PART)
            .enumerate()
            .map(part)
            .collect();
        if parts.is_empty() {
            parts.push(part((0, &[])));
        }
        parts
    }
}

/// How many gestures a unit knows without being taught.
#[must_use]
pub fn known() -> usize {
    Templates::KNOWN
        .known
        .iter()
        .map(|t| usize::from(t.gesture) + 1)
        .max()
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_gesture_that_a_unit_knows_has_a_name() {
        assert_eq!(known(), NAMES.len());
    }

    #[test]
    fn a_file_keeps_what_was_learned() {
        let taught = Taught {
            gestures: vec!["zigzag".into()],
            templates: Templates::KNOWN.known.iter().take(5).copied().collect(),
            ..Taught::default()
        };
        let text = toml::to_string(&taught).unwrap();
        assert_eq!(toml::from_str::<Taught>(&text).unwrap(), taught);
        let parts = taught.parts();
        assert_eq!(parts.iter().map(|p| p.first).collect::<Vec<_>>(), [0, 3]);
        assert_eq!(Taught::default().parts().len(), 1);
    }
}
