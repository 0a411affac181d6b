//! From what is believed to what is done: execute when the confidence passes its cut, else ask about
//! the category that is least certain.

use heapless::Vec;

use super::belief::{Belief, Look};
use super::cost::OCTAVE;
use super::fit::product;
use super::posterior::Found;
use crate::category::Category;
use crate::clarify::answered;
use crate::clarify::choose::{about, choose};
use crate::decision::{CANDIDATES, Decision, FEASIBLE, Kind, Outcome, Question, Reason, name};
use crate::intent::{Intent, Parameter};
use crate::judgement::{Judgement, bit};
use crate::profile::{Profile, Threshold};
use crate::situation::Situation;
use crate::trace::Trace;

/// An option is offered when its marginal is at least this.
const OFFERED: f32 = 0.01;

/// By how much an option that is not to be had may be clearer, at the noise that was heard, than the
/// one that is: 90 to 1. Above it the person meant just that, and is told.
const CLEARER: u32 = OCTAVE as u32 * 13 / 2;

/// The outcome of a solved posterior; completes the trace. A question that may not be asked any more
/// gives up.
#[inline(never)]
pub fn outcome<const N: usize, const C: usize, const F: usize, const E: usize, const W: usize>(
    situation: Situation<'_, N, C, F, E, W>,
    profile: &Profile,
    found: Option<Found>,
    trace: &mut Trace<C, N>,
) -> Decision<C> {
    let left = profile
        .questions
        .saturating_sub(situation.observations.answers());
    // Filled in where it stays: one that is moved costs 300 instructions.
    let mut decision = Decision {
        outcome: Outcome::Repeat,
        best: None,
    };
    decide(situation, profile, left, found, trace, &mut decision);
    if left == 0 && matches!(decision.outcome, Outcome::Ask(_)) {
        decision.outcome = Outcome::GiveUp;
    }
    decision
}

fn decide<const N: usize, const C: usize, const F: usize, const E: usize, const W: usize>(
    situation: Situation<'_, N, C, F, E, W>,
    profile: &Profile,
    left: u8,
    found: Option<Found>,
    trace: &mut Trace<C, N>,
    decision: &mut Decision<C>,
) {
    let (mut spoken, mut kinds) = (false, 0_u8);
    let used = situation.vocabulary.options().len();
    for (q, word) in trace.categories_mut().iter_mut().enumerate().take(used) {
        let present = word.present > 0.0;
        spoken |= present;
        kinds = kinds.saturating_add(u8::from(present && q <= Category::STORAGE.index()));
        let (marginal, weights) = word.merged_and_h();
        word.judgement = settle(marginal, weights, found.is_some());
        word.entropy = 0.0;
        word.threshold = 0.0;
    }
    if !spoken {
        return;
    }
    let action_spoken = present(trace, Category::ACTION);
    if let Some(found) = &found {
        let actions = trace.category(Category::ACTION).map(|word| word.merged());
        let action = actions.and_then(|p| p.get(usize::from(found.best.action)).copied());
        trace.belief = Belief {
            action: action.unwrap_or(0.0),
            kinds,
            ..found.belief
        };
    }
    let Some(found) = found.filter(|_| action_spoken) else {
        let reason = if action_spoken {
            Reason::Infeasible
        } else {
            Reason::Missing
        };
        decision.outcome = Outcome::Ask(ask(None, Category::ACTION, reason, trace));
        return;
    };
    let best = decision.best.insert(Intent {
        action: found.best.action,
        parameters: Vec::new(),
    });
    let others = complete(situation, &found, trace, best);
    trace.belief.posterior *= others;
    let question = match doubt(situation, profile, &found, best, trace) {
        Some((category, Reason::Missing)) => ask(Some(best), category, Reason::Missing, trace),
        Some((category, reason)) => about(best, situation.observations, trace, category, reason),
        None => {
            let suffices = match profile.threshold {
                Threshold::Risk { rate } => {
                    let look = Look::of(profile.questions, left);
                    trace.belief.suffices(rate, look)
                }
                _ => true,
            };
            if suffices {
                mark(best, trace);
                decision.outcome = Outcome::Execute(best.clone());
                return;
            }
            let Some(question) = choose(best, situation.observations, trace) else {
                if situation.observations.answers() > 0 {
                    decision.outcome = Outcome::GiveUp;
                }
                return;
            };
            question
        }
    };
    decision.outcome = Outcome::Ask(question);
}

fn present<const N: usize, const C: usize>(trace: &Trace<C, N>, category: Category) -> bool {
    trace
        .category(category)
        .is_some_and(|word| word.present > 0.0)
}

/// Adds an intent's parameters; gives how likely the options are that are not things.
fn complete<const N: usize, const C: usize, const F: usize, const E: usize, const W: usize>(
    situation: Situation<'_, N, C, F, E, W>,
    found: &Found,
    trace: &Trace<C, N>,
    intent: &mut Intent<C>,
) -> f32 {
    let mut likelihood = 1.0;
    let Some(action) = situation
        .vocabulary
        .actions()
        .get(usize::from(intent.action))
    else {
        return likelihood;
    };
    let signature = action.signature;
    let [object, storage] = found.best.things;
    for q in signature.compulsory.union(signature.voluntary).iter() {
        let (Some(category), Some(word)) = (Category::from_index(q), trace.categories().get(q))
        else {
            continue;
        };
        let option = match category {
            Category::OBJECT => object,
            Category::STORAGE => storage,
            _ if word.present > 0.0 => {
                let best = word.judgement.best;
                let p = best.and_then(|o| word.merged().get(usize::from(o)).copied());
                likelihood *= p.unwrap_or(1.0);
                best
            }
            _ => None,
        };
        if let Some(option) = option {
            // At most one parameter per category, and there are C categories.
            let _ = intent.parameters.push(Parameter {
                category,
                option,
                quantity: word.quantity,
            });
        }
    }
    likelihood
}

/// What speaks against an intent whatever its posterior: a parameter that nobody gave, a thing that
/// does not fit well, and something else that is clearly meant but cannot be had.
#[inline(never)]
fn doubt<const N: usize, const C: usize, const F: usize, const E: usize, const W: usize>(
    situation: Situation<'_, N, C, F, E, W>,
    profile: &Profile,
    found: &Found,
    best: &Intent<C>,
    trace: &Trace<C, N>,
) -> Option<(Category, Reason)> {
    if !profile.guarded {
        return None;
    }
    let actions = situation.vocabulary.actions();
    let action = actions.get(usize::from(best.action))?;
    for q in action.signature.compulsory.iter() {
        let category = Category::from_index(q)?;
        // A word that is there may be too faint for any of its options to be the best.
        let given = best.parameters.iter().any(|p| p.category == category);
        if !present(trace, category) || !given {
            return Some((category, Reason::Missing));
        }
    }
    if let Some(gone) = answered::gone(situation, best, found.level) {
        return Some(gone);
    }
    let clearest = |category: Category, chosen: u8| {
        if answered::vouched(situation.observations, best, category, chosen) {
            return None;
        }
        // At the first level errors are small or large by chance, which says nothing of what is meant.
        let level = found.level.max(1);
        let named = trace.evidence.named(category);
        let named = named.get(..trace.category(category)?.merged().len())?;
        let at = |o: u8| named.get(usize::from(o)).map(|costs| costs.at(level));
        let least = (0_u8..)
            .zip(named)
            .min_by_key(|(_, costs)| costs.at(level))?;
        let clearer = at(chosen)?.saturating_sub(least.1.at(level)) > CLEARER;
        clearer.then_some(least.0)
    };
    for parameter in best.parameters.iter().filter(|p| p.category.is_entity()) {
        let category = parameter.category;
        let fits = |option| {
            let thing = situation.scene.find(category, option)?;
            Some(product(action.requirement(category), &thing.features) >= FEASIBLE)
        };
        if fits(parameter.option) != Some(true) {
            return Some((category, Reason::Infeasible));
        }
        if let Some(meant) = clearest(category, parameter.option) {
            match fits(meant) {
                None => return Some((category, Reason::NotInScene)),
                Some(false) => return Some((category, Reason::Infeasible)),
                Some(true) => {}
            }
        }
    }
    let meant = clearest(Category::ACTION, best.action)?;
    let meant = actions.get(usize::from(meant))?;
    for category in [Category::OBJECT, Category::STORAGE] {
        let can = |thing: &crate::scene::Entity<F>| {
            thing.category == category
                && product(meant.requirement(category), &thing.features) >= FEASIBLE
        };
        let needed = meant.signature.compulsory.contains(category.index());
        if needed && !situation.scene.entities().iter().any(can) {
            return Some((Category::ACTION, Reason::Infeasible));
        }
    }
    None
}

/// What leads in a marginal; nothing is clear yet.
#[inline(never)]
fn settle(marginal: &mut [f32], weights: &mut [f32], solved: bool) -> Judgement {
    weights.iter_mut().for_each(|weight| *weight = 0.0);
    if !solved {
        marginal.iter_mut().for_each(|p| *p = 0.0);
    }
    let (mut first, mut second) = (0.0, 0.0);
    let mut judgement = Judgement::NOTHING;
    let mut bit = 1_u64;
    for (o, &p) in marginal.iter().enumerate() {
        if p > second {
            if p > first {
                second = first;
                first = p;
                judgement.best = Some(o as u8);
            } else {
                second = p;
            }
        }
        if p >= OFFERED {
            judgement.unclear |= bit;
        }
        bit = bit.wrapping_shl(1);
    }
    judgement.lead = first - second;
    judgement
}

/// Notes in the trace that the options of an executed intent were clear.
fn mark<const N: usize, const C: usize>(intent: &Intent<C>, trace: &mut Trace<C, N>) {
    let mut clear = |category: Category, option| {
        if let Some(word) = trace.categories_mut().get_mut(category.index()) {
            word.judgement.clear = bit(option);
            word.judgement.unclear &= !word.judgement.clear;
        }
    };
    clear(Category::ACTION, intent.action);
    for parameter in &intent.parameters {
        clear(parameter.category, parameter.option);
    }
}

/// A question, its options by marginal.
fn ask<const N: usize, const C: usize>(
    best: Option<&Intent<C>>,
    category: Category,
    reason: Reason,
    trace: &Trace<C, N>,
) -> Question {
    let mut question = Question {
        kind: Kind::Which,
        action: best
            .map(|best| best.action)
            .filter(|_| category != Category::ACTION),
        category,
        reason,
        candidates: Vec::<u8, CANDIDATES>::new(),
    };
    if let Some(word) = trace.category(category) {
        name(&mut question, word.merged(), word.judgement.unclear);
    }
    question
}
