//! The profiles of the paper and of the reference.

use super::{
    Align, BetaScope, LEAST_H, Missing, Model, Presence, Profile, SeveralClear, Threshold,
};
use crate::merge::Merge;
use crate::sentence::{LANGUAGE, MODALITIES};

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
}

const _: () = assert!(
    LANGUAGE == 1,
    "reference_fixed writes its weights by position"
);
