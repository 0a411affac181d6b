//! Which variant of the method decides, and with which numbers (the paper, Table I; METHOD).

mod choice;
mod named;

use serde::{Deserialize, Serialize};

use crate::clarify::QUESTIONS;
use crate::joint::calibration::RISKS;
use crate::merge::Merge;
use crate::sentence::MODALITIES;

pub use choice::{Align, BetaScope, Missing, Model, Presence, SeveralClear, Threshold};

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sentence::LANGUAGE;

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
