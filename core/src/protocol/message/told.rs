//! What a unit tells of its decisions and of itself.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::category::Category;
use crate::decide::Decision;
use crate::protocol::link::Counters;

/// A decision and what it was made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decided<const C: usize> {
    /// Its number, counted from 1 at every start of the unit.
    pub number: u32,
    /// The fingerprint of the vocabulary it speaks.
    pub vocabulary: u32,
    /// The version of the scene it was made on.
    pub scene: u32,
    /// The modalities it draws on, one bit each.
    pub modalities: u8,
    /// How many more questions may be asked about the command after this one, if it is one; of models
    /// that do not count them as many as the profile has.
    pub questions_left: u8,
    /// What to do now.
    pub decision: Decision<C>,
}

/// What is not decided on, as it was forbidden.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Withheld {
    /// The modalities whose sentences are dropped, one bit each; none when nothing waited.
    pub modalities: u8,
    /// Whether this answers a [`super::ToUnit::Forbid`]: each is answered once, and every decision told after that was
    /// made on what came after it. Otherwise a sentence came within the window.
    pub confirms: bool,
}

/// Why a decision came out as it did: one category ([`crate::trace::CategoryTrace`]).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Why<const N: usize> {
    /// The decision's number.
    pub number: u32,
    /// The category.
    pub category: Category,
    /// Probability that it is in the merged sentence.
    pub present: f32,
    /// The merged word; for actions after alpha and beta.
    pub merged: Vec<f32, N>,
    /// Its diagonal cross-entropy.
    pub h: Vec<f32, N>,
    /// Its normalised entropy.
    pub entropy: f32,
    /// Against what clarity was judged.
    pub threshold: f32,
    /// Which options are clear, one bit each.
    pub clear: u64,
}

/// Why a decision came out as it did: the actions' penalties.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WhyActions<const N: usize> {
    /// The decision's number.
    pub number: u32,
    /// The merged action word before any penalty.
    pub heard: Vec<f32, N>,
    /// alpha of every action.
    pub alpha: Vec<f32, N>,
    /// beta of every action.
    pub beta: Vec<f32, N>,
}

/// Why a decision of the joint model came out as it did: how far the likeliest whole intent is
/// believed ([`crate::joint::belief::Belief`]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WhyWhole {
    /// The decision's number.
    pub number: u32,
    /// The posterior of the likeliest intent, 0..=1; 0 when there is none.
    pub posterior: f32,
    /// The logit of the confidence in it.
    pub confidence: f32,
    /// The logit from which on it is executed; `None` when it is executed however sure.
    pub cut: Option<f32>,
}

/// What a unit has counted since it started.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics {
    /// What has become of frames.
    pub link: Counters,
    /// Decisions to execute.
    pub executes: u32,
    /// Decisions to ask.
    pub asks: u32,
    /// Decisions to ask for a repetition.
    pub repeats: u32,
    /// Faults that were told.
    pub faults: u32,
}
