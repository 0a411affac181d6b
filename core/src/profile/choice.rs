//! What can be chosen about a decision.

use serde::{Deserialize, Serialize};

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
