//! What can be wrong with a vocabulary file.

use std::ops::Range;

use deictic_core::vocabulary::VocabularyError;
use thiserror::Error;

use crate::diagnose::{Problem, did_you_mean, misspelt, quoted};
use crate::explain;

/// What was looked for, or what is wrong and the bytes it is about.
pub(super) type Found<T> = Result<T, (Option<Range<usize>>, VocabularyProblem)>;

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
    /// A word or gesture without a letter or figure.
    #[error("a word or gesture of \"{0}\" is empty")]
    EmptyWord(String),
    /// One word or gesture stands for two options of a category.
    #[error("\"{word}\" stands for \"{first}\" and for \"{second}\"")]
    Shared {
        /// The word or gesture.
        word: String,
        /// One option.
        first: String,
        /// The other.
        second: String,
    },
    /// One word stands for an action and for a thing.
    #[error("\"{word}\" stands for the action \"{action}\" and for \"{thing}\"")]
    DoneAndNamed {
        /// The word.
        word: String,
        /// The action.
        action: String,
        /// The object or storage.
        thing: String,
    },
    /// A word of the language's grammar is a name.
    #[error("\"{word}\" cannot be a name: it {does}")]
    GrammarWord {
        /// The word.
        word: String,
        /// What it does in a sentence.
        does: &'static str,
    },
    /// A motion that the robot does not have.
    #[error("the robot has no motion \"{name}\"")]
    UnknownMotion {
        /// What was written.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
    /// A gesture that is spelt almost as one that hands are read for.
    #[error("no gesture \"{name}\" is known")]
    UnknownGesture {
        /// What was written.
        name: String,
        /// What may be meant.
        nearest: &'static str,
    },
    /// A gesture that separates words, or opens a target word.
    #[error("the gesture \"{0}\" cannot stand for an action: it separates words, or points")]
    Reserved(String),
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
    /// A similarity table has not a row per option, or a row has not a number per option.
    #[error(
        "the similarity table of \"{category}\" is {rows} x {columns}, and there are {size} of them"
    )]
    TableSize {
        /// Whose table.
        category: String,
        /// How many rows it has.
        rows: usize,
        /// How many numbers the first row of another length than the options' has, or all rows have.
        columns: usize,
        /// How many options the category has.
        size: usize,
    },
    /// A likelihood in a similarity table is not in 0..=1.
    #[error("{value} in the similarity table of \"{category}\" is no likelihood")]
    NoLikelihood {
        /// Whose table.
        category: String,
        /// What was written.
        value: f32,
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
            Self::TableSize { size, .. } => format!(
                "add or take out a row and a column, so that there are {size} of each in the file's order; or \
                 delete the table: all similarity tables may be left out"
            ),
            Self::NoLikelihood { .. } => {
                "write numbers from 0 to 1: a row per option, or a single number for all other options".into()
            }
            Self::EmptyWord(_) => "write what people say or show, or take it out".into(),
            Self::Shared { second, .. } => {
                format!("keep it where it belongs, and take it out of the other or give \"{second}\" another")
            }
            Self::DoneAndNamed { action, thing, .. } => {
                format!("take it out of \"{action}\" or out of \"{thing}\", as nobody could tell which is meant")
            }
            Self::GrammarWord { .. } => "take another word that people say for it".into(),
            Self::UnknownMotion { name, known } => format!(
                "{}the motions are {}; without `motion` the action's own name is taken",
                did_you_mean(name, known.iter().map(String::as_str)),
                quoted(known.iter().map(String::as_str))
            ),
            Self::UnknownGesture { nearest, .. } => format!(
                "did you mean \"{nearest}\"? A gesture of your own (`deictic gestures learn`) needs a name less like it"
            ),
            Self::Reserved(_) => "take another: the README lists the shapes and movements".into(),
            Self::Refused(error) => explain::vocabulary_error(error).remedy,
        }
    }
}
