//! What the core found, in words: errors with what to do about them, questions to the person, and
//! the figures behind a decision.

mod errors;
mod faults;
mod fitness;
mod question;
pub mod reasons;
mod shown;

pub use errors::{profile_error, scene_error, sentence_error, vocabulary_error};
pub use faults::{distrust, fault, loss, sensor_error};
pub use fitness::because;
pub use question::{amount, intent, question};
pub use shown::sentence;

/// An error in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Advice {
    /// What is wrong.
    pub what: String,
    /// What to do about it.
    pub remedy: String,
}

impl Advice {
    pub(crate) fn new(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self {
            what: what.into(),
            remedy: remedy.into(),
        }
    }
}
