//! The posterior after a yes or a no to a whole intent, summed intent by intent.
//!
//! ```text
//! p(I | answers) = sum over levels of  evidence(I) x product over answers of (I was asked about ? yes : no) / total
//! ```
//!
//! It visits every intent that can be done: 85 in the paper's vocabulary, at most 1,024 on the board's
//! build, about 100 instructions each.

use super::Heard;
use crate::joint::cost::Costs;
use crate::joint::factors::{Factors, Marginal, Options};
use crate::joint::fits::{Part, WHOLE};
use crate::joint::posterior::{Found, Triple};
use crate::joint::weight::weight;
use crate::joint::{LEVELS, Levels};
use crate::math;

/// What an intent takes of one kind of thing.
#[derive(Clone, Copy)]
struct Choice {
    option: Option<u8>,
    costs: Costs,
    /// What its weight at every level is multiplied by.
    shares: Levels,
}

/// What has been summed up.
struct Sum {
    levels: Levels,
    largest: f32,
    best: Option<Triple>,
}

impl Factors<'_> {
    /// The best intent after the answers; the marginals of actions, objects and storages are filled
    /// in. `None` when nothing can be done.
    #[inline(never)]
    pub fn revise(&self, heard: &[Heard], marginals: &mut [Marginal<'_>; 3]) -> Option<Found> {
        for marginal in marginals.iter_mut() {
            marginal.of.iter_mut().for_each(|p| *p = 0.0);
        }
        let [objects, storages] = self.things;
        let none = [objects, storages].map(|options| options.mean());
        let [a, o, s] = [self.deeds, objects, storages].map(|options| options.least());
        let mut least = u32::MAX;
        for ((((a, o), s), rest), b) in a
            .lanes()
            .into_iter()
            .zip(o.lanes())
            .zip(s.lanes())
            .zip(self.rest)
            .zip(0..)
        {
            let of_answers = heard.iter().map(|h| h.it.at(b).min(h.others.at(b)));
            let sum = of_answers.fold(rest, u32::saturating_add);
            let sum = [a, o, s]
                .into_iter()
                .fold(sum, |sum, x| sum.saturating_add(u32::from(x)));
            least = least.min(sum);
        }
        let mut sum = Sum {
            levels: [0.0; LEVELS],
            largest: 0.0,
            best: None,
        };
        for (&deed, own) in self.deeds.live.iter().zip(self.deeds.costs) {
            self.visit((deed, *own), least, &none, heard, marginals, &mut sum);
        }
        let total: f32 = sum.levels.iter().sum();
        // Not above 0 either when it is not a number.
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        let per_total = 1.0 / total;
        for marginal in marginals.iter_mut() {
            marginal.of.iter_mut().for_each(|p| *p *= per_total);
        }
        let shares = sum.levels.map(|level| level * per_total);
        let (mut noise, mut knot, mut most) = (0.0, 0.0, (0.0, 0));
        for (b, share) in shares.iter().enumerate() {
            noise += share * knot;
            knot += 1.0;
            if *share > most.0 {
                most = (*share, b);
            }
        }
        Some(Found {
            best: sum.best?,
            posterior: math::clamp_unit(sum.largest * per_total),
            noise,
            shares,
            level: most.1,
        })
    }

    /// Adds all intents of one action.
    fn visit(
        &self,
        (deed, own): (u8, Costs),
        least: u32,
        [no_object, no_storage]: &[Choice; 2],
        heard: &[Heard],
        marginals: &mut [Marginal<'_>; 3],
        sum: &mut Sum,
    ) {
        let a = usize::from(deed);
        for object in self.choices(a, 0, *no_object) {
            for storage in self.choices(a, 1, *no_storage) {
                let triple = Triple {
                    action: deed,
                    things: [object.option, storage.option],
                };
                let mut all = 0.0;
                let shares = object.shares.into_iter().zip(storage.shares);
                let levels = sum.levels.iter_mut().zip(self.rest).zip(shares);
                for (b, ((level, rest), (of_object, of_storage))) in levels.enumerate() {
                    let mut cost = rest;
                    for part in [own, object.costs, storage.costs] {
                        cost = cost.saturating_add(part.at(b));
                    }
                    for answer in heard {
                        let its = if answer.asked == triple {
                            answer.it
                        } else {
                            answer.others
                        };
                        cost = cost.saturating_add(its.at(b));
                    }
                    let mass = of_object * of_storage * weight(cost.saturating_sub(least));
                    *level += mass;
                    all += mass;
                }
                let options = [Some(deed), object.option, storage.option];
                for (marginal, option) in marginals.iter_mut().zip(options) {
                    if let Some(p) = option.and_then(|o| marginal.of.get_mut(usize::from(o))) {
                        *p += all;
                    }
                }
                if all > sum.largest {
                    sum.largest = all;
                    sum.best = Some(triple);
                }
            }
        }
    }

    /// What of a kind of thing an action can be done to. What it does not take counts with the mean
    /// over all options, whatever it names.
    fn choices(&self, a: usize, kind: usize, none: Choice) -> impl Iterator<Item = Choice> + '_ {
        let (part, fits) = self.fits.of(a, kind);
        let [objects, storages] = self.things;
        let options = if kind == 0 { objects } else { storages };
        let unit = match part {
            Part::Needed => 1.0 / WHOLE,
            _ => options.per_count / WHOLE,
        };
        let none = (part == Part::None).then_some(none);
        let live = options.live.iter().zip(options.costs).zip(fits);
        live.filter(|(_, fit)| **fit > 0)
            .map(move |((&option, &costs), &fit)| Choice {
                option: Some(option),
                costs,
                shares: [f32::from(fit) * unit; LEVELS],
            })
            .chain(none)
    }
}

impl Options<'_> {
    /// What an intent takes that takes none of them: the mean of all.
    fn mean(&self) -> Choice {
        let costs = self.least();
        let mut shares = [1.0; LEVELS];
        for (b, share) in shares
            .iter_mut()
            .enumerate()
            .filter(|_| !self.live.is_empty())
        {
            let mut sum = 0.0;
            for option in self.costs {
                sum += weight(option.at(b).saturating_sub(costs.at(b)));
            }
            *share = sum * self.per_count;
        }
        Choice {
            option: None,
            costs,
            shares,
        }
    }
}

#[cfg(test)]
mod tests;
