//! Which intents the scene and the words' presence allow, and how well.

use super::cost::OCTAVE;
use crate::category::{Category, CategorySet};
use crate::math;
use crate::scene::Entity;
use crate::vocabulary::{Action, Requirement};

/// How often a modality says nothing of a category that the action needs.
const SILENT: f32 = 0.003;
/// How often it speaks of one that the action does not take.
const SURPLUS: f32 = 0.001;
/// The costs of `SILENT` and of `SURPLUS`; those of their contraries are below a half.
const SILENT_COST: u16 = 268;
const SURPLUS_COST: u16 = 319;

/// How far the words' presence may contradict an action's signature, beside the action that it fits
/// best, before the action is not weighed at all: a word out of place, in nearly every modality.
const PRUNED: u16 = 520;

/// A likelihood of 1 in a fit.
pub const WHOLE: f32 = 255.0;

/// The probability that a thing with these feature likelihoods meets a requirement, 0..=1: their
/// product. A feature that is not given counts as 0.
#[must_use]
pub fn product(requirement: Requirement, features: &[f32]) -> f32 {
    let likelihood = |k: usize| features.get(k).copied().unwrap_or(0.0);
    let mut product = 1.0;
    for k in requirement.wanted.iter() {
        product *= likelihood(k);
        if product == 0.0 {
            return 0.0;
        }
    }
    for k in requirement.unwanted.iter() {
        product *= 1.0 - likelihood(k);
        if product == 0.0 {
            return 0.0;
        }
    }
    product
}

/// Adds to every action's `prior` what one modality costs it that speaks of category `q` with
/// probability `p`. A voluntary category says nothing.
#[inline(never)]
pub fn presence(q: usize, p: f32, actions: &[Action], prior: &mut [u16]) {
    let (needed, foreign) = if p <= 0.0 {
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
    for (prior, action) in prior.iter_mut().zip(actions) {
        if action.signature.compulsory.contains(q) {
            *prior = prior.saturating_add(needed);
        } else if !action.signature.voluntary.contains(q) {
            *prior = prior.saturating_add(foreign);
        }
    }
}

/// The entity categories of an action's signature that a sentence which speaks of `spoken` makes it
/// take: what it needs, and what is voluntary and was said.
#[must_use]
pub fn takes(action: &Action, spoken: CategorySet, category: Category) -> bool {
    let q = category.index();
    action.signature.compulsory.contains(q)
        || (action.signature.voluntary.contains(q) && spoken.contains(q))
}

/// The entity categories.
pub const KINDS: [Category; 2] = [Category::OBJECT, Category::STORAGE];

/// The actions that are examined, and all that is found out about them.
pub struct Survey<'a, const F: usize> {
    /// All actions.
    pub actions: &'a [Action],
    /// What is there.
    pub things: &'a [Entity<F>],
    /// The categories that some word speaks of.
    pub spoken: CategorySet,
    /// What the words' presence costs every action; beside the best afterwards.
    pub prior: &'a mut [u16],
    /// How well every option fits every action in 255ths: `stride` objects, then as many storages,
    /// action after action.
    pub fits: &'a mut [u8],
    /// Options that an action has room for in `fits`.
    pub stride: usize,
    /// How well the best things fit every action; 0 for those that are not examined.
    pub possible: &'a mut [f32],
    /// The actions that are weighed.
    pub live: &'a mut [bool],
    /// The objects and the storages that some of them can be done to.
    pub usable: [&'a mut [bool]; 2],
}

impl<const F: usize> Survey<'_, F> {
    /// Examines actions, likeliest by the words' presence first, until the next is too unlikely
    /// beside the first that can be done.
    #[inline(never)]
    pub fn run(&mut self) {
        let n = self.actions.len();
        for flags in [&mut *self.live]
            .into_iter()
            .chain(self.usable.iter_mut().map(|u| &mut **u))
        {
            flags.iter_mut().for_each(|flag| *flag = false);
        }
        self.possible.iter_mut().take(n).for_each(|p| *p = 0.0);
        let mut bar = u16::MAX;
        let mut best = None;
        let mut last = None;
        // Priors above those examined so far, in rising order: few differ.
        let mut next = self.prior.iter().take(n).copied().min();
        while let Some(level) = next.filter(|level| *level <= bar) {
            next = None;
            for a in 0..n {
                let Some(&prior) = self.prior.get(a) else {
                    break;
                };
                if prior > level {
                    next = Some(next.map_or(prior, |next: u16| next.min(prior)));
                }
                if prior != level {
                    continue;
                }
                let possible = self.examine(a, last);
                last = Some(a);
                if let Some(place) = self.possible.get_mut(a) {
                    *place = possible;
                }
                if possible > 0.0 {
                    best = best.or(Some(level));
                    bar = best.unwrap_or(0).saturating_add(PRUNED);
                    if let Some(live) = self.live.get_mut(a) {
                        *live = true;
                    }
                }
            }
        }
        let best = best.unwrap_or(0);
        for prior in self.prior.iter_mut().take(n) {
            *prior = prior.saturating_sub(best);
        }
    }

    /// How well the best things fit an action; `last` is one whose fits are known.
    fn examine(&mut self, at: usize, last: Option<usize>) -> f32 {
        let Some(action) = self.actions.get(at) else {
            return 0.0;
        };
        let last = last.and_then(|last| Some((last, self.actions.get(last)?)));
        let mut possible = 1.0;
        for (kind, (category, usable)) in KINDS.into_iter().zip(&mut self.usable).enumerate() {
            if !takes(action, self.spoken, category) {
                continue;
            }
            let requirement = action.requirement(category);
            let row = |a: usize| {
                a.wrapping_mul(2)
                    .wrapping_add(kind)
                    .wrapping_mul(self.stride)
            };
            let known = last.filter(|(_, last)| {
                takes(last, self.spoken, category) && last.requirement(category) == requirement
            });
            let n = usable.len();
            if let Some((known, _)) = known {
                copy(self.fits, row(known), row(at), n);
            } else if let Some(fits) = self.fits.get_mut(row(at)..row(at).wrapping_add(n)) {
                fits.iter_mut().for_each(|fit| *fit = 0);
                for thing in self.things {
                    if thing.category == category
                        && let Some(fit) = fits.get_mut(usize::from(thing.option))
                    {
                        *fit = (product(requirement, &thing.features) * WHOLE + 0.5) as u8;
                    }
                }
            }
            let mut best = 0;
            let fits = self.fits.get(row(at)..).unwrap_or(&[]);
            for (usable, &fit) in usable.iter_mut().zip(fits) {
                *usable |= fit > 0;
                best = best.max(fit);
            }
            if action.signature.compulsory.contains(category.index()) {
                possible *= f32::from(best) * (1.0 / WHOLE);
            }
        }
        possible
    }
}

/// Copies a row of `n` fits.
fn copy(fits: &mut [u8], from: usize, to: usize, n: usize) {
    let Some((low, high)) = fits.split_at_mut_checked(from.max(to)) else {
        return;
    };
    let (from, to) = if from < to {
        (low.get(from..).unwrap_or_default(), high)
    } else {
        (&*high, low.get_mut(to..).unwrap_or_default())
    };
    for (to, from) in to.iter_mut().zip(from).take(n) {
        *to = *from;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::category::BitSet;

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
        let actions = [action, Action::default()];
        let of = |p| {
            let mut prior = [0; 2];
            presence(1, p, &actions, &mut prior);
            prior
        };
        for (sure, unsure) in [(0.0, 1e-6), (1.0, 1.0 - 1e-6)] {
            for (a, b) in of(sure).into_iter().zip(of(unsure)) {
                assert!(a.abs_diff(b) <= 1, "{a} {b}");
            }
        }
    }
}
