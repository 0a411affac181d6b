//! What can be seen of a session from outside.

use std::time::Duration;

use deictic_core::decide::Question;
use deictic_core::large::Sentence;

use super::Session;
use crate::robot::Posture;
use crate::scene::Tabletop;
use crate::unit::GestureUnit;
use crate::vocabulary::Lexicon;

impl<'a> Session<'a> {
    /// The table as it is now.
    #[must_use]
    pub fn table(&self) -> &Tabletop {
        &self.table
    }

    /// The names of everything.
    #[must_use]
    pub fn lexicon(&self) -> &'a Lexicon {
        self.lexicon
    }

    /// The unit.
    #[must_use]
    pub fn unit(&self) -> &GestureUnit {
        &self.unit
    }

    /// The question that waits for the person's answer.
    #[must_use]
    pub fn question(&self) -> Option<&Question> {
        self.question.as_ref().map(|(_, question)| question)
    }

    /// What is in the robot's hand.
    #[must_use]
    pub fn holding(&self) -> Option<&str> {
        self.robot.holding()
    }

    /// How many percent of its command the robot has done, while it is doing one.
    #[must_use]
    pub fn progress(&self) -> Option<u8> {
        self.robot.progress(self.now()).map(|(_, percent)| percent)
    }

    /// How the arm stands, where the robot says so.
    #[must_use]
    pub fn posture(&self) -> Option<Posture> {
        self.robot.posture(self.now())
    }

    /// Whether nothing is going on: no decision is waited for, the robot stands still, nothing is
    /// queued. A question may be open.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        self.due.is_none()
            && self.doing.is_none()
            && self.overtaken.is_empty()
            && self.queue.is_empty()
            && self.reasons.is_none()
            && self.happened.is_empty()
    }

    /// Whether the unit waits for what this modality observes, having heard of another.
    #[must_use]
    pub fn is_waiting_for(&self, modality: u8) -> bool {
        self.due.is_some()
            && self.doing.is_none()
            && self.question.is_none()
            && !self.stopping
            && !self.spoken.is_empty()
            && self.spoken.iter().all(|s| s.modality() != modality)
    }

    /// How long what is said and what is shown may lie apart and belong together.
    #[must_use]
    pub fn window(&self) -> Duration {
        Duration::from_micros(self.configuration.window.0)
    }

    /// Whether the unit was told all that it waits for, so that a decision comes at once.
    #[must_use]
    pub fn is_deciding(&self) -> bool {
        let bit = |s: &Sentence| 1_u8.checked_shl(u32::from(s.modality())).unwrap_or(0);
        let told = self.spoken.iter().fold(0, |told, s| told | bit(s));
        let expected = self.configuration.expected;
        let overruled = self.stopping || self.forbidding > 0;
        self.due.is_some() && !overruled && !self.is_moving() && told & expected == expected
    }

    /// Whether a hand is in the middle of a sentence.
    #[must_use]
    pub fn is_showing(&self) -> bool {
        self.showing.is_some()
    }

    /// Whether the robot is doing something, or has been told to stop and does not stand yet.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        self.doing.is_some() || !self.overtaken.is_empty()
    }

    /// Whether the robot is held in the middle of a command.
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.doing.as_ref().is_some_and(|doing| doing.held)
    }
}
