//! What was heard and what can be done, kept until the next decision, so that further words can be
//! added to it.

use heapless::Vec;

use super::cost::{Costs, MOST, weight};
use super::fit::Presence;
use super::level::Weighed;
use super::likelihoods::Likely;
use super::posterior::{Found, Marginal, Options, Posterior};
use super::sensors::{Sensor, Tables};
use super::survey::{Fits, Row, Survey, Thing};
use super::word::{self, DEAREST, Element, Reading, Room};
use super::{LEVELS, Levels};
use crate::category::{Category, CategorySet};
use crate::clarify::{Confirmation, Heard, QUESTIONS};
use crate::scene::Scene;
use crate::sentence::{ANSWER, Word};
use crate::trace::CategoryTrace;
use crate::vocabulary::Vocabulary;

/// Words of a category that can be added before costs are cut off: [`MOST`] / [`DEAREST`].
const MANY: u8 = 7;

/// What the words' presence can cost an action at most: with seven words it stays below [`MOST`].
const DEAREST_PRIOR: u16 = DEAREST;

/// The factors of a posterior: `C` categories, `N` options at most.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence<const C: usize, const N: usize> {
    /// What every option costs, by category; of actions those that are live.
    words: [[Costs; N]; C],
    /// What the actions cost should those of other signatures be raised.
    raised: [Costs; N],
    /// What its own element costs every action, object and storage.
    named: [[Costs; N]; 3],
    /// How many words of every category there were.
    count: [u8; C],
    /// The options that are weighed, of actions, objects and storages.
    live: [Vec<u8, N>; 3],
    /// What it says that words of a category were said or not.
    presence: Presence<C>,
    /// What the words' presence costs every action.
    prior: [u16; N],
    /// See [`Fits`], for which these are as many rows as can be.
    rows: [[Row; 2]; N],
    /// How many are in use.
    used: usize,
    of: [[u8; 2]; N],
    fits: [[[u8; N]; 2]; N],
    /// The categories that some word speaks of.
    spoken: CategorySet,
    work: Work<N>,
}

/// Room to work in, which no stack has to give.
#[derive(Clone, Debug, PartialEq)]
struct Work<const N: usize> {
    elements: [Element; N],
    sums: [Costs; N],
    raised: [Costs; N],
    usable: [[bool; N]; 2],
    weighed: [[Weighed; 2]; N],
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
            live: [const { Vec::new() }; 3],
            presence: Presence::NONE,
            prior: [0; N],
            rows: [[Row::NONE; 2]; N],
            used: 0,
            of: [[0; 2]; N],
            fits: [[[0; N]; 2]; N],
            spoken: CategorySet::EMPTY,
            work: Work {
                elements: [Element::NONE; N],
                sums: [Costs::ZERO; N],
                raised: [Costs::ZERO; N],
                usable: [[false; N]; 2],
                weighed: [[Weighed::NONE; 2]; N],
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
        let mut things = Vec::<Thing<'_>, E>::new();
        for entity in scene.entities() {
            // A scene has no more things than these.
            let _ = things.push(Thing {
                category: entity.category,
                option: entity.option,
                features: &entity.features,
            });
        }
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
        let mut counts = vocabulary.options().iter().skip(1).map(|&n| usize::from(n));
        let mut usable = self.work.usable.each_mut().map(|flags| {
            let n = counts.next().unwrap_or(0);
            flags.get_mut(..n).unwrap_or_default()
        });
        self.used = Survey {
            actions,
            things: &things,
            spoken: self.spoken,
            prior: &mut *prior,
            rows: self.rows.as_flattened_mut(),
            of: &mut self.of,
            bytes: self.fits.as_flattened_mut().as_flattened_mut(),
            stride: N,
            possible: &mut *possible,
            usable: usable.each_mut().map(|usable| &mut **usable),
        }
        .run();
        let [actions, things @ ..] = &mut self.live;
        list(actions, possible.iter().map(|p| *p > 0.0));
        for (list_of, usable) in things.iter_mut().zip(usable) {
            list(list_of, usable.iter().copied());
        }
        for (alpha, prior) in alpha.iter_mut().zip(prior) {
            *prior = (*prior).min(DEAREST_PRIOR);
            *alpha = weight(u32::from(*prior));
        }
        let categories = self.words.iter_mut().zip(vocabulary.options()).enumerate();
        for (_, (words, &n)) in categories.filter(|(q, _)| !self.spoken.contains(*q)) {
            clear(words, n);
        }
        let categories = self.named.iter_mut().zip(vocabulary.options()).enumerate();
        for (_, (named, &n)) in categories.filter(|(q, _)| !self.spoken.contains(*q)) {
            clear(named, n);
        }
        if !self.spoken.contains(0) {
            clear(&mut self.raised, u8::MAX);
        }
    }

    /// Adds a word of `category`, which a modality of this weight reported.
    pub fn hear<const F: usize>(
        &mut self,
        vocabulary: &Vocabulary<N, C, F>,
        sensors: Tables<'_>,
        modality: u8,
        category: Category,
        said: &Word<C, N>,
        weight: f32,
    ) {
        let q = category.index();
        let likelihoods = said.likelihoods();
        let n = likelihoods.len();
        let p = said.categories().get(q).copied().unwrap_or(0.0);
        let (Some(words), Some(count)) = (self.words.get_mut(q), self.count.get_mut(q)) else {
            return;
        };
        self.spoken = self.spoken.with(q);
        let Work {
            elements,
            sums,
            raised,
            ..
        } = &mut self.work;
        let mut all = Vec::<u8, N>::new();
        let live = self.live.get(q).unwrap_or_else(|| {
            for option in (0_u8..).take(n) {
                // There are no more options than places.
                let _ = all.push(option);
            }
            &all
        });
        let mut nobody = [];
        let named = self.named.get_mut(q).map_or(&mut nobody[..], |named| named);
        if *count >= MANY {
            for costs in words.iter_mut().chain(&mut *named).chain(&mut self.raised) {
                *costs = costs.least(Costs::all(MOST.wrapping_sub(DEAREST)));
            }
        }
        let first = *count == 0;
        *count = count.saturating_add(1);
        let rows = match sensors.sensor(modality, category, n) {
            Sensor::Scores(rows) => rows,
            Sensor::Likelihoods => {
                let said = Likely::new(likelihoods, word::in_256ths(weight * p), first);
                said.add(words);
                said.add(named);
                if category == Category::ACTION {
                    said.add(&mut self.raised);
                }
                return;
            }
        };
        let reading = Reading {
            likelihoods,
            rows,
            live,
            weight: word::in_256ths(weight * p),
            first,
        };
        let mut room = Room {
            elements: elements.get_mut(..n).unwrap_or_default(),
            sums,
            raised,
            named,
        };
        if category == Category::ACTION {
            word::action(
                &reading,
                vocabulary.actions(),
                &mut room,
                words,
                &mut self.raised,
            );
        } else {
            word::parameter(&reading, &mut room, words);
        }
    }

    /// What its own elements cost each option of an action, object or storage; empty otherwise.
    pub(super) fn named(&self, category: Category) -> &[Costs] {
        self.named.get(category.index()).map_or(&[], |named| named)
    }

    /// The best intent, after what was said to yes-or-no questions; its marginals go to the merged
    /// words.
    pub(crate) fn solve<const F: usize>(
        &mut self,
        vocabulary: &Vocabulary<N, C, F>,
        sensors: Tables<'_>,
        confirmations: &[Confirmation],
        categories: &mut [CategoryTrace<N>; C],
    ) -> Option<Found> {
        let [actions, objects, storages, others @ ..] = &self.words[..] else {
            return None;
        };
        let [live_actions, live_objects, live_storages] = &self.live;
        let mut rest = [0; LEVELS];
        let counts = vocabulary.options().iter().skip(3);
        let spoken = others.iter().zip(counts).zip(3_usize..);
        for ((costs, &n), _) in spoken.filter(|(_, q)| self.spoken.contains(*q)) {
            let mut least = Costs::all(MOST);
            for costs in costs.iter().take(usize::from(n)) {
                least = least.least(*costs);
            }
            for (rest, least) in rest.iter_mut().zip(least.lanes()) {
                *rest = u32::from(least).saturating_add(*rest);
            }
        }
        for &a in live_actions {
            let a = usize::from(a);
            let heard = actions
                .get(a)
                .zip(self.raised.get(a))
                .zip(self.prior.get(a));
            if let (Some(sum), Some(((plain, raised), prior))) = (self.work.sums.get_mut(a), heard)
            {
                *sum = plain.least(*raised).plus(Costs::all(*prior));
            }
        }
        let rows = self.rows.as_flattened();
        let posterior = Posterior {
            deeds: Options::new(live_actions, &self.work.sums),
            things: [
                Options::new(live_objects, objects),
                Options::new(live_storages, storages),
            ],
            fits: Fits {
                rows: rows.get(..self.used).unwrap_or(rows),
                of: &self.of,
                bytes: self.fits.as_flattened().as_flattened(),
                stride: N,
            },
            rest,
        };
        let [action, object, storage, traces @ ..] = &mut categories[..] else {
            return None;
        };
        let mut marginals = [marginal(action), marginal(object), marginal(storage)];
        let found = if confirmations.is_empty() {
            posterior.solve(self.work.weighed.as_flattened_mut(), &mut marginals)?
        } else {
            let heard = confirmations.iter().map(|answer| {
                let [it, others] = yes_or_no(sensors, answer.likelihoods);
                Heard {
                    asked: answer.asked,
                    it,
                    others,
                }
            });
            let heard: Vec<Heard, QUESTIONS> = heard.take(QUESTIONS).collect();
            posterior.revise(&heard, &mut marginals)?
        };
        for ((costs, trace), q) in others.iter().zip(traces).zip(3_usize..) {
            if trace.options > 0 {
                independent(
                    costs,
                    self.spoken.contains(q),
                    &found.shares,
                    marginal(trace),
                );
            }
        }
        Some(found)
    }
}

/// What a yes or a no costs: a word of two options, from whatever reports the answers that name actions.
#[inline(never)]
fn yes_or_no(sensors: Tables<'_>, likelihoods: [f32; 2]) -> [Costs; 2] {
    let mut costs = [Costs::ZERO; 2];
    let weight = word::in_256ths(1.0);
    if let Sensor::Likelihoods = sensors.sensor(ANSWER, Category::ACTION, 2) {
        Likely::new(&likelihoods, weight, true).add(&mut costs);
        return costs;
    }
    let mut room = Room {
        elements: &mut [Element::NONE; 2],
        sums: &mut [Costs::ZERO; 2],
        raised: &mut [],
        named: &mut [],
    };
    let reading = Reading {
        likelihoods: &likelihoods,
        rows: Tables::NONE.rows(ANSWER, Category::ACTION, 2),
        live: &[0, 1],
        weight,
        first: true,
    };
    word::parameter(&reading, &mut room, &mut costs);
    costs
}

/// Makes a list of the options that are flagged.
fn list<const N: usize>(list: &mut Vec<u8, N>, flags: impl Iterator<Item = bool>) {
    list.clear();
    for (option, _) in (0_u8..).zip(flags).filter(|(_, flag)| *flag) {
        // There are no more options than places.
        let _ = list.push(option);
    }
}

#[inline(never)]
fn clear(costs: &mut [Costs], n: u8) {
    let used = costs.iter_mut().take(usize::from(n));
    used.for_each(|costs| *costs = Costs::ZERO);
}

fn marginal<const N: usize>(word: &mut CategoryTrace<N>) -> Marginal<'_> {
    let (of, weights) = word.merged_and_h();
    Marginal { of, weights }
}

/// The marginal of a category whose options are not things, so that every action likes all alike.
#[inline(never)]
fn independent(costs: &[Costs], spoken: bool, shares: &Levels, marginal: Marginal<'_>) {
    marginal.of.fill(0.0);
    if !spoken {
        return;
    }
    for (b, share) in shares.iter().enumerate().filter(|(_, share)| **share > 0.0) {
        let options = costs.iter().take(marginal.of.len());
        let least = options.map(|costs| costs.at(b)).min().unwrap_or(0);
        let mut total = 0.0;
        for (to, costs) in marginal.weights.iter_mut().zip(costs) {
            *to = weight(costs.at(b).saturating_sub(least));
            total += *to;
        }
        for (p, weight) in marginal.of.iter_mut().zip(&*marginal.weights) {
            *p += share * weight / total;
        }
    }
}
