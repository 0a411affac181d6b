//! What became of the commands of one kind.

use deictic_core::decide::Outcome;
use deictic_core::large::Decision;
use serde::Serialize;

use super::Command;

/// Counts of decisions against what was meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// How many decisions there were.
    pub decisions: u32,
    /// The likeliest intent was the one that was meant: action, object and storage.
    pub right: u32,
    /// It was executed, and right.
    pub executed_right: u32,
    /// Something was executed that was not meant.
    pub executed_wrong: u32,
    /// A question was asked.
    pub asked: u32,
    /// A repetition was asked for.
    pub repeated: u32,
}

impl Tally {
    /// Counts a decision.
    pub fn add(&mut self, decision: &Decision, truth: &Command) {
        self.decisions += 1;
        self.right += u32::from(decision.best.as_ref().is_some_and(|best| truth.is(best)));
        match &decision.outcome {
            Outcome::Execute(intent) if truth.is(intent) => self.executed_right += 1,
            Outcome::Execute(_) => self.executed_wrong += 1,
            Outcome::Ask(_) => self.asked += 1,
            Outcome::Repeat | Outcome::GiveUp => self.repeated += 1,
        }
    }

    /// A count as a share of all decisions, in percent.
    #[must_use]
    pub fn percent(&self, count: u32) -> f64 {
        100.0 * f64::from(count) / f64::from(self.decisions.max(1))
    }
}
