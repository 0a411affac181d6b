//! What can be wrong with a scene file.

use std::path::PathBuf;

use deictic_core::protocol::hand::HandFault;
use deictic_core::protocol::message::Fault;
use deictic_core::scene::SceneError;
use thiserror::Error;

use crate::diagnose::{Problem, did_you_mean, misspelt, quoted};
use crate::explain;

/// What is wrong with a scene file.
#[derive(Debug, Error)]
pub enum SceneProblem {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(std::io::Error),
    /// The vocabulary file that it names cannot be read.
    #[error("the vocabulary {} cannot be read: {why}", path.display())]
    NoVocabulary {
        /// Where it would be.
        path: PathBuf,
        /// What the system said.
        why: String,
    },
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
    /// A measure that cannot be.
    #[error("nothing on a table has {measure} = {value}")]
    BadMeasure {
        /// Which one.
        measure: &'static str,
        /// What was written.
        value: f32,
    },
    /// A line that is no JSON, or not of this shape.
    #[error("{0}")]
    Line(String),
    /// A line that is longer than any scene.
    #[error("a line of {0} bytes is no scene")]
    LongLine(usize),
    /// A thing that is neither an object nor a storage, or both.
    #[error("a thing has a name as an `object` or as a `storage`")]
    Nameless,
    /// A thing that is named twice in one table.
    #[error("the {0} is on the table twice")]
    Twice(String),
    /// A new thing without a place.
    #[error("the {0} is new on the table and has no `position`")]
    NoPosition(String),
    /// A thing that is to be taken away and is not there.
    #[error("the {0} is not on the table")]
    NotThere(String),
    /// The hand sensor cannot stand so, or nobody aims so.
    #[error("{}", explain::fault(&Fault::Hand(*.0)).what)]
    Sensor(HandFault),
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
            Self::NoVocabulary { .. } => {
                "write where it is, as seen from this file; without the line the tabletop's own vocabulary is taken".into()
            }
            Self::Syntax(message) => format!("{}{}", misspelt(message), "the file is TOML with [[object]] and [[storage]] tables that have a `name`, a \
                 `position` and `features`; see data/scenes/table.toml"),
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
            Self::Line(_) | Self::LongLine(_) => {
                "write {\"change\": {...}}, {\"remove\": {...}}, {\"things\": [...]} or \"show\" on a \
                 line of its own"
                    .into()
            }
            Self::Nameless => {
                "write for example {\"change\": {\"object\": \"can\", \"position\": [0.4, 0.1, 0.06]}}"
                    .into()
            }
            Self::Twice(_) => "keep one of them; two alike need names of their own in the vocabulary".into(),
            Self::NoPosition(_) => "give its place as [x, y, z] in metres".into(),
            Self::NotThere(_) => "ask with \"show\" for what is on the table".into(),
            Self::BadLikelihood(_) => "write a number from 0 to 1, or true or false".into(),
            Self::BadMeasure { .. } => {
                "`mass` is in kilograms, `holds` and `liquid` are in litres, and there is no more liquid in a thing than \
                 it holds"
                    .into()
            }
            Self::Sensor(fault) => explain::fault(&Fault::Hand(*fault)).remedy,
            Self::Refused(error) => explain::scene_error(error).remedy,
        }
    }
}
