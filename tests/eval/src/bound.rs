//! The Bayes bound: how often the best method is right that knows how a data set was made, its
//! noise included. No method can do better but by what a set leaks beside its evidence.
//!
//! The likeliest triple among all that are feasible in the scene, by exact densities with point
//! masses where clipping has gathered them.

use deictic_core::joint::fit::{SILENT, SURPLUS};
use rayon::prelude::*;

use crate::catalogue::Catalogue;
use crate::dataset::Set;
use crate::free;
use crate::maker::Maker;
use crate::noise::Level;
use crate::record::{CATEGORIES, MODALITIES, Record, Triple};

mod words;

/// What the best method is not told of how a fairer set was made, but takes as the joint model does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Untold {
    /// Nothing: it knows all.
    #[default]
    Nothing,
    /// That the hand is noisier and the voice cleaner than the level says.
    Scale,
    /// The noise level: it weighs n1 to n4 alike.
    Level,
    /// How often words go missing, and are heard that are not there.
    Presence,
    /// What is true of things: it takes their features' likelihoods for what they say.
    Features,
    /// How often there is a rival, and that there is one at most: each element may be one.
    Rivals,
    /// Any of these.
    All,
}

impl Untold {
    fn has(self, other: Self) -> bool {
        self == other || self == Self::All
    }
}

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
    without(catalogue, set, maker, Untold::Nothing)
}

/// The same of a method that is not told something of a fairer set.
#[must_use]
pub fn without(catalogue: &Catalogue, set: &Set, maker: Maker, untold: Untold) -> Bound {
    let untold = if maker.is_free() {
        untold
    } else {
        Untold::Nothing
    };
    let one = |record: &Record| {
        let case = Case {
            catalogue,
            record,
            maker,
            untold,
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
    untold: Untold,
}

impl Case<'_> {
    fn bound(&self) -> Bound {
        let weighed = self.levels().map(|maker| Self { maker, ..*self }.weighed());
        let weighed: Vec<_> = weighed.collect();
        let mut best = (f64::NEG_INFINITY, None);
        let mut blind = (f64::NEG_INFINITY, Vec::new());
        for triple in self.feasible() {
            let prior = self.prior(triple);
            let scores = weighed.iter().map(|(evidence, mistaken)| {
                let of = evidence.iter().zip(mistaken).zip(triple.options());
                of.map(|((evidence, mistaken), option)| {
                    option.map_or(*mistaken, |o| evidence[usize::from(o)])
                })
                .sum::<f64>()
            });
            let score = prior + log_sum(&scores.collect::<Vec<_>>());
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

    /// How it may have been made.
    fn levels(&self) -> impl Iterator<Item = Maker> {
        let all = match self.maker {
            Maker::Free(_) if self.untold.has(Untold::Level) => {
                Level::ALL[1..].iter().map(|&l| Maker::Free(l)).collect()
            }
            known => vec![known],
        };
        all.into_iter()
    }

    /// The logarithms of how likely the words of each category are: of every option, and when none
    /// is meant.
    fn weighed(&self) -> ([Vec<f64>; CATEGORIES], [f64; CATEGORIES]) {
        let evidence = std::array::from_fn(|c| {
            let options = 0..self.catalogue.count(c);
            options.map(|k| self.words(c, k)).collect()
        });
        (evidence, std::array::from_fn(|c| self.mistaken(c)))
    }

    /// How likely each thing of a category fits an action, as far as is known.
    fn fits(&self, action: usize, category: usize) -> Vec<(u8, f64)> {
        if self.untold.has(Untold::Features) {
            let things = self.record.things(category).iter();
            let likelihood = |thing| self.catalogue.likelihood(action, category, thing);
            return things
                .map(|thing| (thing.option, likelihood(thing)))
                .collect();
        }
        let fit = free::fit(self.catalogue, self.record, action, category);
        fit.into_iter().map(|option| (option, 1.0)).collect()
    }

    /// Every triple that can be done in the scene.
    fn feasible(&self) -> Vec<Triple> {
        let mut triples = Vec::new();
        for action in (0_u8..).take(self.catalogue.count(0)) {
            let options = |c: usize| -> Vec<Option<u8>> {
                if !self.catalogue.takes(usize::from(action), c) {
                    return vec![None];
                }
                let fit = self.fits(usize::from(action), c).into_iter();
                fit.filter(|(_, p)| *p > 0.0)
                    .map(|(o, _)| Some(o))
                    .collect()
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
                    if let Some(option) = option
                        && c > 0
                    {
                        let fits = self.fits(usize::from(triple.action), c);
                        let all: f64 = fits.iter().map(|(_, p)| p).sum();
                        let own = fits.iter().find(|(o, _)| o == option);
                        prior += own.map_or(0.0, |(_, p)| p / all.max(1.0)).ln();
                    }
                    let [missing, confused] = if self.untold.has(Untold::Presence) {
                        [SILENT, SURPLUS].map(f64::from)
                    } else {
                        [free::MISSING, free::CONFUSED]
                    };
                    for m in 0..MODALITIES {
                        prior += match (option.is_some(), self.record.words[m][c].is_some()) {
                            (true, true) => (1.0 - missing).ln(),
                            (true, false) => missing.ln(),
                            (false, true) => confused.ln(),
                            (false, false) => (1.0 - confused).ln(),
                        };
                    }
                }
            }
        }
        prior
    }
}

/// The logarithm of the sum of what these are the logarithms of.
fn log_sum(logarithms: &[f64]) -> f64 {
    let top = logarithms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = logarithms.iter().map(|x| (x - top).exp()).sum();
    top + sum.ln()
}
