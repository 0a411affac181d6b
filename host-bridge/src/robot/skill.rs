//! The motions a robot knows.

use std::ops::Range;

use deictic_core::category::Category;
use deictic_core::large::Intent;

use super::Refusal;
use crate::vocabulary::{Lexicon, VocabularyProblem};

/// A motion. An action of the vocabulary stands for one by its `motion`, or by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Skill {
    /// Raise the hand.
    MoveUp,
    /// Set down what the hand holds and let go.
    Release,
    /// Stand still.
    Stop,
    /// Grasp a thing and lift it.
    Pick,
    /// Push a thing along the table.
    Push,
    /// Twist a glued thing loose.
    Unglue,
    /// Tilt a full thing over a container.
    Pour,
    /// Put a thing into a container.
    PutInto,
    /// Put a thing on another.
    Stack,
}

impl Skill {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::MoveUp,
        Self::Release,
        Self::Stop,
        Self::Pick,
        Self::Push,
        Self::Unglue,
        Self::Pour,
        Self::PutInto,
        Self::Stack,
    ];

    /// Its name in a vocabulary file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::MoveUp => "move-up",
            Self::Release => "release",
            Self::Stop => "stop",
            Self::Pick => "pick",
            Self::Push => "push",
            Self::Unglue => "unglue",
            Self::Pour => "pour",
            Self::PutInto => "put-into",
            Self::Stack => "stack",
        }
    }

    /// The motion of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|skill| skill.name() == name)
    }

    /// Whether every motion that a vocabulary names is one. An action without one of this name can be
    /// understood and is not moved for.
    ///
    /// # Errors
    /// The place of the first that is none.
    pub fn check(lexicon: &Lexicon) -> Result<(), (Range<usize>, VocabularyProblem)> {
        let actions = (0..=u8::MAX).zip(lexicon.entries(Category::ACTION));
        for (action, _) in actions {
            let motion = lexicon.motion(action).unwrap_or_default();
            if let (None, Some(place)) = (Self::named(motion), lexicon.motion_place(action)) {
                let problem = VocabularyProblem::UnknownMotion {
                    name: motion.to_owned(),
                    known: Self::ALL.map(|skill| skill.name().to_owned()).to_vec(),
                };
                return Err((place, problem));
            }
        }
        Ok(())
    }

    /// The motion that an intent's action stands for.
    ///
    /// # Errors
    /// [`Refusal::UnknownMotion`] when there is no such motion.
    pub fn of(intent: &Intent, lexicon: &Lexicon) -> Result<Self, Refusal> {
        let motion = lexicon.motion(intent.action).unwrap_or_default();
        Self::named(motion).ok_or_else(|| Refusal::UnknownMotion(motion.to_owned()))
    }
}
