//! What was heard and what can be done, kept until the next decision, so that further words can be
//! added to it.

use heapless::Vec;

use super::cost::Costs;
use super::element::Element;
use super::fit::Presence;
use super::fits::{Row, Rows, Thing};
use super::level::Weighed;
use super::survey::Survey;
use super::weight::weight;
use super::word::DEAREST;
use crate::category::{Category, CategorySet};
use crate::scene::Scene;
use crate::vocabulary::Vocabulary;

/// What the words' presence can cost an action at most: with seven words it stays below [`MOST`].
const DEAREST_PRIOR: u16 = DEAREST;

/// The factors of a posterior: `C` categories, `N` options at most.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence<const C: usize, const N: usize> {
    /// What every live option costs, by category.
    pub(super) words: [[Costs; N]; C],
    /// What the live actions cost should those of other signatures be raised.
    pub(super) raised: [Costs; N],
    /// What its own element costs every action, object and storage.
    pub(super) named: [[Costs; N]; 3],
    /// How many words of every category there were.
    pub(super) count: [u8; C],
    /// The options that are weighed, of actions, objects and storages.
    pub(super) live: [Live<N>; 3],
    /// What it says that words of a category were said or not.
    presence: Presence<C>,
    /// What the words' presence costs every action.
    pub(super) prior: [u16; N],
    /// See [`Fits`], for which these are as many rows of objects and of storages as can be.
    pub(super) rows: [[Row; N]; 2],
    /// How many are in use.
    pub(super) used: [usize; 2],
    pub(super) of: [[u8; 2]; N],
    pub(super) fits: [[[u8; N]; N]; 2],
    /// The categories that some word speaks of.
    pub(super) spoken: CategorySet,
    pub(super) work: Work<N>,
}

/// Room to work in, which no stack has to give.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Work<const N: usize> {
    pub(super) elements: [Element; N],
    pub(super) sums: [Costs; N],
    pub(super) raised: [Costs; N],
    pub(super) usable: [[bool; N]; 2],
    pub(super) weighed: [[Weighed; N]; 2],
}

impl<const C: usize, const N: usize> Default for Evidence<C, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const C: usize, const N: usize> Evidence<C, N> {
    /// Of nothing heard.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            words: [[Costs::ZERO; N]; C],
            raised: [Costs::ZERO; N],
            named: [[Costs::ZERO; N]; 3],
            count: [0; C],
            live: [Live::NONE; 3],
            presence: Presence::NONE,
            prior: [0; N],
            rows: [[Row::NONE; N]; 2],
            used: [0; 2],
            of: [[0; 2]; N],
            fits: [[[0; N]; N]; 2],
            spoken: CategorySet::EMPTY,
            work: Work {
                elements: [Element::NONE; N],
                sums: [Costs::ZERO; N],
                raised: [Costs::ZERO; N],
                usable: [[false; N]; 2],
                weighed: [[Weighed::NONE; N]; 2],
            },
        }
    }

    /// Forgets what was heard.
    pub(super) fn restart(&mut self) {
        self.spoken = CategorySet::EMPTY;
        self.presence = Presence::NONE;
        self.count = [0; C];
    }

    /// Notes with which probability one modality spoke of each category, and whether it did at all.
    pub(super) fn note(&mut self, present: &[f32], spoken: CategorySet) {
        self.spoken = self.spoken.union(spoken);
        self.presence.note(present);
    }

    /// Notes that a person answered with a word of a category.
    pub(super) fn note_answer(&mut self, category: Category) {
        self.spoken = self.spoken.with(category.index());
        self.presence.note_answer(category);
    }

    /// Finds what the scene allows, given which categories were spoken of; leaves in the trace's
    /// figures what the presence of words and the things make of every action.
    #[inline(never)]
    pub(super) fn survey<const F: usize, const E: usize>(
        &mut self,
        vocabulary: &Vocabulary<N, C, F>,
        scene: &Scene<E, F>,
        alpha: &mut [f32; N],
        beta: &mut [f32; N],
    ) {
        let mut objects = Vec::<Thing<'_>, N>::new();
        let mut storages = Vec::<Thing<'_>, N>::new();
        things(scene, Category::OBJECT, &mut objects);
        things(scene, Category::STORAGE, &mut storages);
        let actions = vocabulary.actions();
        let used = actions.len();
        let (Some(prior), Some(possible), Some(alpha)) = (
            self.prior.get_mut(..used),
            beta.get_mut(..used),
            alpha.get_mut(..used),
        ) else {
            return;
        };
        self.presence.costs(actions, prior);
        let [object_rows, storage_rows] = &mut self.rows;
        let [object_fits, storage_fits] = &mut self.fits;
        let [usable_objects, usable_storages] = &mut self.work.usable;
        let mut survey = Survey {
            actions,
            spoken: self.spoken,
            prior: &mut *prior,
            kinds: [
                Rows {
                    category: Category::OBJECT,
                    things: &objects,
                    rows: object_rows,
                    used: 0,
                    bytes: object_fits.as_flattened_mut(),
                    stride: N,
                    usable: usable_objects,
                },
                Rows {
                    category: Category::STORAGE,
                    things: &storages,
                    rows: storage_rows,
                    used: 0,
                    bytes: storage_fits.as_flattened_mut(),
                    stride: N,
                    usable: usable_storages,
                },
            ],
            of: &mut self.of,
            possible: &mut *possible,
        };
        survey.run();
        let [actions, live @ ..] = &mut self.live;
        let kinds = survey.kinds.iter_mut().zip(live).zip(&mut self.used);
        for ((kind, live), used) in kinds {
            live.count = kind.close(&mut live.options);
            *used = kind.used;
        }
        actions.count = list(possible, &mut actions.options);
        for (alpha, prior) in alpha.iter_mut().zip(prior) {
            *prior = (*prior).min(DEAREST_PRIOR);
            *alpha = weight(u32::from(*prior));
        }
        let unheard = |q: usize| q < vocabulary.options().len() && !self.spoken.contains(q);
        let words = self.words.iter_mut().enumerate();
        words
            .filter(|(q, _)| unheard(*q))
            .for_each(|(_, words)| clear(words));
        let named = self.named.iter_mut().enumerate();
        named
            .filter(|(q, _)| unheard(*q))
            .for_each(|(_, named)| clear(named));
        if !self.spoken.contains(0) {
            clear(&mut self.raised);
        }
    }

    /// What its own elements cost each option of an action, object or storage; empty otherwise.
    pub(super) fn named(&self, category: Category) -> &[Costs] {
        self.named.get(category.index()).map_or(&[], |named| named)
    }
}

/// Lists the things of a kind by option.
fn things<'a, const N: usize, const F: usize, const E: usize>(
    scene: &'a Scene<E, F>,
    category: Category,
    things: &mut Vec<Thing<'a>, N>,
) {
    for entity in scene.entities() {
        if entity.category == category {
            let thing = Thing {
                option: entity.option,
                features: &entity.features,
            };
            // A scene has no more things of a kind than there are options.
            let _ = things.push(thing);
        }
    }
    by_option(things);
}

#[inline(never)]
fn by_option(things: &mut [Thing<'_>]) {
    let mut upto = things.len();
    while upto > 1 {
        let mut last = 0;
        for i in 1..upto {
            if let Some([a, b]) = things.get_mut(i.wrapping_sub(1)..=i)
                && a.option > b.option
            {
                core::mem::swap(a, b);
                last = i;
            }
        }
        upto = last;
    }
}

/// The options of a category that are weighed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Live<const N: usize> {
    options: [u8; N],
    count: usize,
}

impl<const N: usize> Live<N> {
    const NONE: Self = Self {
        options: [0; N],
        count: 0,
    };

    /// In rising order.
    pub(super) fn options(&self) -> &[u8] {
        self.options.get(..self.count).unwrap_or(&self.options)
    }
}

/// Lists the actions that are possible at all; gives how many there are.
#[inline(never)]
fn list(possible: &[f32], live: &mut [u8]) -> usize {
    let mut count = 0_usize;
    for (option, _) in (0_u8..).zip(possible).filter(|(_, p)| **p > 0.0) {
        if let Some(place) = live.get_mut(count) {
            *place = option;
        }
        count = count.saturating_add(1);
    }
    count
}

#[inline(never)]
fn clear(costs: &mut [Costs]) {
    costs.iter_mut().for_each(|costs| *costs = Costs::ZERO);
}
