//! The variants of the method that the paper compares (its Table I), as settings of the core.

use std::fmt;

use clap::ValueEnum;
use deictic_core::merge::Merge;
use deictic_core::profile::{Align, Model, Profile, Threshold};
use deictic_core::sentence::MODALITIES;

/// Which penalties apply.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, ValueEnum)]
pub enum ModelName {
    /// The maximum over modalities, nothing else.
    Baseline,
    /// Merge only.
    M1,
    /// Merge and signatures.
    M2,
    /// Merge, signatures and features: the paper's full model.
    M3,
    /// The posterior over whole intents.
    Joint,
}

/// How modalities are mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, ValueEnum)]
pub enum MergeName {
    /// The larger.
    Max,
    /// The product.
    Mul,
    /// The sum.
    Add,
}

/// What makes an option clear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, ValueEnum)]
pub enum ThresholdName {
    /// Nothing: the best is taken.
    None,
    /// The entropy of the vector itself.
    Entropy,
    /// The mean entropy of white noise.
    WhiteNoise,
    /// Two fixed numbers.
    Fixed,
    /// A cut that holds wrong executions to 1 %; for the joint model alone, and its usual one.
    Risk,
}

/// Whose habits the core follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, ValueEnum)]
pub enum ProfileName {
    /// The paper's text.
    #[default]
    Paper,
    /// The authors' public implementation.
    Reference,
}

/// Which words of different modalities speak of the same thing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum AlignName {
    /// Those of one category.
    #[default]
    Category,
    /// Those at one place of their sentences: the paper's rule.
    Position,
}

impl From<AlignName> for Align {
    fn from(name: AlignName) -> Self {
        match name {
            AlignName::Category => Self::Category,
            AlignName::Position => Self::Position,
        }
    }
}

macro_rules! display_as_on_the_command_line {
    ($($name:ty),*) => {$(
        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self.to_possible_value() {
                    Some(value) => f.write_str(value.get_name()),
                    None => Ok(()),
                }
            }
        }
    )*};
}

display_as_on_the_command_line!(ModelName, MergeName, ThresholdName, ProfileName, AlignName);

/// One variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Variant {
    /// Which penalties apply.
    pub model: ModelName,
    /// How modalities are mixed.
    pub merge: MergeName,
    /// What makes an option clear.
    pub threshold: ThresholdName,
    /// Whose habits the core follows.
    pub profile: ProfileName,
}

impl Variant {
    /// A variant; what is not given is as the paper has it: maximum without thresholds for the
    /// Baseline, sum with entropy thresholds for the others. The joint model multiplies whatever is
    /// given, and has no habits of the reference.
    #[must_use]
    pub fn new(
        model: ModelName,
        merge: Option<MergeName>,
        threshold: Option<ThresholdName>,
        profile: ProfileName,
    ) -> Self {
        let (usual_merge, usual_threshold) = match model {
            ModelName::Baseline => (MergeName::Max, ThresholdName::None),
            ModelName::Joint => (MergeName::Mul, ThresholdName::Risk),
            _ => (MergeName::Add, ThresholdName::Entropy),
        };
        Self {
            model,
            merge: merge.unwrap_or(usual_merge),
            threshold: threshold.unwrap_or(usual_threshold),
            profile,
        }
    }

    /// The core's settings for it.
    #[must_use]
    pub fn settings(&self) -> Profile {
        let model = match self.model {
            ModelName::Baseline => Model::Baseline,
            ModelName::M1 => Model::M1,
            ModelName::M2 => Model::M2,
            ModelName::M3 => Model::M3,
            ModelName::Joint => Model::Joint,
        };
        let merge = match self.merge {
            MergeName::Max => Merge::Max,
            MergeName::Mul => Merge::Mul,
            MergeName::Add => Merge::Add,
        };
        let settings = match (self.profile, self.threshold) {
            (_, ThresholdName::Risk) => Profile {
                questions: 0,
                ..Profile::JOINT
            },
            (ProfileName::Paper, ThresholdName::None) => Profile::BASELINE,
            (ProfileName::Paper, ThresholdName::Entropy) => Profile::PAPER,
            (ProfileName::Paper, ThresholdName::WhiteNoise) => Profile {
                threshold: Threshold::WhiteNoise,
                ..Profile::PAPER
            },
            // The halves make a mean of a sum; a product or a maximum stays in 0..=1 without.
            (ProfileName::Paper, ThresholdName::Fixed) if merge != Merge::Add => Profile {
                weights: [1.0; MODALITIES],
                ..Profile::FIXED
            },
            (ProfileName::Paper, ThresholdName::Fixed) => Profile::FIXED,
            (ProfileName::Reference, ThresholdName::None) => Profile::reference_baseline(model),
            (ProfileName::Reference, ThresholdName::Entropy) => {
                Profile::reference_entropy(model, merge)
            }
            (ProfileName::Reference, ThresholdName::WhiteNoise) => Profile {
                threshold: Threshold::WhiteNoise,
                ..Profile::reference_entropy(model, merge)
            },
            (ProfileName::Reference, ThresholdName::Fixed) => {
                Profile::reference_fixed(model, merge)
            }
        };
        Profile {
            model,
            merge,
            ..settings
        }
    }
}
