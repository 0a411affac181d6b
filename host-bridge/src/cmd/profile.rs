//! Which variant of the method decides.

use clap::{Args, ValueEnum};
use deictic_core::merge::Merge;
use deictic_core::profile::{Align, Model, Profile, Threshold};
use miette::Result;

use super::advice;
use crate::language::Uncertainty;

/// Which variant of the method decides, on top of a named one.
#[derive(Args, Clone, Copy, Debug)]
pub struct Choice {
    /// The paper's method, or its authors' public implementation with its habits
    #[arg(long, value_enum, default_value_t = Named::Paper)]
    profile: Named,
    /// Merge only (m1), with unaligned parameters (m2), with unaligned features too (m3); or one
    /// posterior over whole intents (joint)
    #[arg(long, value_enum, default_value_t = ModelName::M3)]
    model: ModelName,
    /// How the words of several modalities become one
    #[arg(long, value_enum, default_value_t = MergeName::Add)]
    merge: MergeName,
    /// What makes an option clear [default: entropy; of the joint model: risk]
    #[arg(long, value_enum)]
    threshold: Option<ThresholdName>,
    /// Which words of different modalities speak of the same thing
    #[arg(long, value_enum, default_value_t = AlignName::Category)]
    align: AlignName,
    /// The share of commands that may be executed wrongly, from 0.003 to below 1: 0.01 is 1 %; of the
    /// joint model [default: 0.01]
    #[arg(long, value_name = "SHARE")]
    risk: Option<f32>,
    /// How many questions may be asked about a command before it is given up; of the joint model
    /// [default: 2]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=4))]
    questions: Option<u8>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Named {
    Paper,
    Reference,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum ModelName {
    Baseline,
    M1,
    M2,
    M3,
    Joint,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum MergeName {
    Max,
    Mul,
    Add,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum ThresholdName {
    /// Every best option is clear
    None,
    /// Against the entropy of the word itself
    Entropy,
    /// Against the entropy of white noise
    WhiteNoise,
    /// Against fixed likelihoods
    Fixed,
    /// The confidence in the whole intent against the tolerated risk; of the joint model
    Risk,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum AlignName {
    /// Those of one category, in whatever order they were said and shown
    Category,
    /// Those at one place of their sentences, as in the paper
    Position,
}

impl Choice {
    /// Refuses what the chosen model would not go by.
    ///
    /// # Errors
    /// A report with what to do.
    pub fn check(self) -> Result<()> {
        if matches!(self.model, ModelName::Joint) {
            return Ok(());
        }
        let given = [
            ("--risk", self.risk.is_some()),
            ("--questions", self.questions.is_some()),
        ];
        match given.iter().find(|(_, given)| *given) {
            None => Ok(()),
            Some((option, _)) => Err(advice(
                format!("{option} is for the joint model, and the paper's models do not go by it"),
                format!("add --model joint, or leave {option} out"),
            )),
        }
    }

    /// The same with the joint model and its usual threshold.
    #[must_use]
    pub fn joint(self) -> Self {
        Self {
            model: ModelName::Joint,
            threshold: None,
            ..self
        }
    }

    /// How sure a word is: the paper's models weigh figures against each other by their entropy, and
    /// the joint model takes them for the likelihoods that they are.
    pub fn uncertainty(self) -> Uncertainty {
        match self.model {
            ModelName::Joint => Uncertainty::LIKELIHOOD,
            _ => Uncertainty::default(),
        }
    }

    /// The core's profile.
    pub fn profile(self) -> Profile {
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
        let usual = match model {
            Model::Joint => ThresholdName::Risk,
            _ => ThresholdName::Entropy,
        };
        let threshold = match self.threshold.unwrap_or(usual) {
            ThresholdName::None => Threshold::None,
            ThresholdName::Entropy => Threshold::Entropy,
            ThresholdName::WhiteNoise => Threshold::WhiteNoise,
            ThresholdName::Fixed => Threshold::FIXED,
            ThresholdName::Risk => self
                .risk
                .map_or(Threshold::RISK, |rate| Threshold::Risk { rate }),
        };
        let align = match self.align {
            AlignName::Category => Align::Category,
            AlignName::Position => Align::Position,
        };
        let profile = match (self.profile, model, threshold) {
            (Named::Paper, Model::Baseline, _) => Profile::BASELINE,
            (_, Model::Joint, _) => Profile {
                threshold,
                questions: self.questions.unwrap_or(Profile::JOINT.questions),
                ..Profile::JOINT
            },
            (Named::Paper, ..) => Profile {
                model,
                merge,
                threshold,
                ..Profile::PAPER
            },
            (Named::Reference, _, Threshold::None) => Profile::reference_baseline(model),
            (Named::Reference, _, Threshold::Fixed { .. }) => {
                Profile::reference_fixed(model, merge)
            }
            (Named::Reference, ..) => Profile {
                threshold,
                ..Profile::reference_entropy(model, merge)
            },
        };
        Profile { align, ..profile }
    }
}
