//! The posterior after a yes or a no to a whole intent, summed intent by intent.
//!
//! ```text
//! p(I | answers) = sum over levels of  evidence(I) x product over answers of (I was asked about ? yes : no) / total
//! ```
//!
//! It visits every intent that can be done: 85 in the paper's vocabulary, at most 1,024 on the board's
//! build, about 100 instructions each.

use super::Heard;
use crate::joint::belief::Belief;
use crate::joint::cost::{Costs, weight};
use crate::joint::posterior::{Found, Marginal, Options, Posterior, Triple};
use crate::joint::survey::{Part, WHOLE};
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

impl Posterior<'_> {
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
        for &deed in self.deeds.live {
            self.visit(deed, least, &none, heard, marginals, &mut sum);
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
            belief: Belief {
                posterior: math::clamp_unit(sum.largest * per_total),
                noise,
            },
            shares,
            level: most.1,
        })
    }

    /// Adds all intents of one action.
    fn visit(
        &self,
        deed: u8,
        least: u32,
        [no_object, no_storage]: &[Choice; 2],
        heard: &[Heard],
        marginals: &mut [Marginal<'_>; 3],
        sum: &mut Sum,
    ) {
        let a = usize::from(deed);
        let Some(own) = self.deeds.costs.get(a) else {
            return;
        };
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
                    for part in [*own, object.costs, storage.costs] {
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
        let live = if part == Part::None {
            &[]
        } else {
            options.live
        };
        live.iter()
            .filter_map(move |&option| {
                let at = usize::from(option);
                let fit = fits.get(at).copied().filter(|fit| *fit > 0)?;
                Some(Choice {
                    option: Some(option),
                    costs: options.costs.get(at).copied()?,
                    shares: [f32::from(fit) * unit; LEVELS],
                })
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
            for &o in self.live {
                let cost = self
                    .costs
                    .get(usize::from(o))
                    .map_or(0, |costs| costs.at(b));
                sum += weight(cost.saturating_sub(costs.at(b)));
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
mod tests {
    use super::*;
    use crate::category::{Category, CategorySet};
    use crate::joint::level::Weighed;
    use crate::joint::survey::{Fits, Row, Survey, Thing};
    use crate::vocabulary::Action;
    use std::vec::Vec;

    const N: usize = 4;

    /// Some numbers, alike on every machine.
    fn some(seed: &mut u32, below: u32) -> u32 {
        *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (*seed >> 8) % below
    }

    #[test]
    fn what_costs_all_alike_changes_nothing() {
        let mut actions = [Action::default(); 3];
        actions[1].signature.compulsory = CategorySet::EMPTY.with(1);
        actions[1].object.wanted = CategorySet::EMPTY.with(0);
        actions[2].signature.compulsory = CategorySet::EMPTY.with(1).with(2);
        actions[2].object.wanted = CategorySet::EMPTY.with(1);
        actions[2].storage.unwanted = CategorySet::EMPTY.with(0);
        let spoken = CategorySet::EMPTY.with(0).with(1).with(2);
        for round in 0..200 {
            let seed = &mut (round + 1);
            let features: Vec<[f32; 2]> = (0..2 * N)
                .map(|_| std::array::from_fn(|_| [0.0, 0.6, 1.0][some(seed, 3) as usize]))
                .collect();
            let things: Vec<Thing<'_>> = (0_u8..)
                .zip(&features)
                .map(|(i, features)| Thing {
                    category: if i < 4 {
                        Category::OBJECT
                    } else {
                        Category::STORAGE
                    },
                    option: i % 4,
                    features,
                })
                .collect();
            let (mut rows, mut of, mut bytes) = ([Row::NONE; 6], [[0; 2]; 3], [0; 6 * N]);
            let used = Survey {
                actions: &actions,
                things: &things,
                spoken,
                prior: &mut [0; 3],
                rows: &mut rows,
                of: &mut of,
                bytes: &mut bytes,
                stride: N,
                possible: &mut [0.0; 3],
                usable: [&mut [false; N], &mut [false; N]],
            }
            .run();
            let mut costs = |n: usize| -> Vec<Costs> {
                (0..n)
                    .map(|_| Costs::new(std::array::from_fn(|_| some(seed, 120) as u16)))
                    .collect()
            };
            let (deeds, objects, storages) = (costs(3), costs(N), costs(N));
            let live = [0, 1, 2, 3];
            let posterior = Posterior {
                deeds: Options::new(&live[..3], &deeds),
                things: [
                    Options::new(&live, &objects),
                    Options::new(&live, &storages),
                ],
                fits: Fits {
                    rows: &rows[..used],
                    of: &of,
                    bytes: &bytes,
                    stride: N,
                },
                rest: [3, 9, 0, 4],
            };
            let mut rooms = [[[0.0; N]; 6], [[0.0; N]; 6]];
            let [mut a, mut b] = rooms.each_mut().map(|room| {
                let [a, b, c, d, e, f] = room;
                [(a, b), (c, d), (e, f)].map(|(of, weights)| Marginal {
                    of: &mut of[..],
                    weights: &mut weights[..],
                })
            });
            let whole = posterior.solve(&mut [Weighed::NONE; 6], &mut a).unwrap();
            let alike = |cost| Heard {
                asked: whole.best,
                it: Costs::all(cost),
                others: Costs::all(cost),
            };
            let revised = posterior.revise(&[alike(77), alike(0)], &mut b).unwrap();
            let close = |a: f32, b: f32| (a - b).abs() < 2e-3;
            // The product is searched at each level alone, which may miss what is best at none.
            let gained = revised.belief.posterior - whole.belief.posterior;
            assert!(gained > -2e-3, "{whole:?} {revised:?}");
            assert!(gained < 2e-3 || whole.best != revised.best);
            assert!(close(whole.belief.noise, revised.belief.noise));
            for (a, b) in a.iter().zip(&b) {
                assert!(
                    a.of.iter().zip(&*b.of).all(|(a, b)| close(*a, *b)),
                    "{round}"
                );
            }
            let yes = Heard {
                asked: revised.best,
                others: Costs::all(100),
                ..alike(0)
            };
            let sure = posterior.revise(&[yes], &mut b).unwrap();
            assert_eq!(sure.best, revised.best);
            assert!(sure.belief.posterior >= revised.belief.posterior);
        }
    }
}
