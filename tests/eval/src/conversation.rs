//! Conversations: a command, the questions that it takes, and answers that are heard through the same
//! noise as the command was.
//!
//! Whoever is asked "which object" names the one that is meant: one more word of the language, with
//! errors of the set's level. A yes or a no is a word of two options, 1 for what is said and
//! [`ELSEWHERE`] for the other, with the same errors. Who says it again says what was said, with the
//! same rivals and fresh errors.

use deictic_core::board;
use deictic_core::category::Category;
use deictic_core::clarify::choose::choose;
use deictic_core::clarify::{Confirmation, QUESTIONS};
use deictic_core::decide::{Decision, Kind as Asks, Outcome};
use deictic_core::joint::belief::Belief;
use deictic_core::joint::posterior::Triple as Asked;
use deictic_core::joint::sensors::ELSEWHERE;
use deictic_core::profile::Profile;
use deictic_core::sentence::LANGUAGE;
use rand::seq::IndexedRandom;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::answer::Judge;
use crate::catalogue::Catalogue;
use crate::dataset::Set;
use crate::free;
use crate::generate::{self, Kind};
use crate::noise::{Level, Noise};
use crate::order::Order;
use crate::record::{CATEGORIES, Record, Triple, Words};
use crate::sensing::Sensing;
use crate::situation::{FeatureForm, Prepared};
use crate::variant::ProfileName;

/// Which question is put when one is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Strategy {
    /// The core's: the largest expected gain per cost.
    Gain,
    /// Always a yes or no to the likeliest intent.
    Confirm,
    /// Any of the yes or no and the categories of the likeliest intent, by chance.
    Random,
    /// Everything is said once more, and counts as more of the same.
    Again,
    /// Everything is said and shown once more, and what was before is forgotten.
    Repeat,
}

impl Strategy {
    /// All, the core's first.
    pub const ALL: [Self; 5] = [
        Self::Gain,
        Self::Confirm,
        Self::Random,
        Self::Again,
        Self::Repeat,
    ];
}

/// What is put to the person.
#[derive(Clone, Copy, Debug)]
enum Put {
    /// Yes or no to the likeliest intent.
    Confirm,
    /// An option of a category.
    Which(Category),
    /// Everything once more.
    Again,
    /// Everything from the beginning.
    Over,
}

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
    form: FeatureForm,
    /// `None`: D_free.
    kind: Option<Kind>,
    /// The noise level.
    pub level: Level,
}

impl<'a> Talk<'a> {
    /// About a set whose name says what it is, for example `D_arity_n3`; `None` for another name.
    ///
    /// # Errors
    /// When the core refuses the catalogue's tables.
    pub fn new(set: &'a Set, catalogue: &'a Catalogue) -> anyhow::Result<Option<Self>> {
        let Some((kind, level)) = set.name.rsplit_once("_n") else {
            return Ok(None);
        };
        let level = Level::ALL
            .into_iter()
            .find(|l| l.number().to_string() == level);
        let known = Kind::ALL.into_iter().find(|k| k.name() == kind);
        let Some(level) = level.filter(|_| known.is_some() || kind == "D_free") else {
            return Ok(None);
        };
        let order = Order::own(catalogue);
        Ok(Some(Self {
            catalogue,
            set,
            vocabulary: catalogue.vocabulary(&order),
            sensing: Sensing::new(catalogue, &order)?,
            order,
            form: if known.is_some() {
                FeatureForm::Sure
            } else {
                FeatureForm::Graded
            },
            kind: known,
            level,
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
                self.form,
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
            if left == 0 || (executes && !to_the_end) {
                return Ok(looks);
            }
            left -= 1;
            let question = self.question(&decision, &trace, strategy, rng);
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
                    let words = self.inside(&self.words(record, usize::from(LANGUAGE), rng));
                    sample.answer(&words, &self.vocabulary)?;
                }
                Put::Over => {
                    said.words = std::array::from_fn(|m| self.words(record, m, rng));
                    sample = prepare(&said)?;
                }
            }
        }
    }

    /// The question that a strategy puts.
    fn question(
        &self,
        decision: &Decision<{ board::CATEGORIES }>,
        trace: &board::Trace,
        strategy: Strategy,
        rng: &mut impl Rng,
    ) -> Put {
        let Some(best) = decision.best.as_ref() else {
            return Put::Over;
        };
        match strategy {
            Strategy::Gain => {
                let question = match &decision.outcome {
                    Outcome::Ask(question) => Some(question.clone()),
                    _ => choose(best, trace),
                };
                match question {
                    None => Put::Over,
                    Some(question) if question.kind == Asks::Confirm => Put::Confirm,
                    Some(question) => Put::Which(question.category),
                }
            }
            Strategy::Confirm => Put::Confirm,
            Strategy::Random => {
                let mut all = vec![Put::Confirm, Put::Which(Category::ACTION)];
                all.extend(best.parameters.iter().map(|p| Put::Which(p.category)));
                all.choose(rng).copied().unwrap_or(Put::Confirm)
            }
            Strategy::Again => Put::Again,
            Strategy::Repeat => Put::Over,
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
        let noise = self.noise(usize::from(LANGUAGE));
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
        let noise = self.noise(usize::from(LANGUAGE));
        let c = category.index();
        let row = &self.catalogue.similarity[usize::from(LANGUAGE)][c][usize::from(option)];
        let places = self.order.places(c).iter();
        let heard = places.map(|&j| noise.observe(f64::from(row[usize::from(j)]), rng) as f32);
        (category, heard.collect())
    }

    /// What a modality observes when all is said once more.
    fn words(&self, record: &Record, modality: usize, rng: &mut impl Rng) -> Words {
        match self.kind {
            Some(kind) => {
                let action = usize::from(record.truth.action);
                let raised = generate::raised(self.catalogue, kind, record, action);
                let noise = self.level.into();
                let (catalogue, truth) = (self.catalogue, record.truth);
                generate::words(catalogue, kind, modality, truth, &raised, noise, rng)
            }
            None => free::words(self.catalogue, modality, record.truth, self.level, rng),
        }
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

    fn noise(&self, modality: usize) -> Noise {
        match self.kind {
            Some(_) => self.level.into(),
            None => free::noise(self.level, modality),
        }
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
