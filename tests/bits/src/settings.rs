//! Which settings a sample is decided with.

use deictic_core::merge::Merge;
use deictic_core::profile::{
    BetaScope, Missing, Model, Presence, Profile, SeveralClear, Threshold,
};

/// Merge, threshold and family go round with the sample's number: 3 * 4 * 3 combinations.
pub fn profile(i: u32, model: Model) -> Profile {
    if model == Model::Joint {
        return joint(i);
    }
    let merge = match i % 3 {
        0 => Merge::Max,
        1 => Merge::Mul,
        _ => Merge::Add,
    };
    let threshold = match (i / 3) % 4 {
        0 => Threshold::None,
        1 => Threshold::Entropy,
        2 => Threshold::WhiteNoise,
        _ => Threshold::FIXED,
    };
    match (i / 12) % 3 {
        0 => Profile {
            model,
            merge,
            threshold,
            ..Profile::PAPER
        },
        1 => Profile {
            model,
            merge,
            threshold,
            penalised: false,
            weights: [0.8, 0.99, 0.5, 1.0],
            beta: BetaScope::Any,
            presence: Presence::Sum(0.1),
            missing: Missing::Zero,
            several_clear: SeveralClear::TakeBest,
            ..Profile::PAPER
        },
        _ => reference(model, merge, threshold),
    }
}

/// The joint model, every other time without a threshold and every third with uneven weights.
fn joint(i: u32) -> Profile {
    let mut profile = Profile::JOINT;
    if i % 2 == 1 {
        profile.threshold = Threshold::None;
    }
    if i % 3 == 2 {
        profile.weights = [0.8, 0.99, 0.5, 1.0];
    }
    profile
}

fn reference(model: Model, merge: Merge, threshold: Threshold) -> Profile {
    let profile = match threshold {
        Threshold::None => Profile::reference_baseline(model),
        Threshold::Fixed { .. } => Profile::reference_fixed(model, merge),
        _ => Profile::reference_entropy(model, merge),
    };
    match threshold {
        Threshold::WhiteNoise => Profile {
            threshold,
            ..profile
        },
        _ => Profile { merge, ..profile },
    }
}
