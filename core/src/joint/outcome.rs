//! From what is believed to what is done: execute when the confidence passes its cut, else ask about
//! the category that is least certain.

use heapless::Vec;

use super::belief::{Belief, Look};
use super::doubt::doubt;
use super::posterior::Found;
use crate::category::Category;
use crate::clarify::choose::{about, choose};
use crate::decision::{CANDIDATES, Decision, Kind, Outcome, Question, Reason, name};
use crate::intent::{Intent, Parameter};
use crate::judgement::{Judgement, bit};
use crate::profile::{Profile, Threshold};
use crate::situation::Situation;
use crate::trace::Trace;

/// An option is offered when its marginal is at least this.
const OFFERED: f32 = 0.01;

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
    let action_spoken = trace.speaks_of(Category::ACTION);
    if let Some(found) = &found {
        let actions = trace.category(Category::ACTION).map(|word| word.merged());
        let action = actions.and_then(|p| p.get(usize::from(found.best.action)).copied());
        trace.belief = Belief {
            posterior: found.posterior,
            action: action.unwrap_or(0.0),
            kinds,
            noise: found.noise,
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
