//! The paper's user study replayed (Real datasets): table set-ups, each with the command that was
//! meant and two that contradict it, given by gesture, by language or by both.

mod file;
mod tally;

use deictic_core::category::Category;
use deictic_core::large::{Intent, Sentence};
use deictic_core::sentence::{GESTURE, LANGUAGE, SentenceError};

use crate::scene::Tabletop;
use crate::sensor::Sensors;
pub use file::read;
pub use tally::Tally;

/// Set-ups that cannot be used.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum SetupsError {
    /// The file cannot be read.
    #[error("cannot read {file}")]
    #[diagnostic(help("name the JSON file of the set-ups"))]
    Unreadable {
        /// Its path.
        file: String,
        /// What the system said.
        #[source]
        cause: std::io::Error,
    },
    /// It is not the JSON that was expected.
    #[error("{file} is not a list of set-ups")]
    #[diagnostic(help(
        "every set-up has subset, run, truth, scene, wrong_action and wrong_object"
    ))]
    Malformed {
        /// Its path.
        file: String,
        /// Where and why.
        #[source]
        cause: serde_json::Error,
    },
    /// A set-up names something that the vocabulary does not have.
    #[error("{file}, set-up {setup}: {what}")]
    #[diagnostic(help("use a vocabulary with these names, or correct the set-up"))]
    Unknown {
        /// Its path.
        file: String,
        /// Its place in the file, counted from 1.
        setup: usize,
        /// What is unknown.
        what: String,
    },
}

/// A table and three commands.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Its subset and number.
    pub name: String,
    /// What is on the table.
    pub table: Tabletop,
    /// The command that was meant; the only one of the three that can be done.
    pub truth: Command,
    /// The same with an action that cannot be.
    pub wrong_action: Command,
    /// The same with an object it cannot be done to.
    pub wrong_object: Command,
}

/// A command by options.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Command {
    /// The action.
    pub action: u8,
    /// The object that was named.
    pub object: Option<u8>,
    /// The storage that was named.
    pub storage: Option<u8>,
}

impl Command {
    /// Whether an intent is this command: action, object and storage.
    #[must_use]
    pub fn is(&self, intent: &Intent) -> bool {
        intent.action == self.action
            && intent.option(Category::OBJECT) == self.object
            && intent.option(Category::STORAGE) == self.storage
    }

    /// What the sensors of a modality make of it.
    ///
    /// # Errors
    /// As [`Sensors::word`].
    pub fn observe(
        &self,
        modality: u8,
        sensors: &mut Sensors<'_>,
    ) -> Result<Sentence, SentenceError> {
        let words = [
            (Category::ACTION, Some(self.action)),
            (Category::OBJECT, self.object),
            (Category::STORAGE, self.storage),
        ];
        let mut sentence = Sentence::new(modality);
        for (category, option) in words {
            if let Some(option) = option {
                sentence.push(sensors.word(modality, category, option)?)?;
            }
        }
        Ok(sentence)
    }
}

/// Who is given which command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Both modalities are given the true command.
    Aligned,
    /// The action that is said is wrong.
    WrongActionSaid,
    /// The action that is shown is wrong.
    WrongActionShown,
    /// The object that is said is wrong.
    WrongObjectSaid,
    /// The object that is shown is wrong.
    WrongObjectShown,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Aligned,
        Self::WrongActionSaid,
        Self::WrongActionShown,
        Self::WrongObjectSaid,
        Self::WrongObjectShown,
    ];

    /// What it is called in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Aligned => "aligned",
            Self::WrongActionSaid => "wrong action said",
            Self::WrongActionShown => "wrong action shown",
            Self::WrongObjectSaid => "wrong object said",
            Self::WrongObjectShown => "wrong object shown",
        }
    }

    /// What the sensors make of a set-up under it: the gesture's sentence and language's.
    ///
    /// # Errors
    /// As [`Sensors::word`].
    pub fn observe(
        self,
        setup: &Setup,
        sensors: &mut Sensors<'_>,
    ) -> Result<[Sentence; 2], SentenceError> {
        let (shown, said) = match self {
            Self::Aligned => (setup.truth, setup.truth),
            Self::WrongActionSaid => (setup.truth, setup.wrong_action),
            Self::WrongActionShown => (setup.wrong_action, setup.truth),
            Self::WrongObjectSaid => (setup.truth, setup.wrong_object),
            Self::WrongObjectShown => (setup.wrong_object, setup.truth),
        };
        Ok([
            shown.observe(GESTURE, sensors)?,
            said.observe(LANGUAGE, sensors)?,
        ])
    }
}
