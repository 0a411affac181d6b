//! The joint model's confidence and cut, fitted to generated samples.
//!
//! [`fit`] scales the logits of the posterior and of its action by noise class and kinds of words
//! (Platt) and finds the shape of the cut.
//! [`mod@test`] then shifts that shape by learn-then-test (Angelopoulos et al. 2021): a fixed sequence
//! of shifts, from cautious to bold, each tested for "in some cell more than 1 % of all commands are
//! executed wrongly" with the largest exact binomial p-value over all cells, until the first that
//! cannot be refuted at 5 %. A maximum of p-values is valid for such a union and a fixed sequence
//! needs no correction, so with 95 % probability over the samples the risk is at most 1 % in all
//! cells at once. That assumes samples that are independent, alike those met in use, and none of
//! which was used by [`fit`]; it says nothing about another vocabulary, noise or kind of scene.

use deictic_core::joint::KINDS;
use deictic_core::joint::belief::{Belief, logit, shares};

use crate::density::six_digits;

pub mod asking;
pub mod fit;
pub mod reliability;
pub mod test;

/// Levels of noise that the confidence knows.
pub const KNOTS: usize = deictic_core::joint::LEVELS;

/// The tolerated shares of all commands that are executed wrongly, that there is a cut for.
pub const RISKS: [f64; 4] = [0.003, 0.01, 0.03, 0.1];

/// What was believed of a sample.
#[derive(Clone, Copy, Debug)]
pub struct Believed {
    /// The best intent's posterior and the noise that was heard.
    pub belief: Belief,
    /// Whether that intent is what was meant.
    pub right: bool,
    /// Whether it was executed.
    pub executed: bool,
}

/// Samples of one kind and noise level.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Its set's name.
    pub name: String,
    /// The noise level's number, 0 to 4.
    pub level: usize,
    /// Whether the freer generator made it.
    pub free: bool,
    /// Its samples.
    pub samples: Vec<Believed>,
}

/// What a flashed table holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Table {
    /// What the posterior's logit is multiplied by, per kinds of words and noise class.
    pub slope: [[f64; KNOTS]; KINDS],
    /// What its action's is.
    pub action: [[f64; KNOTS]; KINDS],
    /// What is added.
    pub offset: [[f64; KNOTS]; KINDS],
    /// The logit from which on is executed, per risk.
    pub cuts: [[f64; KNOTS]; RISKS.len()],
}

/// Shares of the knots, as the core has them.
fn hat(belief: &Belief) -> [f64; KNOTS] {
    shares(belief.noise).map(f64::from)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Table {
    /// Logit of the confidence.
    #[must_use]
    pub fn confidence(&self, belief: &Belief) -> f64 {
        let (hat, kind) = (hat(belief), belief.kind());
        dot(&self.slope[kind], &hat) * f64::from(logit(belief.posterior))
            + dot(&self.action[kind], &hat) * f64::from(logit(belief.action))
            + dot(&self.offset[kind], &hat)
    }

    /// As source of the core.
    #[must_use]
    pub fn source(&self) -> String {
        let row = |row: &[f64; KNOTS]| row.map(six_digits);
        let mut source = "//! Made by `deictic-eval calibrate`: do not edit.\n\
             \n\
             use super::{KINDS, Levels};\n"
            .to_owned();
        let tables = [
            (
                "SLOPE",
                "What the posterior's logit is multiplied by",
                &self.slope,
            ),
            (
                "ACTION",
                "What its action's logit is multiplied by",
                &self.action,
            ),
            ("OFFSET", "What is added to both", &self.offset),
        ];
        for (name, what, table) in tables {
            source.push_str(&format!(
                "\n/// {what}, by kinds of words and noise level.\n\
                 #[rustfmt::skip]\n\
                 pub const {name}: [Levels; KINDS] = [\n"
            ));
            for knots in table {
                source.push_str(&format!("    {:?},\n", row(knots)));
            }
            source.push_str("];\n");
        }
        source.push_str(&format!(
            "\n/// The risks that there are cuts for, smallest first: the share of all commands that are executed\n\
             /// wrongly.\n\
             pub const RISKS: [f32; {}] = {:?};\n\
             \n\
             /// For each of them the logit of the confidence from which on an intent is executed.\n\
             #[rustfmt::skip]\n\
             pub const CUTS: [Levels; {}] = [\n",
            RISKS.len(),
            RISKS,
            RISKS.len(),
        ));
        for cut in &self.cuts {
            source.push_str(&format!("    {:?},\n", row(cut)));
        }
        source.push_str("];\n");
        source
    }
}

/// Expected calibration error in percent: the mean over ten bins of how far the mean confidence is
/// from the share that is right.
#[must_use]
pub fn calibration_error(samples: &[(f64, bool)]) -> f64 {
    let far: f64 = reliability(samples)
        .iter()
        .map(|[n, confidence, right]| (confidence - right).abs() * n)
        .sum();
    100.0 * far / samples.len().max(1) as f64
}

/// Per tenth of confidence: samples, their mean confidence, and the share that is right.
#[must_use]
pub fn reliability(samples: &[(f64, bool)]) -> [[f64; 3]; 10] {
    let mut bins = [[0.0; 3]; 10];
    for (confidence, right) in samples {
        let [n, sum, rights] = &mut bins[((confidence * 10.0) as usize).min(9)];
        *n += 1.0;
        *sum += confidence;
        *rights += f64::from(u8::from(*right));
    }
    bins.map(|[n, sum, right]| [n, sum / n.max(1.0), right / n.max(1.0)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coin_called_fairly_is_calibrated() {
        let fair: Vec<_> = (0..1000).map(|i| (0.55, i % 20 < 11)).collect();
        assert!(calibration_error(&fair) < 1e-9);
        let bold: Vec<_> = (0..1000).map(|i| (0.95, i % 20 < 11)).collect();
        assert!((calibration_error(&bold) - 40.0).abs() < 1e-9);
    }
}
