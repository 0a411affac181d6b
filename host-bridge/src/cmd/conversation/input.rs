//! What was typed or spoken and waits for its turn.

use std::time::{Duration, Instant};

use deictic_core::large::Sentence;
use deictic_core::sentence::{GESTURE, LANGUAGE};

use crate::clock;
use crate::language::Spoken;

/// What is between said and shown in a line.
pub const BETWEEN: &str = "//";

/// What is said and what is shown in a line; either may be empty.
pub fn parts(line: &str) -> (&str, &str) {
    match line.split_once(BETWEEN) {
        None => (line.trim(), ""),
        Some((said, shown)) => (said.trim(), shown.trim()),
    }
}

/// What waits for its turn.
pub enum Input {
    /// A line that was typed.
    Line(String),
    /// An utterance that was heard.
    Spoken(Spoken),
    /// What was waiting or being done, as it was corrected.
    Corrected {
        /// How it was corrected.
        text: String,
        /// What is to be done now.
        sentence: Box<Sentence>,
    },
}

impl Input {
    /// What it says, in words.
    pub fn text(&self) -> &str {
        match self {
            Self::Line(text) | Self::Corrected { text, .. } => text,
            Self::Spoken(spoken) => spoken.best(),
        }
    }

    /// Whether it has words in it that somebody may have meant.
    pub fn says_something(&self) -> bool {
        self.modality() != Some(GESTURE) && !self.text().is_empty()
    }

    /// The modality that it is, where it is only one.
    pub fn modality(&self) -> Option<u8> {
        match self {
            Self::Spoken(_) | Self::Corrected { .. } => Some(LANGUAGE),
            Self::Line(text) => match text.split_once(BETWEEN) {
                None => Some(LANGUAGE),
                Some((said, _)) if said.trim().is_empty() => Some(GESTURE),
                Some(_) => None,
            },
        }
    }
}

/// Something that waits, and since when.
pub struct Waiting {
    /// What.
    pub input: Input,
    /// Whether it came while a decision was about to be made, and nobody knew yet what it speaks of.
    pub held: bool,
    came: Instant,
}

impl Waiting {
    /// It comes now.
    pub fn new(input: Input) -> Self {
        Self {
            input,
            held: false,
            came: clock::now(),
        }
    }

    /// It comes now, while a decision is about to be made.
    pub fn held(input: Input) -> Self {
        Self {
            held: true,
            ..Self::new(input)
        }
    }

    /// Whether it is nothing but a gesture that was shown within the last `window`.
    pub fn is_shown_within(&self, window: Duration) -> bool {
        self.input.modality() == Some(GESTURE) && clock::since(self.came) < window
    }
}
