//! How often a variant is right, wrong or undecided on a data set.

use deictic_core::board;
use deictic_core::profile::Profile;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::answer::{Answer, Judge};
use crate::calibration::Believed;
use crate::catalogue::Catalogue;
use crate::dataset::Set;
use crate::order::Order;
use crate::record::{Record, Triple};
use crate::sensing::Sensing;
use crate::situation::{FeatureForm, Prepared, in_order};
use crate::variant::{ProfileName, Variant};

mod shares;

pub use shares::{Score, Shares};

/// A data set in the core's types, to be decided by many variants.
pub struct Field<'a> {
    catalogue: &'a Catalogue,
    order: Order,
    vocabulary: board::Vocabulary,
    sensing: Sensing,
    /// The set's name.
    pub name: String,
    samples: Vec<(Prepared, Triple)>,
    habits: ProfileName,
}

/// Counts over a data set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Samples.
    pub n: usize,
    /// The likeliest intent is the one meant.
    pub triple_argmax: usize,
    /// Its action is.
    pub action_argmax: usize,
    /// What was executed is what was meant.
    pub triple_decided: usize,
    /// The settled action is the one meant.
    pub action_decided: usize,
    /// Something else than what was meant was executed.
    pub triple_wrong_executed: usize,
    /// An action was settled that was not meant.
    pub action_wrong_executed: usize,
    /// No action was settled.
    pub undecided: usize,
}

impl Tally {
    /// Counts one answer.
    pub fn add(&mut self, answer: Answer, truth: Triple) {
        let is = |b: bool| usize::from(b);
        self.n += 1;
        self.triple_argmax += is(answer.likeliest == Some(truth));
        self.action_argmax += is(answer.likeliest.map(|t| t.action) == Some(truth.action));
        self.triple_decided += is(answer.executed == Some(truth));
        self.action_decided += is(answer.action == Some(truth.action));
        self.triple_wrong_executed += is(answer.executed.is_some_and(|t| t != truth));
        self.action_wrong_executed += is(answer.action.is_some_and(|a| a != truth.action));
        self.undecided += is(answer.action.is_none());
    }

    /// The counts of both.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            n: self.n + other.n,
            triple_argmax: self.triple_argmax + other.triple_argmax,
            action_argmax: self.action_argmax + other.action_argmax,
            triple_decided: self.triple_decided + other.triple_decided,
            action_decided: self.action_decided + other.action_decided,
            triple_wrong_executed: self.triple_wrong_executed + other.triple_wrong_executed,
            action_wrong_executed: self.action_wrong_executed + other.action_wrong_executed,
            undecided: self.undecided + other.undecided,
        }
    }

    /// A count as a percentage.
    #[must_use]
    pub fn percent(&self, count: usize) -> f64 {
        100.0 * count as f64 / self.n.max(1) as f64
    }
}

impl<'a> Field<'a> {
    /// Translates a set for variants of one profile.
    ///
    /// # Errors
    /// Which sample the core refuses, and why.
    pub fn new(
        set: &Set,
        catalogue: &'a Catalogue,
        habits: ProfileName,
        form: FeatureForm,
    ) -> anyhow::Result<Self> {
        let order = match habits {
            ProfileName::Paper => None,
            ProfileName::Reference => Order::of_the_reference(catalogue),
        }
        .unwrap_or_else(|| Order::own(catalogue));
        let words = |record: &Record, _: &mut ChaCha8Rng| {
            let words = record.words.iter().map(|words| in_order(words, &order));
            words.collect::<anyhow::Result<Vec<_>>>()
        };
        Self::observed(set, catalogue, habits, &order, form, 0, words)
    }

    /// Translates a set of which each sample is observed in a way of its own: `words` gives every
    /// modality's, from 0 on, in the core's order of options. What it draws starts from `seed` anew
    /// for every sample.
    ///
    /// # Errors
    /// Which sample the core refuses, and why.
    pub fn observed(
        set: &Set,
        catalogue: &'a Catalogue,
        habits: ProfileName,
        order: &Order,
        form: FeatureForm,
        seed: u64,
        words: impl Fn(&Record, &mut ChaCha8Rng) -> anyhow::Result<Vec<Vec<board::Word>>>,
    ) -> anyhow::Result<Self> {
        let vocabulary = catalogue.vocabulary(order);
        let sensing = Sensing::new(catalogue, order)?;
        let prepare = |i: u64, record: &Record| {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            rng.set_stream(i);
            let mut prepared = Prepared::silent(record, catalogue, order, &vocabulary, form)?;
            for (modality, words) in (0_u8..).zip(words(record, &mut rng)?) {
                prepared.observe(modality, &words, &vocabulary)?;
            }
            Ok((prepared, record.truth))
        };
        let samples = (0_u64..)
            .zip(&set.records)
            .map(|(i, record)| {
                prepare(i, record)
                    .map_err(|e: anyhow::Error| e.context(format!("{}, sample {i}", set.name)))
            })
            .collect::<anyhow::Result<_>>()?;
        Ok(Self {
            catalogue,
            order: order.clone(),
            vocabulary,
            sensing,
            name: set.name.clone(),
            samples,
            habits,
        })
    }

    /// Decides all samples, on all cores.
    ///
    /// # Errors
    /// The core's, for settings that cannot be.
    ///
    /// # Panics
    /// When the variant is of another profile than the field was made for.
    pub fn tally(&self, variant: &Variant) -> anyhow::Result<Tally> {
        assert_eq!(variant.profile, self.habits, "made for another profile");
        self.decide(&variant.settings())
    }

    /// Decides all samples with any settings, on all cores.
    ///
    /// # Errors
    /// The core's, for settings that cannot be.
    pub fn decide(&self, settings: &Profile) -> anyhow::Result<Tally> {
        let judge = self.judge();
        self.samples
            .par_chunks(64)
            .map(|chunk| {
                let mut trace = board::Trace::new();
                let mut tally = Tally::default();
                for (prepared, truth) in chunk {
                    let answer = judge
                        .answer(prepared, settings, &mut trace)
                        .map_err(|e| anyhow::anyhow!("{}: the core refuses: {e:?}", self.name))?;
                    tally.add(answer, *truth);
                }
                Ok(tally)
            })
            .try_reduce(Tally::default, |a, b| Ok(a.plus(b)))
    }
}

impl Field<'_> {
    /// What the joint model believes of every sample, and whether it is right, on all cores.
    ///
    /// # Errors
    /// The core's.
    pub fn beliefs(&self) -> anyhow::Result<Vec<Believed>> {
        let judge = self.judge();
        let settings = Profile {
            questions: 0,
            ..Profile::JOINT
        };
        let chunks: Vec<Vec<Believed>> = self
            .samples
            .par_chunks(64)
            .map(|chunk| {
                let mut trace = board::Trace::new();
                let believe = |(prepared, truth): &(Prepared, Triple)| {
                    let answer = judge
                        .answer(prepared, &settings, &mut trace)
                        .map_err(|e| anyhow::anyhow!("{}: the core refuses: {e:?}", self.name))?;
                    Ok(Believed {
                        belief: trace.belief,
                        right: answer.likeliest == Some(*truth),
                        executed: answer.executed.is_some(),
                    })
                };
                chunk.iter().map(believe).collect::<anyhow::Result<_>>()
            })
            .collect::<anyhow::Result<_>>()?;
        Ok(chunks.concat())
    }

    fn judge(&self) -> Judge<'_> {
        Judge {
            catalogue: self.catalogue,
            order: &self.order,
            vocabulary: &self.vocabulary,
            sensing: &self.sensing,
            habits: self.habits,
        }
    }
}
