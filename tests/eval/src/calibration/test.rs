//! Learn-then-test of shifted cuts, by a fixed sequence.

use super::{Cell, KNOTS, Table, dot, hat};

/// How unlikely it may be that the cut does not hold what it promises.
const DELTA: f64 = 0.05;

/// The first shift, more cautious than any that is needed ...
const FIRST: f64 = 3.0;
/// ... and by how much each is bolder than the one before, down to minus the first.
const STEP: f64 = 0.02;

/// The boldest shift of a cut that passes for a tolerated risk; `None` when not even the first does.
#[must_use]
pub fn shift(cells: &[Cell], table: &Table, cut: &[f64; KNOTS], tolerated: f64) -> Option<f64> {
    // A wrong sample is executed at every shift up to its own margin.
    let margins: Vec<(usize, Vec<f64>)> = cells
        .iter()
        .map(|cell| {
            let wrong = cell.samples.iter().filter(|s| !s.right);
            let margin =
                |s: &super::Believed| table.confidence(&s.belief) - dot(cut, &hat(&s.belief));
            (cell.samples.len(), wrong.map(margin).collect())
        })
        .collect();
    let mut passed = None;
    for i in 0..=(2.0 * FIRST / STEP) as u32 {
        let shift = FIRST - STEP * f64::from(i);
        let p = margins.iter().map(|(n, margins)| {
            let wrong = margins.iter().filter(|m| **m >= shift).count();
            at_most(wrong, *n, tolerated)
        });
        if p.fold(0.0, f64::max) > DELTA {
            break;
        }
        passed = Some(shift);
    }
    passed
}

/// The probability of at most `k` of `n` at probability `p` each.
pub(super) fn at_most(k: usize, n: usize, p: f64) -> f64 {
    let (n, ln) = (n as f64, |x: f64| libm::lgamma(x + 1.0));
    let term = |i: f64| (ln(n) - ln(i) - ln(n - i) + i * p.ln() + (n - i) * (1.0 - p).ln()).exp();
    (0..=k).map(|i| term(i as f64)).sum()
}

/// What a cut does to a cell: the share executed, the share executed wrongly of all.
#[must_use]
pub fn shares(cell: &Cell, table: &Table, cut: &[f64; KNOTS]) -> [f64; 2] {
    let n = cell.samples.len().max(1) as f64;
    let executes = |s: &&super::Believed| {
        let hat: [f64; KNOTS] = hat(&s.belief);
        table.confidence(&s.belief) >= dot(cut, &hat)
    };
    let executed: Vec<_> = cell.samples.iter().filter(executes).collect();
    let wrong = executed.iter().filter(|s| !s.right).count();
    [executed.len() as f64 / n, wrong as f64 / n]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibration::{Believed, RISKS};
    use deictic_core::joint::KINDS;
    use deictic_core::joint::belief::Belief;

    #[test]
    fn binomial_sums() {
        assert!((at_most(0, 10, 0.1) - 0.9_f64.powi(10)).abs() < 1e-12);
        assert!((at_most(10, 10, 0.1) - 1.0).abs() < 1e-9);
        assert!((at_most(5, 10, 0.5) - 638.0 / 1024.0).abs() < 1e-9);
    }

    #[test]
    fn a_cut_that_errs_too_often_is_not_passed() {
        let table = Table {
            slope: [[1.0; KNOTS]; KINDS],
            action: [[0.0; KNOTS]; KINDS],
            offset: [[0.0; KNOTS]; KINDS],
            cuts: [[0.0; KNOTS]; RISKS.len()],
        };
        // One in twenty is wrong at a posterior of 0.8, none at 0.99.
        let cell = |n: usize| Cell {
            name: String::new(),
            level: 1,
            free: false,
            samples: (0..n)
                .map(|i| Believed {
                    belief: Belief {
                        posterior: if i % 2 == 0 { 0.8 } else { 0.99 },
                        noise: 1.0,
                        ..Belief::NONE
                    },
                    right: i % 20 != 0,
                    executed: true,
                })
                .collect(),
        };
        let shift = shift(&[cell(10_000)], &table, &table.cuts[0], 0.01).unwrap();
        assert!(shift > (0.8_f64 / 0.2).ln() && shift < 1.5, "{shift}");
        assert_eq!(
            super::shift(&[cell(20)], &table, &table.cuts[0], 0.01),
            None,
            "too few to promise anything"
        );
    }
}
