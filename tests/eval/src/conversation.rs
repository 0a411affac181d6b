//! Conversations: a command, the questions that it takes, and answers that are heard through the same
//! noise as the command was.
//!
//! Whoever is asked "which object" names the one that is meant: one more word of the language, with
//! errors of the set's level. A yes or a no is a word of two options, 1 for what is said and
//! [`ELSEWHERE`] for the other, with the same errors. Who says it again says what was said, with the
//! same rivals and fresh errors.

use deictic_core::board;
use deictic_core::category::Category;
use deictic_core::clarify::{Confirmation, QUESTIONS};
use deictic_core::decide::{Decision, Outcome};
use deictic_core::joint::belief::Belief;
use deictic_core::joint::posterior::Triple as Asked;
use deictic_core::joint::sensors::ELSEWHERE;
use deictic_core::profile::Profile;
use deictic_core::sentence::LANGUAGE;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::answer::Judge;
use crate::catalogue::Catalogue;
use crate::dataset::Set;
use crate::maker::Maker;
use crate::order::Order;
use crate::record::{CATEGORIES, Record, Triple, Words};
use crate::sensing::Sensing;
use crate::situation::Prepared;
use crate::variant::ProfileName;

mod strategy;

use strategy::Put;
pub use strategy::Strategy;

/// One look at a command.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// What was believed.
    pub belief: Belief,
    /// Whether the likeliest intent is what was meant.
    pub right: bool,
    /// Whether it would be executed.
    pub executes: bool,
}

/// A set's commands with what it takes to go on talking about them.
pub struct Talk<'a> {
    catalogue: &'a Catalogue,
    set: &'a Set,
    order: Order,
    vocabulary: board::Vocabulary,
    sensing: Sensing,
    maker: Maker,
}

impl<'a> Talk<'a> {
    /// About a set whose name says what it is, for example `D_arity_n3`; `None` for another name.
    ///
    /// # Errors
    /// When the core refuses the catalogue's tables.
    pub fn new(set: &'a Set, catalogue: &'a Catalogue) -> anyhow::Result<Option<Self>> {
        let Some(maker) = Maker::of(&set.name) else {
            return Ok(None);
        };
        let order = Order::own(catalogue);
        Ok(Some(Self {
            catalogue,
            set,
            vocabulary: catalogue.vocabulary(&order),
            sensing: Sensing::new(catalogue, &order)?,
            order,
            maker,
        }))
    }

    /// The looks at every command until it is executed or given up, on all cores.
    ///
    /// # Errors
    /// The core's.
    pub fn all(
        &self,
        profile: &Profile,
        strategy: Strategy,
        seed: u64,
    ) -> anyhow::Result<Vec<Vec<Look>>> {
        let numbered: Vec<(u64, &Record)> = (0_u64..).zip(&self.set.records).collect();
        numbered
            .par_iter()
            .map(|(i, record)| {
                let mut rng = ChaCha8Rng::seed_from_u64(seed);
                rng.set_stream(*i);
                let looks = self.looks(record, profile, strategy, &mut rng);
                looks.map_err(|e| e.context(format!("{}, sample {i}", self.set.name)))
            })
            .collect()
    }

    /// The looks at one command.
    fn looks(
        &self,
        record: &Record,
        profile: &Profile,
        strategy: Strategy,
        rng: &mut impl Rng,
    ) -> anyhow::Result<Vec<Look>> {
        let judge = self.judge();
        let prepare = |record: &Record| {
            Prepared::new(
                record,
                self.catalogue,
                &self.order,
                &self.vocabulary,
                self.maker.form(),
            )
        };
        // Without a cut everything is looked at to the end, whatever would have been executed.
        let to_the_end = profile.threshold == deictic_core::profile::Threshold::None;
        let mut sample = prepare(record)?;
        let mut trace = board::Trace::new();
        let mut looks = Vec::new();
        let mut said = record.clone();
        let mut left = profile.questions;
        loop {
            let now = Profile {
                questions: if strategy == Strategy::Repeat {
                    left
                } else {
                    profile.questions
                },
                ..*profile
            };
            let decision = self
                .sensing
                .decide(&sample, &self.vocabulary, &now, &mut trace)
                .map_err(|e| anyhow::anyhow!("the core refuses: {e:?}"))?;
            let best = decision.best.as_ref().map(|best| judge.triple(best));
            let executes = matches!(decision.outcome, Outcome::Execute(_));
            looks.push(Look {
                belief: trace.belief,
                right: best == Some(record.truth),
                executes,
            });
            let given_up = matches!(decision.outcome, Outcome::GiveUp);
            if left == 0 || given_up || (executes && !to_the_end) {
                return Ok(looks);
            }
            left -= 1;
            let question = strategy.question(&decision, sample.observations(), &trace, rng);
            match question {
                Put::Confirm => {
                    self.confirm(&mut sample, &decision, record.truth, rng);
                }
                Put::Which(category) => {
                    match record
                        .truth
                        .options()
                        .get(category.index())
                        .copied()
                        .flatten()
                    {
                        Some(option) => {
                            let word = self.word(category, option, rng);
                            sample.answer(&[word], &self.vocabulary)?;
                        }
                        // There is none to name.
                        None => self.confirm(&mut sample, &decision, record.truth, rng),
                    }
                }
                Put::Again => {
                    let language = usize::from(LANGUAGE);
                    let words = self.maker.words(self.catalogue, record, language, rng);
                    let words = self.inside(&words);
                    sample.answer(&words, &self.vocabulary)?;
                }
                Put::Over => {
                    let maker = self.maker;
                    said.words =
                        std::array::from_fn(|m| maker.words(self.catalogue, record, m, rng));
                    sample = prepare(&said)?;
                }
            }
        }
    }

    fn confirm(
        &self,
        sample: &mut Prepared,
        decision: &Decision<{ board::CATEGORIES }>,
        truth: Triple,
        rng: &mut impl Rng,
    ) {
        let Some(best) = &decision.best else {
            return;
        };
        let yes = self.judge().triple(best) == truth;
        let noise = self.maker.noise(usize::from(LANGUAGE));
        let levels = if yes {
            [1.0, ELSEWHERE]
        } else {
            [ELSEWHERE, 1.0]
        };
        sample.confirm(Confirmation {
            asked: Asked::of(best),
            likelihoods: levels.map(|level| noise.observe(f64::from(level), rng) as f32),
        });
    }

    /// A word of the language for an option, as heard, in the core's order.
    fn word(&self, category: Category, option: u8, rng: &mut impl Rng) -> (Category, Vec<f32>) {
        let noise = self.maker.noise(usize::from(LANGUAGE));
        let c = category.index();
        let row = &self.catalogue.similarity[usize::from(LANGUAGE)][c][usize::from(option)];
        let places = self.order.places(c).iter();
        let heard = places.map(|&j| noise.observe(f64::from(row[usize::from(j)]), rng) as f32);
        (category, heard.collect())
    }

    /// Words in the core's order.
    fn inside(&self, words: &Words) -> Vec<(Category, Vec<f32>)> {
        (0..CATEGORIES)
            .filter_map(|c| {
                let (word, category) = (words[c].as_ref()?, Category::from_index(c)?);
                let places = self.order.places(c).iter();
                Some((category, places.map(|&j| word[usize::from(j)]).collect()))
            })
            .collect()
    }

    fn judge(&self) -> Judge<'_> {
        Judge {
            catalogue: self.catalogue,
            order: &self.order,
            vocabulary: &self.vocabulary,
            sensing: &self.sensing,
            habits: ProfileName::Paper,
        }
    }
}

const _: () = assert!(QUESTIONS <= 6, "a word of an answer per question is kept");
