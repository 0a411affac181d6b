//! The Bayes bound: how often the best method is right that knows how a data set was made, its
//! noise included. No method can do better but by what a set leaks beside its evidence.
//!
//! The likeliest triple among all that are feasible in the scene, by exact densities with point
//! masses where clipping has gathered them.

use rayon::prelude::*;

use crate::catalogue::Catalogue;
use crate::dataset::Set;
use crate::free;
use crate::generate::{Kind, raised};
use crate::maker::Maker;
use crate::noise::{Level, Noise};
use crate::record::{CATEGORIES, MODALITIES, Record, Triple};

/// How many of how many are right.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bound {
    /// Samples.
    pub n: usize,
    /// How many triples the best method gets right.
    pub triple: f64,
    /// How many actions it gets right while it looks for the triple.
    pub action: f64,
    /// How many triples can be had from the scene and the presence of words alone, with nothing
    /// said about which; ties are shared.
    pub floor: f64,
}

impl Bound {
    /// A count as a percentage.
    #[must_use]
    pub fn percent(&self, count: f64) -> f64 {
        100.0 * count / self.n.max(1) as f64
    }

    /// The counts of both.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            n: self.n + other.n,
            triple: self.triple + other.triple,
            action: self.action + other.action,
            floor: self.floor + other.floor,
        }
    }
}

/// The bound on a set, on all cores.
#[must_use]
pub fn of(catalogue: &Catalogue, set: &Set, maker: Maker) -> Bound {
    let one = |record: &Record| {
        let case = Case {
            catalogue,
            record,
            maker,
        };
        case.bound()
    };
    set.records
        .par_iter()
        .map(one)
        .reduce(Bound::default, Bound::plus)
}

/// One sample and how it was made.
struct Case<'a> {
    catalogue: &'a Catalogue,
    record: &'a Record,
    maker: Maker,
}

impl Case<'_> {
    fn bound(&self) -> Bound {
        let evidence: [Vec<f64>; CATEGORIES] = std::array::from_fn(|c| {
            (0..self.catalogue.count(c))
                .map(|k| self.words(c, k))
                .collect()
        });
        let mistaken: [f64; CATEGORIES] = std::array::from_fn(|c| self.mistaken(c));
        let mut best = (f64::NEG_INFINITY, None);
        let mut blind = (f64::NEG_INFINITY, Vec::new());
        for triple in self.feasible() {
            let prior = self.prior(triple);
            let mut score = prior;
            for ((evidence, mistaken), option) in
                evidence.iter().zip(&mistaken).zip(triple.options())
            {
                score += option.map_or(*mistaken, |o| evidence[usize::from(o)]);
            }
            if score > best.0 {
                best = (score, Some(triple));
            }
            if prior > blind.0 + 1e-9 {
                blind = (prior, vec![triple]);
            } else if prior > blind.0 - 1e-9 {
                blind.1.push(triple);
            }
        }
        let truth = self.record.truth;
        let right = |b: bool| f64::from(u8::from(b));
        let share = 1.0 / blind.1.len().max(1) as f64;
        Bound {
            n: 1,
            triple: right(best.1 == Some(truth)),
            action: right(best.1.map(|t| t.action) == Some(truth.action)),
            floor: right(blind.1.contains(&truth)) * share,
        }
    }

    /// Every triple that can be done in the scene.
    fn feasible(&self) -> Vec<Triple> {
        let mut triples = Vec::new();
        for action in (0_u8..).take(self.catalogue.count(0)) {
            let options = |c: usize| -> Vec<Option<u8>> {
                if !self.catalogue.takes(usize::from(action), c) {
                    return vec![None];
                }
                let fit = free::fit(self.catalogue, self.record, usize::from(action), c);
                fit.into_iter().map(Some).collect()
            };
            let storages = options(2);
            for object in options(1) {
                triples.extend(storages.iter().map(|&storage| Triple {
                    action,
                    object,
                    storage,
                }));
            }
        }
        triples
    }

    /// The logarithm of how likely a triple is by the scene and the presence of words alone, to a
    /// constant.
    fn prior(&self, triple: Triple) -> f64 {
        let mut prior = 0.0;
        for (c, option) in triple.options().iter().enumerate() {
            match self.maker {
                // A word is there exactly when the signature has it. Feasible triples count alike.
                Maker::Paper(..) => {
                    if option.is_some() != self.record.mentions(c) {
                        prior -= 1e3;
                    }
                }
                Maker::Free(_) => {
                    if option.is_some() && c > 0 {
                        let action = usize::from(triple.action);
                        let n = free::fit(self.catalogue, self.record, action, c).len();
                        prior -= (n.max(1) as f64).ln();
                    }
                    for m in 0..MODALITIES {
                        prior += match (option.is_some(), self.record.words[m][c].is_some()) {
                            (true, true) => (1.0 - free::MISSING).ln(),
                            (true, false) => free::MISSING.ln(),
                            (false, true) => free::CONFUSED.ln(),
                            (false, false) => (1.0 - free::CONFUSED).ln(),
                        };
                    }
                }
            }
        }
        prior
    }

    /// The logarithm of the density of all words of a category when option `k` is meant.
    fn words(&self, category: usize, k: usize) -> f64 {
        (0..MODALITIES)
            .map(|m| match self.maker {
                Maker::Paper(kind, level) => self.raised_word(m, category, k, kind, level),
                Maker::Free(level) => self.rivalled_word(m, category, k, level),
            })
            .sum()
    }

    fn raised_word(&self, m: usize, c: usize, k: usize, kind: Kind, level: Level) -> f64 {
        let Some(word) = &self.record.words[m][c] else {
            return 0.0;
        };
        let row = &self.catalogue.similarity[m][c][k];
        let raised = if c == 0 {
            raised(self.catalogue, kind, self.record, k)
        } else {
            vec![false; row.len()]
        };
        let noise = Noise::from(level);
        let elements = word.iter().zip(row).zip(raised);
        elements
            .map(|((&x, &mu), raised)| {
                let mu = if raised { row[k] } else { mu };
                noise.log_evidence(f64::from(x), f64::from(mu))
            })
            .sum()
    }

    /// A word that may have one rival at the level of what is meant.
    fn rivalled_word(&self, m: usize, c: usize, k: usize, level: Level) -> f64 {
        let Some(word) = &self.record.words[m][c] else {
            return 0.0;
        };
        let noise = free::noise(level, m);
        let row = &self.catalogue.similarity[m][c][k];
        let plain = self.row(m, c, k, level);
        let rivals = word.iter().zip(row).enumerate().filter(|(r, _)| *r != k);
        let others = (word.len().max(2) - 1) as f64;
        let gain: f64 = rivals
            .map(|(_, (&x, &mu))| {
                let x = f64::from(x);
                let raised = noise.log_evidence(x, f64::from(row[k]));
                (raised - noise.log_evidence(x, f64::from(mu))).exp()
            })
            .sum();
        let rival = free::RIVAL[c];
        plain + (1.0 - rival + rival / others * gain).ln()
    }

    /// The logarithm of the density of all words of a category that what is meant does not have:
    /// any option's row, no rivals.
    fn mistaken(&self, c: usize) -> f64 {
        let Maker::Free(level) = self.maker else {
            return 0.0;
        };
        let n = self.catalogue.count(c);
        let heard = (0..MODALITIES).filter(|&m| self.record.words[m][c].is_some());
        heard
            .map(|m| {
                let rows: Vec<f64> = (0..n).map(|k| self.row(m, c, k, level)).collect();
                let top = rows.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let sum: f64 = rows.iter().map(|row| (row - top).exp()).sum();
                top + (sum / n.max(1) as f64).ln()
            })
            .sum()
    }

    fn row(&self, m: usize, c: usize, k: usize, level: Level) -> f64 {
        let noise = free::noise(level, m);
        let row = &self.catalogue.similarity[m][c][k];
        let word = self.record.words[m][c].iter().flatten();
        word.zip(row)
            .map(|(&x, &mu)| noise.log_evidence(f64::from(x), f64::from(mu)))
            .sum()
    }
}
