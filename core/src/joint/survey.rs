//! What the scene allows: which actions are weighed, and which of the things.

use super::fits::{NO_ROW, Part, Rows, WHOLE};
use crate::category::CategorySet;
use crate::vocabulary::Action;

/// How far the words' presence may contradict an action's signature, beside the action that it fits
/// best, before the action is not weighed at all: a word out of place, in nearly every modality.
const PRUNED: u16 = 520;

/// The actions that are examined, and all that is found out about them.
pub struct Survey<'a> {
    /// All actions.
    pub actions: &'a [Action],
    /// The categories that some word speaks of.
    pub spoken: CategorySet,
    /// What the words' presence costs every action; beside the best afterwards.
    pub prior: &'a mut [u16],
    /// Objects, then storages.
    pub kinds: [Rows<'a>; 2],
    /// See [`super::fits::Fits::of`]; those of actions that are not examined mean nothing.
    pub of: &'a mut [[u8; 2]],
    /// How well the best things fit every action; 0 for those that are not to be weighed.
    pub possible: &'a mut [f32],
}

impl Survey<'_> {
    /// Examines actions, likeliest by the words' presence first, until the next is too unlikely
    /// beside the first that can be done.
    #[inline(never)]
    pub fn run(&mut self) {
        for kind in &mut self.kinds {
            kind.used = 0;
            kind.usable.iter_mut().for_each(|flag| *flag = false);
        }
        let mut bar = u16::MAX;
        let mut best = None;
        self.possible.iter_mut().for_each(|p| *p = 0.0);
        // Priors above those examined so far, in rising order: few differ.
        let mut next = self.prior.iter().copied().min();
        while let Some(level) = next.filter(|level| *level <= bar) {
            next = None;
            let places = self
                .prior
                .iter()
                .zip(&mut *self.possible)
                .zip(&mut *self.of);
            for (a, ((&prior, place), of)) in places.enumerate() {
                if prior != level {
                    if prior > level {
                        next = Some(next.map_or(prior, |next: u16| next.min(prior)));
                    }
                    continue;
                }
                let possible = examine(self.actions, a, self.spoken, &mut self.kinds, of);
                if possible > 0.0 {
                    bar = best.get_or_insert(level).saturating_add(PRUNED);
                    *place = possible;
                }
            }
        }
        let best = best.unwrap_or(0);
        for prior in self.prior.iter_mut() {
            *prior = prior.saturating_sub(best);
        }
    }
}

/// How well the best things fit an action; notes its rows.
#[inline(always)]
fn examine(
    actions: &[Action],
    a: usize,
    spoken: CategorySet,
    kinds: &mut [Rows<'_>; 2],
    of: &mut [u8; 2],
) -> f32 {
    let Some(action) = actions.get(a) else {
        return 0.0;
    };
    let mut possible = 1.0;
    for (kind, of) in kinds.iter_mut().zip(of) {
        let part = Part::of(action, spoken, kind.category);
        *of = NO_ROW;
        if part != Part::None {
            let (row, best) = kind.find(actions, a, part);
            *of = row;
            if part == Part::Needed {
                possible *= f32::from(best) * (1.0 / WHOLE);
            }
        }
    }
    possible
}
