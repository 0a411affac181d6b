//! Whether an action fits the words that were used and the things that are there (the paper, eq. 7
//! and 10; METHOD, section 3).
//!
//! What is worked out for every action stays out of line: it has no capacities, so that it is
//! compiled here, for speed, where its callers are compiled for size with the image.

use crate::category::Category;
use crate::math;
use crate::vocabulary::{Action, Requirement, Signature};

/// How far the categories that were expressed are from an action's signature: L of eq. 7.
///
/// `present[q]` is the probability that category `q` is in the merged sentence; the action's own
/// (`q` = 0) does not count. Voluntary categories cost nothing either way.
#[must_use]
pub fn signature_mismatch(signature: Signature, present: &[f32]) -> f32 {
    let free = signature.voluntary.with(Category::ACTION.index());
    let mut mismatch = 0.0;
    for (q, p) in present.iter().enumerate() {
        if signature.compulsory.contains(q) {
            mismatch += 1.0 - p;
        } else if !free.contains(q) {
            mismatch += p;
        }
    }
    mismatch
}

/// alpha = A^L (eq. 7), given ln A. Exactly 1 when nothing is amiss.
#[must_use]
pub fn alpha(mismatch: f32, ln_penalty: f32) -> f32 {
    if mismatch == 0.0 {
        1.0
    } else {
        math::exp(mismatch * ln_penalty)
    }
}

/// alpha of every action, into `alphas`; `present` and `ln_penalty` as above.
#[inline(never)]
pub fn weigh_signatures(actions: &[Action], present: &[f32], ln_penalty: f32, alphas: &mut [f32]) {
    // Actions of one signature stand together in most vocabularies: one exponential for all.
    let mut last = None;
    for (to, action) in alphas.iter_mut().zip(actions) {
        let signature = action.signature;
        *to = match last {
            Some((known, same)) if known == signature => same,
            _ => alpha(signature_mismatch(signature, present), ln_penalty),
        };
        last = Some((signature, *to));
    }
}

/// The largest misalignment |f - wanted| of a thing with these feature likelihoods (eq. 8), or
/// `limit` as soon as it is no smaller. A feature that is not given counts as 0.
fn misalignment(requirement: Requirement, features: &[f32], limit: f32) -> f32 {
    let mut worst = 0.0;
    for k in requirement.wanted.iter() {
        let amiss = 1.0 - features.get(k).copied().unwrap_or(0.0);
        if amiss > worst {
            worst = amiss;
            if worst >= limit {
                return limit;
            }
        }
    }
    for k in requirement.unwanted.iter() {
        let amiss = features.get(k).copied().unwrap_or(0.0);
        if amiss > worst {
            worst = amiss;
            if worst >= limit {
                return limit;
            }
        }
    }
    worst
}

/// How well a thing with these feature likelihoods meets a requirement, in 0..=1: 1 less its
/// largest misalignment (eq. 9).
#[must_use]
pub fn alignment(requirement: Requirement, features: &[f32]) -> f32 {
    1.0 - misalignment(requirement, features, 1.0)
}

/// How well the best of `things`, each given by its feature likelihoods, meets a requirement: a
/// category's factor of eq. 10. 0 without things.
#[must_use]
pub fn best_alignment(requirement: Requirement, things: &[&[f32]]) -> f32 {
    let mut least = 1.0;
    for features in things {
        least = misalignment(requirement, features, least);
    }
    1.0 - least
}

/// Multiplies into `betas` what each action's requirement on one entity category makes of `things`,
/// those that may be meant. Actions that need nothing of the category keep what they have.
#[inline(never)]
pub fn weigh_requirements(
    actions: &[Action],
    category: Category,
    things: &[&[f32]],
    betas: &mut [f32],
) {
    // Alike actions stand together in most vocabularies.
    let mut last = None;
    for (beta, action) in betas.iter_mut().zip(actions) {
        if !action.signature.compulsory.contains(category.index()) {
            continue;
        }
        let requirement = action.requirement(category);
        let factor = match last {
            Some((known, factor)) if known == requirement => factor,
            _ => best_alignment(requirement, things),
        };
        last = Some((requirement, factor));
        *beta *= factor;
    }
}

/// Applies alpha and beta to the merged action word (eq. 5), and keeps in `heard` what it was.
#[inline(never)]
pub fn apply_penalties(merged: &mut [f32], heard: &mut [f32], alphas: &[f32], betas: &[f32]) {
    let penalties = alphas.iter().zip(betas);
    for ((w, heard), (alpha, beta)) in merged.iter_mut().zip(heard).zip(penalties) {
        *heard = *w;
        *w *= alpha * beta;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::category::{BitSet, CategorySet};

    fn signature() -> Signature {
        Signature {
            compulsory: CategorySet::EMPTY.with(1).with(2),
            voluntary: CategorySet::EMPTY.with(3),
        }
    }

    #[test]
    fn every_category_out_of_place_costs_its_probability() {
        let l = |present: &[f32]| signature_mismatch(signature(), present);
        assert_eq!(l(&[1.0, 1.0, 1.0, 0.0, 0.0]), 0.0);
        assert_eq!(l(&[1.0, 1.0, 1.0, 1.0, 0.0]), 0.0);
        assert_eq!(l(&[1.0, 1.0, 0.0, 0.0, 0.0]), 1.0);
        assert_eq!(l(&[1.0, 0.5, 1.0, 0.0, 0.25]), 0.75);
        assert_eq!(l(&[0.0, 1.0, 1.0]), 0.0);
    }

    #[test]
    fn alpha_is_the_penalty_to_the_power_of_the_mismatch() {
        let ln_a = math::ln(0.2);
        assert_eq!(alpha(0.0, ln_a), 1.0);
        assert!((alpha(1.0, ln_a) - 0.2).abs() < 1e-7);
        assert!((alpha(3.0, ln_a) - 0.008).abs() < 1e-8);
    }

    #[test]
    fn the_papers_example_of_alignment() {
        // f = (1, 0.8, 1, 0, 1, 0.2) against f1 & f2 & f3 & not f6 gives 0.8.
        let requirement = Requirement {
            wanted: BitSet(0b111),
            unwanted: BitSet(0b10_0000),
        };
        let a = alignment(requirement, &[1.0, 0.8, 1.0, 0.0, 1.0, 0.2]);
        assert!((a - 0.8).abs() < 1e-6);
        assert_eq!(alignment(Requirement::default(), &[]), 1.0);
        assert_eq!(alignment(requirement, &[]), 0.0);
    }
}
