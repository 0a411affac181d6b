//! What can be wrong with a scene file.

use deictic_core::scene::SceneError;
use thiserror::Error;

use crate::diagnose::{Problem, did_you_mean, quoted};
use crate::explain;

/// What is wrong with a scene file.
#[derive(Debug, Error)]
pub enum SceneProblem {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] std::io::Error),
    /// It is not TOML, or not of this shape.
    #[error("{0}")]
    Syntax(String),
    /// A thing that the vocabulary does not have.
    #[error("the vocabulary has no {category} \"{name}\"")]
    UnknownThing {
        /// `object` or `storage`.
        category: &'static str,
        /// What was written.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
    /// A feature that the vocabulary does not have.
    #[error("the vocabulary has no feature \"{name}\"")]
    UnknownFeature {
        /// What was written.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
    /// A likelihood that is not in 0..=1.
    #[error("\"{0}\" is not a likelihood in 0..=1")]
    BadLikelihood(f32),
    /// The core refused a thing.
    #[error("{}", explain::scene_error(.0).what)]
    Refused(SceneError),
}

impl Problem for SceneProblem {
    fn remedy(&self) -> String {
        match self {
            Self::Unreadable(_) => {
                "give the path of a scene file, or none to use the table that comes with the \
                 program"
                    .into()
            }
            Self::Syntax(_) => {
                "the file is TOML with [[object]] and [[storage]] tables that have a `name`, a \
                 `position` and `features`; see data/scenes/table.toml"
                    .into()
            }
            Self::UnknownThing { name, known, .. } => format!(
                "{}add it to the vocabulary, or take one of {}",
                did_you_mean(name, known.iter().map(String::as_str)),
                quoted(known.iter().map(String::as_str))
            ),
            Self::UnknownFeature { name, known } => format!(
                "{}add it to the vocabulary's `features`, or take one of {}",
                did_you_mean(name, known.iter().map(String::as_str)),
                quoted(known.iter().map(String::as_str))
            ),
            Self::BadLikelihood(_) => "write a number from 0 to 1, or true or false".into(),
            Self::Refused(error) => explain::scene_error(error).remedy,
        }
    }
}
