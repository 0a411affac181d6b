//! Which variant of the method decides, and with which numbers (the paper, Table I; METHOD).

use serde::{Deserialize, Serialize};

use crate::clarify::QUESTIONS;
use crate::joint::calibration::RISKS;
use crate::merge::Merge;
use crate::sentence::{LANGUAGE, MODALITIES};

/// Which penalties apply to an action's likelihood (the paper, Evaluated models).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Model {
    /// Merge only, by maximum, and take the largest whatever its clarity.
    Baseline,
    /// Merge only.
    M1,
    /// Merge and alpha: unaligned parameters.
    M2,
    /// Merge, alpha and beta: unaligned features too.
    M3,
    /// The posterior over whole intents: see [`crate::joint`]. Of the profile it takes the
    /// threshold, the alignment, the weights and whether it is guarded.
    Joint,
}

/// What makes an option clear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Threshold {
    /// Every best option is clear.
    None,
    /// h < H(p) of the vector itself.
    Entropy,
    /// h < the mean normalised entropy of white noise of the same length.
    WhiteNoise,
    /// The likelihood itself against two fixed numbers.
    Fixed {
        /// Above this an option is clear; the paper's t_C is 0.25.
        clear: f32,
        /// Above this it is unclear, below it noise; the paper's t_U is 0.11.
        unclear: f32,
    },
    /// The confidence in the whole intent against a cut that keeps wrong executions rare; for the
    /// joint model alone.
    Risk {
        /// The share of all commands that may be executed wrongly: at least the smallest of
        /// [`crate::joint::calibration::RISKS`], which are those it is rounded down to.
        rate: f32,
    },
}

impl Threshold {
    /// At most one command in a hundred executed wrongly.
    pub const RISK: Self = Self::Risk { rate: 0.01 };

    /// The paper's fixed thresholds.
    pub const FIXED: Self = Self::Fixed {
        clear: 0.25,
        unclear: 0.11,
    };

    /// Whether clarity is judged on a vector that sums to 1.
    #[must_use]
    pub fn is_relative(self) -> bool {
        matches!(self, Self::Entropy | Self::WhiteNoise)
    }
}

/// Which things can speak for an action in beta.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum BetaScope {
    /// Those whose merged likelihood is clear (the paper, eq. 10).
    Clear,
    /// Any pair of things in the scene (the reference).
    Any,
}

/// When a category counts as present in the merged sentence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Presence {
    /// With the probability that some present word belongs to it.
    Probability,
    /// Surely, when the likelihoods of one modality sum to more than this (the reference: 0.1).
    Sum(f32),
}

/// Which words of different modalities speak of the same thing: see [`crate::align`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Align {
    /// Those of one category, whatever their places.
    Category,
    /// Those at one place of their sentences (the paper, eq. 3), where absent words keep theirs.
    Position,
}

/// What a modality that lacks a word contributes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Missing {
    /// Nothing: the word is left out of the mix (the paper).
    Skip,
    /// A vector of zeros, which halves a mean and zeroes a product (the reference's fixed modes).
    Zero,
}

/// What happens when more than one option is clear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SeveralClear {
    /// The person is asked (the paper).
    Ask,
    /// The best is taken when it leads (the reference).
    TakeBest,
}

/// The largest weight: beyond it nothing else would count, and sums could leave the floats.
const WEIGHT: f32 = 1_000.0;

/// The smallest [`Profile::least_h`]: the reference's.
const LEAST_H: f32 = 1e-14;

/// Everything that can be set about a decision.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Profile {
    /// Which penalties apply.
    pub model: Model,
    /// The mixing operator; the Baseline's is [`Merge::Max`].
    pub merge: Merge,
    /// Whether words are divided by their diagonal cross-entropy before they are mixed (eq. 4).
    pub penalised: bool,
    /// What makes an option clear.
    pub threshold: Threshold,
    /// W_m, the weight of each modality.
    pub weights: [f32; MODALITIES],
    /// A of eq. 7, in 0..1: what each category out of place multiplies an action's likelihood by.
    pub signature_penalty: f32,
    /// Which things can speak for an action.
    pub beta: BetaScope,
    /// When a category counts as present.
    pub presence: Presence,
    /// Which words of different modalities speak of the same thing.
    pub align: Align,
    /// What a modality that lacks a word contributes.
    pub missing: Missing,
    /// By how much the best option must lead the next.
    pub lead: f32,
    /// The smallest cross-entropy a likelihood is divided by; 0.01 lets a certain option count a
    /// hundredfold.
    pub least_h: f32,
    /// What happens when more than one action is clear.
    pub several_clear: SeveralClear,
    /// Whether an action that the penalties left almost nothing, or a thing it cannot be done to,
    /// is asked about instead of executed. The paper normalises what is left, so that the least
    /// impossible action can look certain.
    pub guarded: bool,
    /// How many questions the joint model may ask about one command, 0..=4; the others ask as long as
    /// they are answered.
    pub questions: u8,
    /// Two habits of the reference that the paper does not have: see [`crate::reference`].
    pub reference_quirks: bool,
}

impl Profile {
    /// The paper's full model: M3, penalised sum, thresholds from the vector's own entropy.
    pub const PAPER: Self = Self {
        model: Model::M3,
        merge: Merge::Add,
        penalised: true,
        threshold: Threshold::Entropy,
        weights: [1.0; MODALITIES],
        signature_penalty: 0.2,
        beta: BetaScope::Clear,
        presence: Presence::Probability,
        align: Align::Category,
        missing: Missing::Skip,
        lead: 0.01,
        least_h: 0.01,
        several_clear: SeveralClear::Ask,
        guarded: true,
        questions: 2,
        reference_quirks: false,
    };

    /// The joint model at a risk of 1 %.
    pub const JOINT: Self = Self {
        model: Model::Joint,
        threshold: Threshold::RISK,
        ..Self::PAPER
    };

    /// The paper's Baseline: the maximum over modalities, no penalties, no thresholds.
    pub const BASELINE: Self = Self {
        model: Model::Baseline,
        merge: Merge::Max,
        penalised: false,
        threshold: Threshold::None,
        ..Self::PAPER
    };

    /// The paper's full model with its fixed thresholds, which were tuned for the mean of two
    /// modalities' words; a product wants weights of 1.
    pub const FIXED: Self = Self {
        penalised: false,
        threshold: Threshold::FIXED,
        weights: [0.5; MODALITIES],
        ..Self::PAPER
    };

    /// The authors' public implementation with entropy thresholds (METHOD, section 5): `merge` is
    /// `Mul` for its "entropy" and `Add` for its "entropy_add_2".
    #[must_use]
    pub const fn reference_entropy(model: Model, merge: Merge) -> Self {
        Self {
            model,
            merge,
            beta: BetaScope::Any,
            presence: Presence::Sum(0.1),
            least_h: LEAST_H,
            several_clear: SeveralClear::TakeBest,
            guarded: false,
            reference_quirks: true,
            ..Self::PAPER
        }
    }

    /// The authors' public implementation with fixed thresholds: `merge` is `Mul` for its "mul" and
    /// `Add` for its "add_2", a mean, whose half is in the weights here.
    #[must_use]
    pub const fn reference_fixed(model: Model, merge: Merge) -> Self {
        let mut weights = [1.0; MODALITIES];
        let [gesture, language, ..] = &mut weights;
        *gesture = 0.8;
        *language = 0.99;
        if matches!(merge, Merge::Add) {
            *gesture *= 0.5;
            *language *= 0.5;
        }
        Self {
            penalised: false,
            threshold: Threshold::Fixed {
                clear: 0.2,
                unclear: 0.11,
            },
            weights,
            missing: Missing::Zero,
            ..Self::reference_entropy(model, merge)
        }
    }

    /// The authors' public implementation of the maximum without thresholds, its "baseline", which
    /// keeps its penalties.
    #[must_use]
    pub const fn reference_baseline(model: Model) -> Self {
        Self {
            penalised: false,
            threshold: Threshold::None,
            missing: Missing::Zero,
            ..Self::reference_entropy(model, Merge::Max)
        }
    }

    /// The weight of a modality; 0 for one that does not exist.
    #[must_use]
    pub fn weight(&self, modality: u8) -> f32 {
        self.weights
            .get(usize::from(modality))
            .copied()
            .unwrap_or(0.0)
    }

    /// What is wrong with it, if anything.
    ///
    /// # Errors
    /// [`ProfileError`] naming the field.
    #[inline(never)]
    pub fn check(&self) -> Result<(), ProfileError> {
        let positive = |x: f32| x > 0.0 && x.is_finite();
        if !self.weights.iter().all(|&w| positive(w) && w <= WEIGHT) {
            return Err(ProfileError::Weights);
        }
        if !(positive(self.signature_penalty) && self.signature_penalty <= 1.0) {
            return Err(ProfileError::SignaturePenalty);
        }
        if !(0.0..1.0).contains(&self.lead) {
            return Err(ProfileError::Lead);
        }
        if !(positive(self.least_h) && self.least_h >= LEAST_H) {
            return Err(ProfileError::LeastH);
        }
        if usize::from(self.questions) > QUESTIONS {
            return Err(ProfileError::Questions);
        }
        let whole = self.model == Model::Joint;
        match self.threshold {
            Threshold::Risk { .. } if !whole => Err(ProfileError::ModelAndThreshold),
            Threshold::Entropy | Threshold::WhiteNoise | Threshold::Fixed { .. } if whole => {
                Err(ProfileError::ModelAndThreshold)
            }
            Threshold::Risk { rate }
                if !RISKS
                    .first()
                    .is_some_and(|least| (*least..1.0).contains(&rate)) =>
            {
                Err(ProfileError::Risk)
            }
            Threshold::Fixed { clear, unclear }
                if !(unclear >= 0.0 && clear >= unclear && clear.is_finite()) =>
            {
                Err(ProfileError::FixedThresholds)
            }
            _ => Ok(()),
        }
    }
}

impl Default for Profile {
    fn default() -> Self {
        Self::PAPER
    }
}

/// Which field of a [`Profile`] cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ProfileError {
    /// Weights must be above 0 and at most 1,000.
    Weights,
    /// The signature penalty A must be above 0 and at most 1.
    SignaturePenalty,
    /// The lead must be in 0..1.
    Lead,
    /// The least cross-entropy must be finite and at least 1e-14, the reference's.
    LeastH,
    /// Fixed thresholds must be finite, with clear >= unclear >= 0.
    FixedThresholds,
    /// The risk threshold is for the joint model alone, which takes no other but none.
    ModelAndThreshold,
    /// The tolerated risk must be below 1, and no smaller than the smallest that there is a cut for.
    Risk,
    /// At most [`QUESTIONS`] questions can be asked about a command.
    Questions,
}

const _: () = assert!(
    LANGUAGE == 1,
    "reference_fixed writes its weights by position"
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_named_profiles_are_sound() {
        let models = [Model::M1, Model::M2, Model::M3];
        for m in models {
            assert_eq!(Profile::reference_entropy(m, Merge::Mul).check(), Ok(()));
            assert_eq!(Profile::reference_fixed(m, Merge::Add).check(), Ok(()));
            assert_eq!(Profile::reference_baseline(m).check(), Ok(()));
        }
        assert_eq!(Profile::PAPER.check(), Ok(()));
        assert_eq!(Profile::BASELINE.check(), Ok(()));
        assert_eq!(Profile::FIXED.check(), Ok(()));
        assert_eq!(
            Profile::reference_fixed(Model::M1, Merge::Add).weight(LANGUAGE),
            0.495
        );
    }

    #[test]
    fn what_cannot_be_is_named() {
        let bad = |change: fn(&mut Profile)| {
            let mut p = Profile::PAPER;
            change(&mut p);
            p.check()
        };
        assert_eq!(bad(|p| p.weights[2] = f32::NAN), Err(ProfileError::Weights));
        assert_eq!(bad(|p| p.weights[1] = 1e30), Err(ProfileError::Weights));
        assert_eq!(bad(|p| p.least_h = 1e-30), Err(ProfileError::LeastH));
        assert_eq!(
            bad(|p| p.signature_penalty = 0.0),
            Err(ProfileError::SignaturePenalty)
        );
        assert_eq!(bad(|p| p.lead = 1.0), Err(ProfileError::Lead));
        assert_eq!(bad(|p| p.least_h = 0.0), Err(ProfileError::LeastH));
        let upside_down = Threshold::Fixed {
            clear: 0.1,
            unclear: 0.2,
        };
        let p = Profile {
            threshold: upside_down,
            ..Profile::PAPER
        };
        assert_eq!(p.check(), Err(ProfileError::FixedThresholds));
    }
}
