//! The question that is expected to help most.

use heapless::Vec;

use super::gain;
use crate::category::Category;
use crate::decision::{Kind, Question, Reason, name};
use crate::intent::Intent;
use crate::math::larger;
use crate::trace::Trace;

/// When no category's best option holds this much, nothing was understood.
const LOST: f32 = 0.2;

/// The question of the largest gain per cost about the likeliest intent of a decision of the joint
/// model; `None` when nothing was understood that could be asked about.
#[must_use]
pub fn choose<const N: usize, const C: usize>(
    best: &Intent<C>,
    trace: &Trace<C, N>,
) -> Option<Question> {
    let mut surest = 0.0;
    let mut most = (0.0, Category::ACTION);
    let parameters = best.parameters.iter().map(|p| p.category);
    for category in core::iter::once(Category::ACTION).chain(parameters) {
        let Some(word) = trace.category(category) else {
            continue;
        };
        for p in word.merged() {
            surest = larger(surest, *p);
        }
        let gain = gain::which(word.merged(), trace.belief.noise);
        if gain > most.0 {
            most = (gain, category);
        }
    }
    let (gain, category) = most;
    (surest >= LOST).then(|| put(best, trace, category, Reason::TooClose, gain))
}

/// The question about this category, or about the whole intent, whichever has the larger gain per
/// cost.
#[must_use]
pub fn about<const N: usize, const C: usize>(
    best: &Intent<C>,
    trace: &Trace<C, N>,
    category: Category,
    reason: Reason,
) -> Question {
    let marginal = trace.category(category);
    let marginal = marginal.map_or(&[][..], |word| word.merged());
    let gain = gain::which(marginal, trace.belief.noise);
    put(best, trace, category, reason, gain)
}

/// The question about this category, of which this is the gain, or about the whole intent.
fn put<const N: usize, const C: usize>(
    best: &Intent<C>,
    trace: &Trace<C, N>,
    category: Category,
    reason: Reason,
    gain: f32,
) -> Question {
    let belief = trace.belief;
    let which = gain * (1.0 / gain::WHICH);
    let confirm = gain::confirm(belief.posterior, belief.noise) * (1.0 / gain::CONFIRM);
    let mut question = Question {
        kind: if confirm > which {
            Kind::Confirm
        } else {
            Kind::Which
        },
        action: (category != Category::ACTION).then_some(best.action),
        category,
        reason,
        candidates: Vec::new(),
    };
    if let Some(word) = trace.category(category) {
        name(&mut question, word.merged(), word.judgement.unclear);
    }
    question
}
