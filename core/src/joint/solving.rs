//! From what was heard to the best intent.

use heapless::Vec;

use super::cost::{Costs, MOST};
use super::element::Element;
use super::evidence::Evidence;
use super::factors::{Factors, Marginal, Options};
use super::fits::{Fits, Kind};
use super::likelihoods::Likely;
use super::posterior::Found;
use super::sensors::{Sensor, Tables};
use super::weight::weight;
use super::word::{self, Reading, Room};
use super::{LEVELS, Levels};
use crate::category::Category;
use crate::clarify::{Confirmation, Heard, QUESTIONS};
use crate::sentence::ANSWER;
use crate::vocabulary::Vocabulary;

impl<const C: usize, const N: usize> Evidence<C, N> {
    /// The best intent, after what was said to yes-or-no questions; the marginals of actions,
    /// objects, storages and then of all other categories are filled in.
    pub(super) fn solve<'a, const F: usize>(
        &mut self,
        vocabulary: &Vocabulary<N, C, F>,
        sensors: Tables<'_>,
        confirmations: &[Confirmation],
        mut marginals: [Marginal<'_>; 3],
        others_of: impl Iterator<Item = Marginal<'a>>,
    ) -> Option<Found> {
        let [actions, objects, storages, others @ ..] = &self.words[..] else {
            return None;
        };
        let [live_actions, live_objects, live_storages] = self.live.each_ref().map(|l| l.options());
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
        let heard = actions.iter().zip(&self.raised).zip(live_actions);
        for (sum, ((plain, raised), a)) in self.work.sums.iter_mut().zip(heard) {
            let prior = self.prior.get(usize::from(*a)).copied().unwrap_or(0);
            *sum = plain.least(*raised).plus(Costs::all(prior));
        }
        let kinds = self.rows.iter().zip(self.used).zip(&self.fits);
        let mut kinds = kinds.map(|((rows, used), fits)| Kind {
            rows: rows.get(..used).unwrap_or(rows),
            bytes: fits.as_flattened(),
        });
        let [Some(object_fits), Some(storage_fits)] = [kinds.next(), kinds.next()] else {
            return None;
        };
        let factors = Factors {
            deeds: Options::new(live_actions, &self.work.sums),
            things: [
                Options::new(live_objects, objects),
                Options::new(live_storages, storages),
            ],
            fits: Fits {
                kinds: [object_fits, storage_fits],
                of: &self.of,
                stride: N,
            },
            rest,
        };
        let found = if confirmations.is_empty() {
            let [objects, storages] = &mut self.work.weighed;
            factors.solve([objects, storages], &mut marginals)?
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
            factors.revise(&heard, &mut marginals)?
        };
        for ((costs, marginal), q) in others.iter().zip(others_of).zip(3_usize..) {
            if !marginal.of.is_empty() {
                independent(costs, self.spoken.contains(q), &found.shares, marginal);
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
        Likely::new(&likelihoods, weight, true).add(&[0, 1], &mut costs);
        return costs;
    }
    let mut room = Room {
        elements: &mut [Element::NONE; 2],
        sums: &mut [Costs::ZERO; 2],
        raised: &mut [],
        named: &mut [Costs::ZERO; 2],
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
