//! Clarification: when a decision has to ask, which question helps most, and what its answer is worth.
//!
//! A posterior is a prior times the likelihood of each piece of evidence, so that an answer is one
//! more factor and never a new start: what was said and shown stays, the answer is added, and all
//! is decided again on the scene as it is now.
//!
//! * An answer that names an option ("the cup") is a word, weighed as any other by
//!   [`crate::joint::word`]. It says nothing about which words the command has: a person who answers
//!   "the cup" has not fallen silent about the storage.
//! * A yes or a no to a whole intent is a word of two options. It speaks of one intent and of none of
//!   its parts, so that the posterior no longer is a product over categories: [`revise`] sums it
//!   intent by intent.
//! * [`gain`] says what a question is expected to tell, per cost, and chooses.
//!
//! Answers are as noisy as any other word. A decision after a question looks at a command once more,
//! and every further look is another chance to be wrong: the cuts that count all looks together are in
//! [`calibration`].

pub mod answered;
pub mod calibration;
pub mod choose;
pub mod gain;
pub mod revise;

use crate::intent::Intent;
use crate::joint::cost::Costs;
use crate::joint::fit::KINDS;
use crate::joint::posterior::Triple;

/// How many questions can be asked about one command at most.
pub const QUESTIONS: usize = 4;

impl Triple {
    /// The action, object and storage of an intent.
    #[must_use]
    pub fn of<const C: usize>(intent: &Intent<C>) -> Self {
        let option = |category| intent.option(category);
        Self {
            action: intent.action,
            things: KINDS.map(option),
        }
    }
}

/// What a person said to a yes-or-no question.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Confirmation {
    /// The intent that was asked about.
    pub asked: Triple,
    /// How likely the answer sounded like yes, and like no; 0..=1 each.
    pub likelihoods: [f32; 2],
}

/// What an answer costs the intent that was asked about, and all others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heard {
    /// The intent that was asked about.
    pub asked: Triple,
    /// What the answer costs it: the cost of a yes.
    pub it: Costs,
    /// What the answer costs all others: the cost of a no.
    pub others: Costs,
}
