//! What a decision is: execute, ask or repeat, and why (the paper, Decision over the actions for
//! interaction mode).

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::category::Category;
use crate::intent::Intent;

/// A thing meets a requirement when its alignment is at least this: the middle of likelihoods.
pub const FEASIBLE: f32 = 0.5;

/// How many options a question names at most; people do not keep more in mind.
pub const CANDIDATES: usize = 4;

/// Why something is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Reason {
    /// More than one option is clear.
    SeveralClear,
    /// No option is clear.
    NoneClear,
    /// The best option hardly leads the next.
    TooClose,
    /// Nothing was said or shown of this category.
    Missing,
    /// What was meant is not in the scene.
    NotInScene,
    /// What was meant does not meet the action's requirements.
    Infeasible,
    /// Nothing that was said fits together well enough to act upon.
    Doubtful,
}

/// What kind of answer is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Kind {
    /// An option of the category.
    Which,
    /// Yes or no to the whole likeliest intent, [`Decision::best`].
    Confirm,
}

/// A question about one category.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// What kind of answer is asked for.
    pub kind: Kind,
    /// The action that it is about; `None` when the action itself is asked for.
    pub action: Option<u8>,
    /// What is asked for; of a yes or no what is most in doubt.
    pub category: Category,
    /// Why.
    pub reason: Reason,
    /// The options in question, most likely first; empty when it is open.
    pub candidates: Vec<u8, CANDIDATES>,
}

/// What to do now.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome<const C: usize> {
    /// Do this.
    Execute(Intent<C>),
    /// Ask this first.
    Ask(Question),
    /// Nothing was understood: ask for a repetition.
    Repeat,
    /// As many questions as may be were asked, or nothing is left to ask, and it still is not clear: the person has to start over.
    GiveUp,
}

/// What to do now, and the likeliest intent whatever its clarity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decision<const C: usize> {
    /// What to do now.
    pub outcome: Outcome<C>,
    /// The likeliest action with its likeliest parameters; `None` when no action was expressed.
    pub best: Option<Intent<C>>,
}

/// Names the `open` options as candidates, most likely first, the first among equals.
#[inline(never)]
pub(crate) fn name(question: &mut Question, merged: &[f32], mut open: u64) {
    let mut ranks = [(f32::NEG_INFINITY, 0); CANDIDATES];
    for (option, &w) in merged.iter().enumerate() {
        let is_open = open & 1 != 0;
        open >>= 1;
        if !is_open {
            continue;
        }
        // It takes the place of the first that is less likely, which moves one down, and so on.
        let mut next = (w, option);
        let mut moving = false;
        for rank in &mut ranks {
            moving |= next.0 > rank.0;
            if moving {
                core::mem::swap(rank, &mut next);
            }
        }
    }
    for (_, option) in ranks.iter().filter(|(w, _)| *w > f32::NEG_INFINITY) {
        // There are as many ranks as candidates, and as many options as an open set has bits.
        let _ = question.candidates.push(*option as u8);
    }
}
