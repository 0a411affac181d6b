//! What answers say for and against executing an intent, beside what they are worth in the posterior.
//!
//! The posterior weighs only what can be done. When the thing that the person named or said yes to has
//! gone meanwhile, something else would be the likeliest by default: then it is asked about.

use crate::category::{Category, CategorySet};
use crate::decision::{FEASIBLE, Reason};
use crate::intent::Intent;
use crate::joint::fit::product;
use crate::joint::posterior::Triple;
use crate::math;
use crate::observations::Observations;
use crate::sentence::ANSWER;
use crate::situation::Situation;

/// By how much an answered option must be clearer than the chosen one: 4 to 1, twice its logarithm.
const CLEARER: f32 = 2.77;

/// Variance of a word's errors at every noise level of the joint model; at the first, where they are
/// small or large by chance, that of the second.
const VARIANCE: [f32; crate::joint::LEVELS] = [0.04, 0.04, 0.16, 0.36];

/// Whether the person has answered for this option of an intent: named it, or said yes to the intent.
#[must_use]
pub fn vouched<const W: usize, const C: usize, const N: usize>(
    observations: &Observations<W, C, N>,
    best: &Intent<C>,
    category: Category,
    chosen: u8,
) -> bool {
    let said_yes = observations.confirmations().iter().any(|answer| {
        let [yes, no] = answer.likelihoods;
        answer.asked == Triple::of(best) && yes > no
    });
    let answers = observations.get(ANSWER);
    let mut words = answers.into_iter().flat_map(|answer| answer.words());
    said_yes
        || words.any(|word| {
            word.category() == Some(category)
                && math::argmax(word.likelihoods()) == Some(usize::from(chosen))
        })
}

/// By how much the likeliest of what an answer may have been leads when it was clear: by this much at the first two noise
/// levels, by chance in one answer of six at the third.
const CLEAR: f32 = 0.95;

/// Whether it was clearly answered already whether this very intent is meant.
#[must_use]
pub fn confirmed<const W: usize, const C: usize, const N: usize>(
    observations: &Observations<W, C, N>,
    intent: &Intent<C>,
) -> bool {
    let asked = Triple::of(intent);
    let answers = observations.confirmations();
    answers.iter().any(|answer| {
        let [yes, no] = answer.likelihoods;
        answer.asked == asked && (yes - no >= CLEAR || no - yes >= CLEAR)
    })
}

/// The categories of which an option was clearly named in an answer.
#[must_use]
pub fn named<const W: usize, const C: usize, const N: usize>(
    observations: &Observations<W, C, N>,
) -> CategorySet {
    let answers = observations.get(ANSWER);
    let words = answers.into_iter().flat_map(|answer| answer.words());
    let clear = words.filter(|word| {
        let likelihoods = word.likelihoods();
        let first = math::argmax(likelihoods);
        let (mut led, mut lead) = (0.0, 0.0);
        for (option, p) in likelihoods.iter().enumerate() {
            match Some(option) == first {
                true => lead = *p,
                false => led = math::larger(led, *p),
            }
        }
        lead - led >= CLEAR
    });
    clear.filter_map(|word| word.category()).collect()
}

/// What was clearly answered, at this noise level, and is not to be had: its category, and why.
#[must_use]
#[inline(never)]
pub fn gone<const N: usize, const C: usize, const F: usize, const E: usize, const W: usize>(
    situation: Situation<'_, N, C, F, E, W>,
    best: &Intent<C>,
    level: usize,
) -> Option<(Category, Reason)> {
    let variance = VARIANCE.get(level).copied().unwrap_or(1.0);
    // Twice the logarithm of how much likelier the first is to have been said than the second.
    let ratio = |a: f32, b: f32| ((1.0 - b) * (1.0 - b) - (1.0 - a) * (1.0 - a)) / variance;
    let why_not = |action: u8, category, option| {
        let action = situation.vocabulary.actions().get(usize::from(action))?;
        match situation.scene.find(category, option) {
            None => Some(Reason::NotInScene),
            Some(thing) => {
                let fit = product(action.requirement(category), &thing.features);
                (fit < FEASIBLE).then_some(Reason::Infeasible)
            }
        }
    };
    let answers = situation.observations.get(ANSWER);
    for word in answers.into_iter().flat_map(|answer| answer.words()) {
        let Some(category) = word.category().filter(|category| category.is_entity()) else {
            continue;
        };
        let (Some(chosen), Some(meant)) = (
            best.option(category),
            math::argmax(word.likelihoods()).and_then(|o| u8::try_from(o).ok()),
        ) else {
            continue;
        };
        let sounds = |option: u8| {
            let likelihood = word.likelihoods().get(usize::from(option));
            likelihood.copied().unwrap_or(0.0)
        };
        if ratio(sounds(meant), sounds(chosen)) > CLEARER
            && let Some(reason) = why_not(best.action, category, meant)
        {
            return Some((category, reason));
        }
    }
    for answer in situation.observations.confirmations() {
        let [yes, no] = answer.likelihoods;
        if answer.asked == Triple::of(best) || ratio(yes, no) <= CLEARER {
            continue;
        }
        let kinds = [Category::OBJECT, Category::STORAGE];
        for (category, option) in kinds.into_iter().zip(answer.asked.things) {
            if let Some(option) = option
                && let Some(reason) = why_not(answer.asked.action, category, option)
            {
                return Some((category, reason));
            }
        }
    }
    None
}
