//! What speaks against an intent whatever its posterior.

use super::cost::OCTAVE;
use super::fit::product;
use super::posterior::Found;
use crate::category::Category;
use crate::clarify::answered;
use crate::decision::{FEASIBLE, Reason};
use crate::intent::Intent;
use crate::profile::Profile;
use crate::scene::Entity;
use crate::situation::Situation;
use crate::trace::Trace;

/// By how much an option that is not to be had may be clearer, at the noise that was heard, than the
/// one that is: 90 to 1. Above it the person meant just that, and is told.
const CLEARER: u32 = OCTAVE as u32 * 13 / 2;

/// A parameter that nobody gave, a thing that does not fit well, or something else that is clearly meant
/// but cannot be had.
#[inline(never)]
pub(super) fn doubt<
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
>(
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
        if !trace.speaks_of(category) || !given {
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
        let can = |thing: &Entity<F>| {
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
