//! The method once more, in 64-bit floats, slowly and as obviously as METHOD's sections are written: what the core's
//! answers are held against. It shares the core's types but none of its arithmetic.
//!
//! Two roundings of the same formula may fall on either side of a threshold. [`Margin`] remembers the closest
//! comparison that was made, so that whoever compares decisions can leave out those that hang by a hair.

mod decide;
mod merge;

use deictic_core::board::{Observations, Scene, Vocabulary};
use deictic_core::category::Category;
use deictic_core::profile::Profile;

pub use decide::Verdict;

/// The closest comparison so far, relative to what was compared.
#[derive(Clone, Copy, Debug)]
pub struct Margin(pub f64);

impl Margin {
    /// Whether `a` is below `b`.
    pub fn below(&mut self, a: f64, b: f64) -> bool {
        let distance = (a - b).abs() / a.abs().max(b.abs()).max(1e-3);
        self.0 = self.0.min(distance);
        a < b
    }
}

/// What became of one category's words.
#[derive(Clone, Debug, Default)]
pub struct Merged {
    /// Probability that the category was expressed.
    pub present: f64,
    /// One likelihood per option; empty when nothing was expressed.
    pub word: Vec<f64>,
    /// The diagonal cross-entropy of `word`.
    pub h: Vec<f64>,
    /// Its normalised entropy.
    pub entropy: f64,
    /// Whether what was left before it was normalised is below anything that 32-bit floats tell apart.
    pub faint: bool,
}

/// Below this the product of four modalities leaves the range of 32-bit floats.
const FAINT: f64 = 1e-30;

/// Whether a word is there, and hardly.
fn is_faint(word: &[f64]) -> bool {
    let largest = word.iter().copied().fold(0.0, f64::max);
    largest > 0.0 && largest < FAINT
}

/// Everything the method computes on the way to its decision.
#[derive(Clone, Debug)]
pub struct Method {
    /// By category, the action's first.
    pub categories: Vec<Merged>,
    /// The merged action word before its penalties.
    pub heard: Vec<f64>,
    /// Per action.
    pub alpha: Vec<f64>,
    /// Per action.
    pub beta: Vec<f64>,
    /// What to do.
    pub verdict: Verdict,
    /// How near the nearest comparison was.
    pub margin: Margin,
}

/// Runs the method. The profile must be sound and without the reference implementation's quirks.
#[must_use]
pub fn run(
    vocabulary: &Vocabulary,
    scene: &Scene,
    observations: &Observations,
    profile: &Profile,
) -> Method {
    let mut margin = Margin(f64::INFINITY);
    let mut categories: Vec<Merged> = (0..vocabulary.options().len())
        .filter_map(Category::from_index)
        .map(|category| merge::category(vocabulary, observations, profile, category))
        .collect();
    let penalties =
        merge::penalise_actions(vocabulary, scene, profile, &mut categories, &mut margin);
    let verdict = decide::decide(
        vocabulary,
        scene,
        profile,
        &categories,
        &penalties,
        &mut margin,
    );
    Method {
        categories,
        heard: penalties.heard,
        alpha: penalties.alpha,
        beta: penalties.beta,
        verdict,
        margin,
    }
}

/// Normalised entropy and diagonal cross-entropies of a word.
fn cross_entropy(word: &[f64]) -> (f64, Vec<f64>) {
    let n = word.len();
    if n < 2 {
        return (1.0, vec![1.0; n]);
    }
    let epsilon = f64::from(deictic_core::entropy::EPSILON);
    let sum: f64 = word.iter().map(|w| w + epsilon).sum();
    let p = word.iter().map(|w| (w + epsilon) / sum);
    let h: Vec<f64> = p
        .clone()
        .map(|p| (-p.log2() / (n as f64).log2()).max(0.0))
        .collect();
    let entropy = p.zip(&h).map(|(p, h)| p * h).sum();
    (entropy, h)
}

fn normalised(word: &[f64]) -> Vec<f64> {
    let sum: f64 = word.iter().sum();
    if sum > 0.0 {
        word.iter().map(|w| w / sum).collect()
    } else {
        word.to_vec()
    }
}
