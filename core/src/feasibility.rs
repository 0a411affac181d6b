//! Whether an action fits the words that were used and the things that are there (the paper, eq. 7
//! and 10; METHOD, section 3).

use crate::category::Category;
use crate::math::{self, larger};
use crate::vocabulary::{Requirement, Signature};

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

/// How well a thing with these feature likelihoods meets a requirement, in 0..=1: 1 less the
/// largest misalignment |f - wanted| (eq. 8 and 9). A feature that is not given counts as 0.
#[must_use]
pub fn alignment(requirement: Requirement, features: &[f32]) -> f32 {
    let mut worst = 0.0;
    for k in requirement.wanted.iter() {
        worst = larger(worst, 1.0 - features.get(k).copied().unwrap_or(0.0));
    }
    for k in requirement.unwanted.iter() {
        worst = larger(worst, features.get(k).copied().unwrap_or(0.0));
    }
    1.0 - worst
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
