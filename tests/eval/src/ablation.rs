//! The joint model without one of its parts, to see what each is worth.
//!
//! A part is taken away by what the model is given: a vocabulary without requirements, sensors
//! without tables, a confidence that is always told the same noise. The core is the flashed one, and
//! nothing is calibrated anew: figures say what is lost where a part is missing, not what a model
//! made without it could reach.

use clap::ValueEnum;
use deictic_core::board;
use deictic_core::category::{Category, CategorySet};
use deictic_core::joint::belief::{Belief, Look};
use deictic_core::profile::{Profile, Threshold};
use deictic_core::vocabulary::{Requirement, Signature};
use rayon::prelude::*;
use serde::Serialize;

use crate::answer::{Answer, Judge};
use crate::catalogue::Catalogue;
use crate::dataset::Set;
use crate::order::Order;
use crate::record::{Feature, Record, Thing, Triple};
use crate::score::Tally;
use crate::sensing::Sensing;
use crate::situation::{FeatureForm, Prepared};
use crate::variant::ProfileName;

/// What is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// Nothing.
    Nothing,
    /// Which words an action needs: all may be given, none is missed.
    Signature,
    /// What things must be like.
    Features,
    /// Which things are there, and what they must be like.
    Scene,
    /// The sensors' tables: each is taken for a plain one.
    Sensors,
    /// That actions which read alike share one error: they are told apart by a 255th. Those that were clipped to 0 or 1
    /// stay there.
    Shared,
    /// The noise that was heard, for the confidence: it is always told the middle of all levels.
    Noise,
    /// What the confidence knows beside the posterior and the noise: how sure the action is, and how
    /// many kinds of words there were. It is always told as many kinds, and that the action is as
    /// sure as the whole.
    Kinds,
    /// The question about what is clearly meant and cannot be had.
    Guard,
    /// The cut: what has a posterior of 0.9 is executed.
    Cut,
}

/// The middle of all levels.
const MIDDLE: f32 = 1.5;

/// What stands for the cut.
const FIXED: f32 = 0.9;

/// The tolerated share of all commands that are executed wrongly.
const RATE: f32 = 0.01;

/// What a set came to.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// How often it was right, wrong or undecided.
    pub tally: Tally,
    /// Of every sample how sure the model was of what it found likeliest, and whether that is right.
    pub confidences: Vec<(f64, bool)>,
}

impl Outcome {
    fn plus(mut self, other: Self) -> Self {
        self.tally = self.tally.plus(other.tally);
        self.confidences.extend(other.confidences);
        self
    }
}

/// Decides all samples of a set without a part, on all cores.
///
/// # Errors
/// Which sample the core refuses, and why.
pub fn ablate(part: Part, set: &Set, catalogue: &Catalogue) -> anyhow::Result<Outcome> {
    let given = part.catalogue(catalogue);
    let order = Order::own(&given);
    let vocabulary = given.vocabulary(&order);
    let sensing = match part {
        Part::Sensors => Sensing::unknown(),
        _ => Sensing::new(&given, &order)?,
    };
    let judge = Judge {
        catalogue,
        order: &order,
        vocabulary: &vocabulary,
        sensing: &sensing,
        habits: ProfileName::Paper,
    };
    let profile = part.profile();
    set.records
        .par_chunks(64)
        .map(|chunk| {
            let mut trace = board::Trace::new();
            let mut outcome = Outcome::default();
            for record in chunk {
                let seen = part.record(record, catalogue);
                let prepared =
                    Prepared::new(&seen, &given, &order, &vocabulary, FeatureForm::Sure)?;
                let answer = judge
                    .answer(&prepared, &profile, &mut trace)
                    .map_err(|e| anyhow::anyhow!("{}: the core refuses: {e:?}", set.name))?;
                let belief = part.belief(trace.belief);
                let answer = part.read(answer, belief, catalogue);
                outcome.tally.add(answer, record.truth);
                let right = answer.likeliest == Some(record.truth);
                let confidence = f64::from(belief.confidence());
                outcome.confidences.push((confidence, right));
            }
            Ok(outcome)
        })
        .try_reduce(Outcome::default, |a, b| Ok(a.plus(b)))
}

impl Part {
    /// What the core is told of the vocabulary.
    fn catalogue(self, catalogue: &Catalogue) -> Catalogue {
        let mut given = catalogue.clone();
        for action in &mut given.actions {
            match self {
                Self::Signature => {
                    let things = [Category::OBJECT, Category::STORAGE];
                    action.signature = Signature {
                        compulsory: CategorySet::EMPTY,
                        voluntary: things.into_iter().collect(),
                    };
                }
                Self::Features | Self::Scene => {
                    action.object = Requirement::default();
                    action.storage = Requirement::default();
                }
                _ => {}
            }
        }
        given
    }

    /// What the core is told of a sample.
    fn record(self, record: &Record, catalogue: &Catalogue) -> Record {
        let mut seen = record.clone();
        if self == Self::Scene {
            let all = |category: usize| {
                let options = (0_u8..).take(catalogue.count(category));
                let thing = |option| Thing {
                    option,
                    kind: None,
                    features: vec![Feature::sure(true); catalogue.features.len()],
                };
                options.map(thing).collect()
            };
            (seen.objects, seen.storages) = (all(1), all(2));
        }
        if self == Self::Shared {
            for words in &mut seen.words {
                words[0].as_deref_mut().map(tell_apart);
            }
        }
        seen
    }

    fn profile(self) -> Profile {
        let mut profile = Profile {
            questions: 0,
            ..Profile::JOINT
        };
        match self {
            Self::Guard => profile.guarded = false,
            Self::Noise | Self::Kinds | Self::Cut => profile.threshold = Threshold::None,
            _ => {}
        }
        profile
    }

    /// What is believed.
    fn belief(self, belief: Belief) -> Belief {
        match self {
            Self::Noise => Belief {
                noise: MIDDLE,
                ..belief
            },
            Self::Kinds => Belief {
                action: belief.posterior,
                kinds: 2,
                ..belief
            },
            _ => belief,
        }
    }

    /// What becomes of an answer.
    fn read(self, mut answer: Answer, belief: Belief, catalogue: &Catalogue) -> Answer {
        let executes = match self {
            Self::Noise | Self::Kinds => belief.suffices(RATE, Look::Only),
            Self::Cut => belief.posterior >= FIXED,
            _ => true,
        };
        if !executes {
            (answer.executed, answer.action) = (None, None);
        }
        if self == Self::Signature {
            // What is said is given to any action; only what it takes counts.
            let [executed, likeliest] =
                [answer.executed, answer.likeliest].map(|t| Some(taken(t?, catalogue)));
            (answer.executed, answer.likeliest) = (executed, likeliest);
        }
        answer
    }
}

/// Moves likelihoods between 0 and 1 by 255ths towards the middle until no two are alike.
fn tell_apart(likelihoods: &mut [f32]) {
    let alike = |a: f32, b: f32| (a * 255.0).round() == (b * 255.0).round();
    for i in 1..likelihoods.len() {
        let (before, rest) = likelihoods.split_at_mut(i);
        let own = &mut rest[0];
        let step = if *own > 0.5 { -1.0 } else { 1.0 } / 255.0;
        if *own > 0.0 && *own < 1.0 {
            while before.iter().any(|other| alike(*other, *own)) {
                *own += step;
            }
        }
    }
}

fn taken(triple: Triple, catalogue: &Catalogue) -> Triple {
    let takes = |c: usize| catalogue.takes(usize::from(triple.action), c);
    Triple {
        object: triple.object.filter(|_| takes(1)),
        storage: triple.storage.filter(|_| takes(2)),
        ..triple
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Kind, set};
    use crate::noise::Level;

    #[test]
    fn what_is_taken_away_is_missed() {
        let (catalogue, recipe) = Catalogue::papers();
        let set = set(
            &catalogue,
            &recipe,
            Kind::Properties,
            Level::N3,
            400,
            0xab1a,
        );
        let right = |part| {
            let outcome = ablate(part, &set, &catalogue).unwrap();
            assert_eq!((outcome.tally.n, outcome.confidences.len()), (400, 400));
            outcome.tally.triple_argmax
        };
        let whole = right(Part::Nothing);
        assert!(whole > 340, "{whole}");
        for part in [Part::Signature, Part::Features, Part::Scene] {
            let without = right(part);
            assert!(without + 40 < whole, "{part:?}: {without} of {whole}");
        }
        for part in [Part::Noise, Part::Kinds, Part::Guard, Part::Cut] {
            assert_eq!(
                right(part),
                whole,
                "{part:?} changes what is done, not what is likeliest"
            );
        }
    }
}
