//! What was typed or spoken and waits for its turn.

use deictic_core::sentence::{GESTURE, LANGUAGE};

use crate::language::Spoken;

/// What is between said and shown in a line.
pub const BETWEEN: &str = "//";

/// What waits for its turn.
pub enum Input {
    /// A line that was typed.
    Line(String),
    /// An utterance that was heard.
    Spoken(Spoken),
}

impl Input {
    /// What it says, in words.
    pub fn text(&self) -> &str {
        match self {
            Self::Line(text) => text,
            Self::Spoken(spoken) => spoken.best(),
        }
    }

    /// The modality that it is, where it is only one.
    pub fn modality(&self) -> Option<u8> {
        match self {
            Self::Spoken(_) => Some(LANGUAGE),
            Self::Line(text) => match text.split_once(BETWEEN) {
                None => Some(LANGUAGE),
                Some((said, _)) if said.trim().is_empty() => Some(GESTURE),
                Some(_) => None,
            },
        }
    }
}
