//! How likely the words of a sample are, given what was meant.

use super::{Case, Untold, log_sum};
use crate::free;
use crate::generate::{Kind, raised};
use crate::maker::Maker;
use crate::noise::{Level, Noise};
use crate::record::{CATEGORIES, MODALITIES};

/// How often an element that is none is raised, to the joint model: 1 in 20 among actions, 1 in 10
/// elsewhere.
const RAISED: [f64; CATEGORIES] = [0.05, 0.1, 0.1];

impl Case<'_> {
    /// The logarithm of the density of all words of a category when option `k` is meant.
    pub(super) fn words(&self, category: usize, k: usize) -> f64 {
        (0..MODALITIES)
            .map(|m| match self.maker {
                Maker::Paper(kind, level) => self.raised_word(m, category, k, kind, level),
                Maker::Free(level) => self.rivalled_word(m, category, k, level),
            })
            .sum()
    }

    fn raised_word(&self, m: usize, c: usize, k: usize, kind: Kind, level: Level) -> f64 {
        let Some(word) = &self.record.words[m][c] else {
            return 0.0;
        };
        let row = &self.catalogue.similarity[m][c][k];
        let raised = if c == 0 {
            raised(self.catalogue, kind, self.record, k)
        } else {
            vec![false; row.len()]
        };
        let noise = Noise::from(level);
        let elements = word.iter().zip(row).zip(raised);
        elements
            .map(|((&x, &mu), raised)| {
                let mu = if raised { row[k] } else { mu };
                noise.log_evidence(f64::from(x), f64::from(mu))
            })
            .sum()
    }

    /// A word that may have one rival at the level of what is meant.
    fn rivalled_word(&self, m: usize, c: usize, k: usize, level: Level) -> f64 {
        let Some(word) = &self.record.words[m][c] else {
            return 0.0;
        };
        let noise = self.noise(level, m);
        let row = &self.catalogue.similarity[m][c][k];
        if self.untold.has(Untold::Rivals) {
            let elements = word.iter().zip(row).enumerate();
            return elements
                .map(|(i, (&x, &mu))| {
                    let x = f64::from(x);
                    let plain = noise.log_evidence(x, f64::from(mu));
                    let raised = noise.log_evidence(x, f64::from(row[k])) + RAISED[c].ln();
                    if i == k { plain } else { plain.max(raised) }
                })
                .sum();
        }
        let plain = self.row(m, c, k, level);
        let rivals = word.iter().zip(row).enumerate().filter(|(r, _)| *r != k);
        let others = (word.len().max(2) - 1) as f64;
        let gain: f64 = rivals
            .map(|(_, (&x, &mu))| {
                let x = f64::from(x);
                let raised = noise.log_evidence(x, f64::from(row[k]));
                (raised - noise.log_evidence(x, f64::from(mu))).exp()
            })
            .sum();
        let rival = free::RIVAL[c];
        plain + (1.0 - rival + rival / others * gain).ln()
    }

    /// The logarithm of the density of all words of a category that what is meant does not have:
    /// any option's row, no rivals.
    pub(super) fn mistaken(&self, c: usize) -> f64 {
        let Maker::Free(level) = self.maker else {
            return 0.0;
        };
        let n = self.catalogue.count(c);
        let heard = (0..MODALITIES).filter(|&m| self.record.words[m][c].is_some());
        heard
            .map(|m| {
                let rows: Vec<f64> = (0..n).map(|k| self.row(m, c, k, level)).collect();
                log_sum(&rows) - (n.max(1) as f64).ln()
            })
            .sum()
    }

    fn noise(&self, level: Level, m: usize) -> Noise {
        match self.untold.has(Untold::Scale) {
            true => level.into(),
            false => free::noise(level, m),
        }
    }

    fn row(&self, m: usize, c: usize, k: usize, level: Level) -> f64 {
        let noise = self.noise(level, m);
        let row = &self.catalogue.similarity[m][c][k];
        let word = self.record.words[m][c].iter().flatten();
        word.zip(row)
            .map(|(&x, &mu)| noise.log_evidence(f64::from(x), f64::from(mu)))
            .sum()
    }
}
