//! How well a thing meets a requirement, and the words' presence a signature.

use super::cost::OCTAVE;
use crate::category::Category;
use crate::math;
use crate::vocabulary::{Action, Requirement};

/// How often a modality says nothing of a category that the action needs.
pub const SILENT: f32 = 0.003;
/// How often it speaks of one that the action does not take.
pub const SURPLUS: f32 = 0.001;
/// The costs of `SILENT` and of `SURPLUS`; those of their contraries are below a half.
const SILENT_COST: u16 = 268;
const SURPLUS_COST: u16 = 319;

/// The probability that a thing with these feature likelihoods meets a requirement, 0..=1: their
/// product. A feature that is not given counts as 0.
#[must_use]
pub fn product(requirement: Requirement, features: &[f32]) -> f32 {
    let likelihood = |k: usize| features.get(k).copied().unwrap_or(0.0);
    let mut product = 1.0;
    for k in requirement.wanted.iter() {
        product *= likelihood(k);
    }
    for k in requirement.unwanted.iter() {
        product *= 1.0 - likelihood(k);
    }
    product
}

/// What it costs actions that words of a category were said or not, by category.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Presence<const C: usize> {
    /// Those that need it.
    needed: [u16; C],
    /// Those that do not take it. One that may be given says nothing.
    foreign: [u16; C],
}

impl<const C: usize> Presence<C> {
    /// Nothing known of any.
    pub const NONE: Self = Self {
        needed: [0; C],
        foreign: [0; C],
    };

    /// Adds what one modality says that speaks of the categories with these probabilities.
    pub fn note(&mut self, present: &[f32]) {
        note(present, &mut self.needed, &mut self.foreign);
    }

    /// Adds that a word of this category was answered: it speaks against actions that do not take it,
    /// and says nothing of other categories.
    pub fn note_answer(&mut self, category: Category) {
        if category != Category::ACTION
            && let Some(foreign) = self.foreign.get_mut(category.index())
        {
            *foreign = foreign.saturating_add(SURPLUS_COST);
        }
    }

    /// What all that was noted costs every action.
    pub fn costs(&self, actions: &[Action], prior: &mut [u16]) {
        costs(&self.needed, &self.foreign, actions, prior);
    }
}

#[inline(never)]
fn note(present: &[f32], needed: &mut [u16], foreign: &mut [u16]) {
    // The first category is the action's own.
    let costs = needed.iter_mut().zip(foreign).zip(present).skip(1);
    for ((needed, foreign), &p) in costs {
        let (n, f) = if p <= 0.0 {
            (SILENT_COST, 0)
        } else if p >= 1.0 {
            (0, SURPLUS_COST)
        } else {
            let cost = |spoken: f32| {
                let mixed = p * spoken + (1.0 - p) * (1.0 - spoken);
                let nats_to_cost = -f32::from(OCTAVE) * core::f32::consts::LOG2_E;
                (math::ln(mixed) * nats_to_cost) as u16
            };
            (cost(1.0 - SILENT), cost(SURPLUS))
        };
        *needed = needed.saturating_add(n);
        *foreign = foreign.saturating_add(f);
    }
}

#[inline(never)]
fn costs(needed: &[u16], foreign: &[u16], actions: &[Action], prior: &mut [u16]) {
    let all: u32 = foreign.iter().map(|cost| u32::from(*cost)).sum();
    let at = |costs: &[u16], q: usize| costs.get(q).map_or(0, |cost| u32::from(*cost));
    // Neighbours are often alike.
    let mut last = None;
    for (prior, action) in prior.iter_mut().zip(actions) {
        if let Some((signature, cost)) = last
            && signature == action.signature
        {
            *prior = cost;
            continue;
        }
        let mut cost = all;
        for q in action.signature.compulsory.iter() {
            cost = cost
                .saturating_add(at(needed, q))
                .saturating_sub(at(foreign, q));
        }
        for q in action.signature.voluntary.iter() {
            cost = cost.saturating_sub(at(foreign, q));
        }
        *prior = cost.min(u32::from(u16::MAX)) as u16;
        last = Some((action.signature, *prior));
    }
}

/// The entity categories.
pub const KINDS: [Category; 2] = [Category::OBJECT, Category::STORAGE];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::category::{BitSet, CategorySet};

    #[test]
    fn a_fit_is_the_chance_that_all_features_are_right() {
        let requirement = Requirement {
            wanted: BitSet(0b011),
            unwanted: BitSet(0b100),
        };
        assert!((product(requirement, &[0.9, 0.8, 0.5]) - 0.36).abs() < 1e-6);
        assert_eq!(product(requirement, &[1.0, 1.0, 0.0]), 1.0);
        assert_eq!(product(requirement, &[1.0]), 0.0);
        assert_eq!(product(Requirement::default(), &[]), 1.0);
    }

    #[test]
    fn certain_presence_is_the_limit_of_uncertain_presence() {
        let mut action = Action::default();
        action.signature.compulsory = CategorySet::EMPTY.with(1);
        let mut voluntary = Action::default();
        voluntary.signature.voluntary = CategorySet::EMPTY.with(1);
        let actions = [action, Action::default(), voluntary];
        let of = |p| {
            let mut prior = [0; 3];
            let mut presence = Presence::<2>::NONE;
            presence.note(&[1.0, p]);
            presence.costs(&actions, &mut prior);
            assert_eq!(prior[2], 0);
            prior
        };
        assert_eq!(of(1.0), [0, SURPLUS_COST, 0]);
        assert_eq!(of(0.0), [SILENT_COST, 0, 0]);
        for (sure, unsure) in [(0.0, 1e-6), (1.0, 1.0 - 1e-6)] {
            for (a, b) in of(sure).into_iter().zip(of(unsure)) {
                assert!(a.abs_diff(b) <= 1, "{a} {b}");
            }
        }
    }
}
