//! The reference's own accuracies and the recorded Bayes bound, where they are at hand.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Context;
use serde::Deserialize;

use crate::variant::{MergeName, ModelName, ThresholdName, Variant};

#[derive(Deserialize)]
struct Row {
    dataset: String,
    noise: String,
    model: String,
    merge: String,
    variant: String,
    act_action: f64,
    max_triple: f64,
    act_triple: f64,
}

#[derive(Deserialize)]
struct BoundRow {
    dataset: String,
    noise: String,
    #[serde(rename = "MAP_feasible_triples_triple")]
    triple: f64,
}

/// What the reference reached on one set, in percent.
#[derive(Clone, Copy, Debug)]
pub struct Accuracy {
    /// Actions decided right.
    pub action_decided: f64,
    /// Likeliest triples right.
    pub triple_argmax: f64,
    /// Triples decided right.
    pub triple_decided: f64,
}

/// Recorded figures by set.
#[derive(Default)]
pub struct Recorded {
    accuracies: BTreeMap<(String, String, String), Accuracy>,
    bounds: BTreeMap<String, f64>,
}

impl Recorded {
    /// Reads `accuracy.csv` and `bayes_bound.csv` of a folder.
    ///
    /// # Errors
    /// Which file, and the reader's reason.
    pub fn read(folder: &Path) -> anyhow::Result<Self> {
        let mut recorded = Self::default();
        let file = folder.join("accuracy.csv");
        let why = || format!("cannot read {}", file.display());
        for row in csv::Reader::from_path(&file)
            .with_context(why)?
            .deserialize()
        {
            let row: Row = row.with_context(why)?;
            if row.variant == "as_shipped" {
                let set = format!("{}_{}", row.dataset, row.noise);
                let accuracy = Accuracy {
                    action_decided: row.act_action,
                    triple_argmax: row.max_triple,
                    triple_decided: row.act_triple,
                };
                let key = (set, row.model, row.merge);
                recorded.accuracies.insert(key, accuracy);
            }
        }
        let file = folder.join("bayes_bound.csv");
        let why = || format!("cannot read {}", file.display());
        for row in csv::Reader::from_path(&file)
            .with_context(why)?
            .deserialize()
        {
            let row: BoundRow = row.with_context(why)?;
            let set = format!("{}_{}", row.dataset, row.noise);
            recorded.bounds.insert(set, row.triple);
        }
        Ok(recorded)
    }

    /// The reference's accuracy with a variant, the mean over sets of one size.
    #[must_use]
    pub fn accuracy(&self, sets: &[String], variant: Variant) -> Option<Accuracy> {
        let model = match variant.model {
            ModelName::Baseline => "Baseline",
            ModelName::M1 => "M1",
            ModelName::M2 => "M2",
            ModelName::M3 => "M3",
            ModelName::Joint => return None,
        };
        let merge = match (variant.merge, variant.threshold) {
            (MergeName::Mul, ThresholdName::Fixed) => "mul",
            (MergeName::Add, ThresholdName::Fixed) => "add_2",
            (MergeName::Mul, ThresholdName::Entropy) => "entropy",
            (MergeName::Add, ThresholdName::Entropy) => "entropy_add_2",
            (MergeName::Max, ThresholdName::None) => "baseline",
            _ => return None,
        };
        let mut sum = [0.0; 3];
        for set in sets {
            let key = (set.clone(), model.to_owned(), merge.to_owned());
            let a = self.accuracies.get(&key)?;
            sum[0] += a.action_decided;
            sum[1] += a.triple_argmax;
            sum[2] += a.triple_decided;
        }
        let n = sets.len().max(1) as f64;
        Some(Accuracy {
            action_decided: sum[0] / n,
            triple_argmax: sum[1] / n,
            triple_decided: sum[2] / n,
        })
    }

    /// The recorded bound, the mean over sets of one size.
    #[must_use]
    pub fn bound(&self, sets: &[String]) -> Option<f64> {
        let sum = sets
            .iter()
            .try_fold(0.0, |sum, set| Some(sum + self.bounds.get(set)?))?;
        Some(sum / sets.len().max(1) as f64)
    }
}
