//! The question that is expected to help most.

use heapless::Vec;

use super::{answered, gain};
use crate::category::Category;
use crate::decision::{Kind, Question, Reason, name};
use crate::intent::Intent;
use crate::math::larger;
use crate::observations::Observations;
use crate::trace::Trace;

/// When no category's best option holds this much, nothing was understood.
const LOST: f32 = 0.2;

/// The question of the largest gain per cost about the likeliest intent of a decision of the joint
/// model; `None` when nothing was understood that could be asked about, or nothing is left to ask.
///
/// What was clearly answered is not asked again: whoever has said yes to an intent, or named an object, cannot know what else to
/// say. An answer that was not clear is worth hearing once more.
#[must_use]
pub fn choose<const W: usize, const N: usize, const C: usize>(
    best: &Intent<C>,
    observations: &Observations<W, C, N>,
    trace: &Trace<C, N>,
) -> Option<Question> {
    let named = answered::named(observations);
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
        if gain > most.0 && !named.contains(category.index()) {
            most = (gain, category);
        }
    }
    let (gain, category) = most;
    let nothing_left = gain <= 0.0 && answered::confirmed(observations, best);
    (surest >= LOST && !nothing_left)
        .then(|| put(best, observations, trace, category, Reason::TooClose, gain))
}

/// The question about this category, or about the whole intent, whichever has the larger gain per
/// cost.
#[must_use]
pub fn about<const W: usize, const N: usize, const C: usize>(
    best: &Intent<C>,
    observations: &Observations<W, C, N>,
    trace: &Trace<C, N>,
    category: Category,
    reason: Reason,
) -> Question {
    let marginal = trace.category(category);
    let marginal = marginal.map_or(&[][..], |word| word.merged());
    let gain = gain::which(marginal, trace.belief.noise);
    put(best, observations, trace, category, reason, gain)
}

/// The question about this category, of which this is the gain, or about the whole intent.
fn put<const W: usize, const N: usize, const C: usize>(
    best: &Intent<C>,
    observations: &Observations<W, C, N>,
    trace: &Trace<C, N>,
    category: Category,
    reason: Reason,
    gain: f32,
) -> Question {
    let belief = trace.belief;
    let which = gain * (1.0 / gain::WHICH);
    let confirm = gain::confirm(belief.posterior, belief.noise) * (1.0 / gain::CONFIRM);
    let mut question = Question {
        kind: if confirm > which && !answered::confirmed(observations, best) {
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
