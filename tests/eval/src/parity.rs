//! Whether the core with the reference's habits answers as the reference did, sample by sample.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use deictic_core::board;
use deictic_core::category::Category;
use deictic_core::fuse::fuse;
use deictic_core::merge::Merge;
use deictic_core::profile::{Model, Profile};
use flate2::read::GzDecoder;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::catalogue::{CATEGORY_NAMES, Catalogue};
use crate::dataset::Set;
use crate::order::Order;
use crate::reading::{Choice, choice};
use crate::record::CATEGORIES;
use crate::situation::{FeatureForm, Prepared};

/// Two likelihoods this close, relative to the larger, are one in 32 bits: the merged word took a
/// logarithm, a sum and two divisions, each good to some 1e-7.
pub const TIE: f32 = 1e-6;

/// The reference's answers on one set: per "model/merge" and sample, what it decided per category,
/// then what it found likeliest; -1 for nothing.
#[derive(Deserialize)]
pub struct Answers {
    /// By "model/merge", one row per sample.
    pub pred: BTreeMap<String, Vec<[i16; 2 * CATEGORIES]>>,
}

/// Why no comparison could be made.
#[derive(Debug, Error)]
pub enum ParityError {
    /// The recorded answers cannot be read.
    #[error("{}: {reason}", file.display())]
    Answers {
        /// Their path.
        file: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// The sets use other names than the recorded answers.
    #[error(
        "the vocabulary beside the sets is not the one for which the reference's answers were recorded"
    )]
    OtherVocabulary,
    /// A sample that the core refuses.
    #[error("{set}, sample {sample}: {reason}")]
    Sample {
        /// The set.
        set: String,
        /// Which of its samples, from 0.
        sample: usize,
        /// The core's reason.
        reason: String,
    },
}

/// One answer that differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// The set.
    pub set: String,
    /// Which of its samples, from 0.
    pub sample: usize,
    /// Model and merge as the reference calls them.
    pub key: String,
    /// `act_` (decided) or `max_` (likeliest) and the category.
    pub field: String,
    /// Our answer.
    pub ours: Option<String>,
    /// The reference's.
    pub theirs: Option<String>,
    /// For `max_`: by how much our option's likelihood exceeds theirs, relative to ours. For `act_`:
    /// how far our decision is from tipping, the least of the distances from the clarity threshold
    /// and from the required lead.
    pub margin: f32,
    /// Whether the margin is within what 32 bits can tell apart.
    pub tie: bool,
}

/// The comparison.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Parity {
    /// Share of answers that agree: equal, or two of several equal maxima. The reference leaves
    /// such ties to the last bit of its 64, which the sets, rounded to six digits, do not carry.
    pub agreement: f64,
    /// Share of answers that are equal, ties not excused.
    pub identical: f64,
    /// How many answers there were.
    pub compared: usize,
    /// Every answer that is not equal.
    pub differences: Vec<Difference>,
}

/// The core's settings for one of the reference's "model/merge" names.
#[must_use]
pub fn profile(key: &str) -> Option<Profile> {
    let (model, merge) = key.split_once('/')?;
    let model = match model {
        "M1" => Model::M1,
        "M2" => Model::M2,
        "M3" => Model::M3,
        _ => return None,
    };
    Some(match merge {
        "mul" => Profile::reference_fixed(model, Merge::Mul),
        "add_2" => Profile::reference_fixed(model, Merge::Add),
        "entropy" => Profile::reference_entropy(model, Merge::Mul),
        "entropy_add_2" => Profile::reference_entropy(model, Merge::Add),
        "baseline" => Profile::reference_baseline(model),
        _ => return None,
    })
}

/// Reads the answers that were recorded for a set.
///
/// # Errors
/// [`ParityError::Answers`] with the file.
pub fn read_answers(folder: &Path, set: &str) -> Result<Answers, ParityError> {
    let file = folder.join(format!("{set}.json.gz"));
    let refuse = |reason: String| ParityError::Answers {
        file: file.clone(),
        reason,
    };
    let stream = File::open(&file).map_err(|e| refuse(e.to_string()))?;
    serde_json::from_reader(BufReader::new(GzDecoder::new(stream)))
        .map_err(|e| refuse(e.to_string()))
}

/// Compares all sets with the reference's recorded answers, on all cores.
///
/// # Errors
/// [`ParityError`] for answers that are missing or belong to something else.
pub fn compare(
    catalogue: &Catalogue,
    sets: &[Set],
    reference: &Path,
) -> Result<Parity, ParityError> {
    let order = Order::of_the_reference(catalogue).ok_or(ParityError::OtherVocabulary)?;
    let vocabulary = catalogue.vocabulary(&order);
    let mut parity = Parity::default();
    for set in sets {
        let answers = read_answers(reference, &set.name)?;
        for (key, rows) in &answers.pred {
            if rows.len() != set.records.len() || profile(key).is_none() {
                return Err(ParityError::Answers {
                    file: reference.join(format!("{}.json.gz", set.name)),
                    reason: format!(
                        "`{key}` is unknown or has {} rows for {} samples",
                        rows.len(),
                        set.records.len()
                    ),
                });
            }
        }
        let found: Result<Vec<Vec<Difference>>, ParityError> = (0..set.records.len())
            .into_par_iter()
            .map(|i| {
                Sample {
                    catalogue,
                    order: &order,
                    vocabulary: &vocabulary,
                    set,
                    i,
                }
                .differences(&answers)
            })
            .collect();
        parity.compared += answers.pred.len() * set.records.len() * 2 * CATEGORIES;
        parity.differences.extend(found?.into_iter().flatten());
    }
    let share = |differing: usize| 1.0 - differing as f64 / parity.compared.max(1) as f64;
    parity.identical = share(parity.differences.len());
    let not_tied = |d: &&Difference| !(d.tie && d.field.starts_with("max_"));
    parity.agreement = share(parity.differences.iter().filter(not_tied).count());
    Ok(parity)
}

/// One sample and what its numbers mean.
struct Sample<'a> {
    catalogue: &'a Catalogue,
    order: &'a Order,
    vocabulary: &'a board::Vocabulary,
    set: &'a Set,
    i: usize,
}

impl Sample<'_> {
    fn differences(&self, answers: &Answers) -> Result<Vec<Difference>, ParityError> {
        let refuse = |reason: String| ParityError::Sample {
            set: self.set.name.clone(),
            sample: self.i,
            reason,
        };
        let prepared = Prepared::new(
            &self.set.records[self.i],
            self.catalogue,
            self.order,
            self.vocabulary,
            FeatureForm::Sure,
        )
        .map_err(|e| refuse(e.to_string()))?;
        let mut trace = board::Trace::new();
        let mut out = Vec::new();
        for (key, rows) in &answers.pred {
            let Some(profile) = profile(key) else {
                continue;
            };
            fuse(prepared.with(self.vocabulary), &profile, &mut trace)
                .map_err(|e| refuse(format!("{e:?}")))?;
            for c in 0..CATEGORIES {
                let Choice { decided, likeliest } = choice(&trace, c, &profile);
                // Where nothing was said the reference's vector is flat and its first option wins.
                let likeliest = likeliest.or(Some(0));
                let row = &rows[self.i];
                let answers = [
                    ("act", decided, row[c]),
                    ("max", likeliest, row[CATEGORIES + c]),
                ];
                for (kind, ours, theirs) in answers {
                    let theirs = u8::try_from(theirs).ok().map(|t| self.order.inside(c, t));
                    if ours == theirs {
                        continue;
                    }
                    let margin = if kind == "act" {
                        tipping(&trace, c, &profile)
                    } else {
                        ahead(&trace, c, ours, theirs)
                    };
                    out.push(Difference {
                        set: self.set.name.clone(),
                        sample: self.i,
                        key: key.clone(),
                        field: format!("{kind}_{}", CATEGORY_NAMES[c]),
                        ours: self.name(c, ours),
                        theirs: self.name(c, theirs),
                        margin,
                        tie: margin <= TIE,
                    });
                }
            }
        }
        Ok(out)
    }

    fn name(&self, category: usize, option: Option<u8>) -> Option<String> {
        let at = usize::from(self.order.outside(category, option?));
        self.catalogue.names[category].get(at).cloned()
    }
}

/// By how much one option is likelier than another, relative to it.
fn ahead(trace: &board::Trace, category: usize, ours: Option<u8>, theirs: Option<u8>) -> f32 {
    let word = Category::from_index(category).and_then(|c| trace.category(c));
    let value = |option: Option<u8>| {
        let word = word?;
        word.merged().get(usize::from(option?)).copied()
    };
    match (value(ours), value(theirs)) {
        (Some(a), Some(b)) if a > 0.0 => (a - b) / a,
        (Some(_), Some(_)) => 0.0,
        _ => f32::INFINITY,
    }
}

/// How far a decision is from being another: from the clarity threshold or the required lead.
fn tipping(trace: &board::Trace, category: usize, profile: &Profile) -> f32 {
    let Some(word) = Category::from_index(category).and_then(|c| trace.category(c)) else {
        return f32::INFINITY;
    };
    let lead = (word.judgement.lead - profile.lead).abs();
    let best = word.judgement.best.map_or(0, usize::from);
    let clarity = if profile.threshold.is_relative() {
        word.h().get(best).map(|h| (h - word.threshold).abs())
    } else {
        word.merged().get(best).map(|w| (w - word.threshold).abs())
    };
    clarity.map_or(lead, |c| c.min(lead))
}
