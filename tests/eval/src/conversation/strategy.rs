//! Which question is put.

use deictic_core::board;
use deictic_core::category::Category;
use deictic_core::clarify::choose::choose;
use deictic_core::decide::{Decision, Kind as Asks, Outcome};
use rand::Rng;
use rand::seq::IndexedRandom;

/// Which question is put when one is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Strategy {
    /// The core's: the largest expected gain per cost.
    Gain,
    /// Always a yes or no to the likeliest intent.
    Confirm,
    /// Any of the yes or no and the categories of the likeliest intent, by chance.
    Random,
    /// Everything is said once more, and counts as more of the same.
    Again,
    /// Everything is said and shown once more, and what was before is forgotten.
    Repeat,
}

impl Strategy {
    /// All, the core's first.
    pub const ALL: [Self; 5] = [
        Self::Gain,
        Self::Confirm,
        Self::Random,
        Self::Again,
        Self::Repeat,
    ];
}

/// What is put to the person.
#[derive(Clone, Copy, Debug)]
pub(super) enum Put {
    /// Yes or no to the likeliest intent.
    Confirm,
    /// An option of a category.
    Which(Category),
    /// Everything once more.
    Again,
    /// Everything from the beginning.
    Over,
}

impl Strategy {
    /// The question that is put after a decision.
    pub(super) fn question(
        self,
        decision: &Decision<{ board::CATEGORIES }>,
        observations: &board::Observations,
        trace: &board::Trace,
        rng: &mut impl Rng,
    ) -> Put {
        let Some(best) = decision.best.as_ref() else {
            return Put::Over;
        };
        match self {
            Self::Gain => {
                let question = match &decision.outcome {
                    Outcome::Ask(question) => Some(question.clone()),
                    _ => choose(best, observations, trace),
                };
                match question {
                    None => Put::Over,
                    Some(question) if question.kind == Asks::Confirm => Put::Confirm,
                    Some(question) => Put::Which(question.category),
                }
            }
            Self::Confirm => Put::Confirm,
            Self::Random => {
                let mut all = vec![Put::Confirm, Put::Which(Category::ACTION)];
                all.extend(best.parameters.iter().map(|p| Put::Which(p.category)));
                all.choose(rng).copied().unwrap_or(Put::Confirm)
            }
            Self::Again => Put::Again,
            Self::Repeat => Put::Over,
        }
    }
}
