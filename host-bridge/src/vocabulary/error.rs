//! What can be wrong with a vocabulary file.

use deictic_core::vocabulary::VocabularyError;
use thiserror::Error;

use crate::diagnose::{Problem, did_you_mean, misspelt, quoted};
use crate::explain;

/// What is wrong with a vocabulary file.
#[derive(Debug, Error)]
pub enum VocabularyProblem {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(std::io::Error),
    /// It is not TOML, or not of this shape.
    #[error("{0}")]
    Syntax(String),
    /// A name is empty or has characters that no sentence can have.
    #[error("\"{0}\" cannot be a name")]
    BadName(String),
    /// The same name stands twice in one category.
    #[error("{category} \"{name}\" is there twice")]
    Twice {
        /// The category.
        category: String,
        /// The name.
        name: String,
    },
    /// A category that cannot be a parameter, as it has a place of its own in the file.
    #[error("\"{0}\" is not a parameter")]
    NotAParameter(String),
    /// A signature or table names a category that the file does not have.
    #[error("there is no category \"{name}\"")]
    UnknownCategory {
        /// What was written.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
    /// A requirement names a feature that the file does not list.
    #[error("there is no feature \"{name}\"")]
    UnknownFeature {
        /// What was written.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
    /// A category or feature is both wanted and unwanted, or both compulsory and voluntary.
    #[error("\"{0}\" contradicts what was said of it before")]
    Contradiction(String),
    /// `stop` names no action.
    #[error("there is no action \"{name}\" to stop with")]
    UnknownStop {
        /// What was written.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
    /// A similarity table is not square, or a likelihood in it is not in 0..=1.
    #[error("the similarity table of \"{category}\" is not {size} x {size} likelihoods")]
    BadTable {
        /// Whose table.
        category: String,
        /// How many options the category has.
        size: usize,
    },
    /// The core refused it.
    #[error("{}", explain::vocabulary_error(.0).what)]
    Refused(VocabularyError),
}

impl Problem for VocabularyProblem {
    fn remedy(&self) -> String {
        match self {
            Self::Unreadable(_) => {
                "give the path of a vocabulary file, or none to use the tabletop one".into()
            }
            Self::Syntax(message) => format!(
                "{}{}",
                misspelt(message),
                "the file is TOML with [[action]], [[object]], [[storage]] and [[parameter]] \
                 tables; see data/tabletop.toml"
            ),
            Self::BadName(_) => "use letters, digits, '-' and '_', no more than 40 of them".into(),
            Self::Twice { .. } => {
                "keep one of them; further words for the same thing go into its `words`".into()
            }
            Self::NotAParameter(name) => {
                format!("write each {name} as a [[{name}]] table of its own")
            }
            Self::UnknownCategory { name, known } => format!(
                "{}there are {}; a category of your own needs a [[parameter]] table",
                did_you_mean(name, known.iter().map(String::as_str)),
                quoted(known.iter().map(String::as_str))
            ),
            Self::UnknownFeature { name, known } => format!(
                "{}add it to `features`, or take one of {}",
                did_you_mean(name, known.iter().map(String::as_str)),
                quoted(known.iter().map(String::as_str))
            ),
            Self::Contradiction(_) => "say it once".into(),
            Self::UnknownStop { name, known } => format!(
                "{}the actions are {}",
                did_you_mean(name, known.iter().map(String::as_str)),
                quoted(known.iter().map(String::as_str))
            ),
            Self::BadTable { size, .. } => format!(
                "write {size} rows of {size} numbers in 0..=1, a row per true option in the \
                 file's order, or a single number for all other options"
            ),
            Self::Refused(error) => explain::vocabulary_error(error).remedy,
        }
    }
}
