//! Every experiment of the paper (Experimental results) in one run: ablation, noise, merge and
//! threshold studies on simulated sets and on the user study's set-ups, and the fairer D_free
//! beside its Bayes bound.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::bound::{self, Bound};
use crate::catalogue::Catalogue;
use crate::dataset::Set;
use crate::maker::Maker;
use crate::score::{Field, Tally};
use crate::situation::FeatureForm;
use crate::variant::{MergeName, ModelName, ProfileName, ThresholdName, Variant};

pub mod claims;
pub mod csv;
pub mod draw;
pub mod figure;
pub mod recorded;
pub mod report;
pub mod studies;

/// Models, in the order of their penalties.
pub const MODELS: [ModelName; 4] = [
    ModelName::Baseline,
    ModelName::M1,
    ModelName::M2,
    ModelName::M3,
];

const MERGES: [MergeName; 3] = [MergeName::Max, MergeName::Mul, MergeName::Add];
const THRESHOLDS: [ThresholdName; 4] = [
    ThresholdName::None,
    ThresholdName::Entropy,
    ThresholdName::WhiteNoise,
    ThresholdName::Fixed,
];
const PROFILES: [ProfileName; 2] = [ProfileName::Reference, ProfileName::Paper];

/// Sets that share a vocabulary.
pub struct Group {
    /// What their numbers mean.
    pub catalogue: Catalogue,
    /// The sets.
    pub sets: Vec<Set>,
    /// In which form their features are seen.
    pub form: FeatureForm,
}

/// All counts.
#[derive(Default)]
pub struct Results {
    tallies: BTreeMap<(String, Variant), Tally>,
    bounds: BTreeMap<String, Bound>,
}

/// Every variant of a profile: the paper's 4 models, 3 merges, 3 thresholds and none; and the joint
/// model.
#[must_use]
pub fn variants(profile: ProfileName) -> Vec<Variant> {
    let mut variants = Vec::new();
    for model in MODELS {
        for merge in MERGES {
            for threshold in THRESHOLDS {
                variants.push(Variant {
                    model,
                    merge,
                    threshold,
                    profile,
                });
            }
        }
    }
    // The joint model follows no habits of the reference.
    if profile == ProfileName::Paper {
        variants.push(Variant::new(ModelName::Joint, None, None, profile));
    }
    variants
}

/// How many steps [`run`] takes over these groups.
#[must_use]
pub fn steps(groups: &[Group]) -> usize {
    let sets: usize = groups.iter().map(|g| g.sets.len()).sum();
    sets * PROFILES.len()
}

/// Decides every sample of every set with every variant; `step` is told of each set and profile
/// done.
///
/// # Errors
/// The core's, for samples that do not fit their vocabulary.
pub fn run(groups: &[Group], step: &(impl Fn() + Sync)) -> anyhow::Result<Results> {
    let mut results = Results::default();
    for group in groups {
        let jobs: Vec<(&Set, ProfileName)> = group
            .sets
            .iter()
            .flat_map(|set| PROFILES.map(|profile| (set, profile)))
            .collect();
        let done: Vec<Vec<((String, Variant), Tally)>> = jobs
            .into_par_iter()
            .map(|(set, profile)| {
                let field = Field::new(set, &group.catalogue, profile, group.form)?;
                let mut out = Vec::new();
                for variant in variants(profile) {
                    out.push(((set.name.clone(), variant), field.tally(&variant)?));
                }
                step();
                Ok(out)
            })
            .collect::<anyhow::Result<_>>()?;
        results.tallies.extend(done.into_iter().flatten());
        for set in &group.sets {
            if let Some(maker) = Maker::of(&set.name) {
                let bound = bound::of(&group.catalogue, set, maker);
                results.bounds.insert(set.name.clone(), bound);
            }
        }
    }
    Ok(results)
}

impl Results {
    /// The counts of a variant over one or more sets; `None` when one was not run.
    #[must_use]
    pub fn tally(&self, sets: &[String], variant: Variant) -> Option<Tally> {
        let tally = |name: &String| self.tallies.get(&(name.clone(), variant)).copied();
        sets.iter()
            .map(tally)
            .try_fold(Tally::default(), |sum, tally| Some(sum.plus(tally?)))
    }

    /// The bound over one or more sets.
    #[must_use]
    pub fn bound(&self, sets: &[String]) -> Option<Bound> {
        let bound = |name: &String| self.bounds.get(name).copied();
        sets.iter()
            .map(bound)
            .try_fold(Bound::default(), |sum, bound| Some(sum.plus(bound?)))
    }

    /// All counts, by set and variant.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Variant, &Tally)> {
        self.tallies
            .iter()
            .map(|((set, variant), tally)| (set.as_str(), variant, tally))
    }

    /// All bounds, by set.
    pub fn bounds(&self) -> impl Iterator<Item = (&str, &Bound)> {
        self.bounds.iter().map(|(set, bound)| (set.as_str(), bound))
    }
}

/// The aligned set of a noise level.
#[must_use]
pub fn aligned(level: usize) -> Vec<String> {
    vec![format!("D_A_n{level}")]
}

/// The two unaligned sets of a noise level, which the paper takes together.
#[must_use]
pub fn unaligned(level: usize) -> Vec<String> {
    vec![format!("D_arity_n{level}"), format!("D_prop_n{level}")]
}

/// The set-ups' aligned commands.
#[must_use]
pub fn real_aligned() -> Vec<String> {
    vec!["real_aligned".to_owned()]
}

/// The set-ups' contradicting commands.
#[must_use]
pub fn real_unaligned() -> Vec<String> {
    ["wrong_action", "wrong_object"]
        .iter()
        .flat_map(|wrong| ["gesture", "language"].map(|m| format!("real_{wrong}_in_{m}")))
        .collect()
}
