//! Platt's scaling by noise class and kinds of words, and the shape of the cut.

use deictic_core::joint::KINDS;
use deictic_core::joint::belief::{Belief, logit};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use super::{Cell, KNOTS, RISKS, Table, dot, hat};

/// Parameters of the scaling per kinds of words: slope, action's slope and offset.
const WIDTH: usize = 3 * KNOTS;

/// n4 counts more, which evens out that n3 is too shy and n4 too bold.
const WEIGHTS: [f64; 5] = [1.0, 1.0, 1.0, 1.0, 1.4];

/// How strongly slopes are held at 1, per sample: only where a class has hardly any.
const RIDGE: f64 = 1e-5;

/// How much a sample of the freer generator counts: enough that the confidence has seen such scenes, so little that what
/// it says of the others still means what it says.
const FREE: f64 = 0.5;

/// What share of each level should be executed; what lacks of it counts fivefold.
const AIM: [f64; 5] = [0.0, 0.978, 1.0, 0.66, 0.53];
const LACKING: f64 = 5.0;

/// What it is worth to execute more at each level. Of n2 least is lost to the noise and most to caution.
const WORTH: [f64; 5] = [0.0, 0.05, 1.0, 0.05, 0.05];

/// How much of the tolerated risk the shape may have on the samples it is fitted to.
const PART: f64 = 0.92;

/// The scaling's figures of a belief.
fn row(belief: &Belief) -> [f64; WIDTH] {
    let hat = hat(belief);
    let by = [logit(belief.posterior), logit(belief.action), 1.0].map(f64::from);
    std::array::from_fn(|i| hat[i % KNOTS] * by[i / KNOTS])
}

/// A table without cuts: slopes and offsets by weighted logistic regression, for each number of kinds
/// of words on its own.
#[must_use]
pub fn scaling(cells: &[Cell]) -> Table {
    let mut table = Table {
        slope: [[0.0; KNOTS]; KINDS],
        action: [[0.0; KNOTS]; KINDS],
        offset: [[0.0; KNOTS]; KINDS],
        cuts: [[0.0; KNOTS]; RISKS.len()],
    };
    for kind in 0..KINDS {
        let weighed = cells.iter().flat_map(|cell| {
            let weight = WEIGHTS[cell.level.min(4)] * if cell.free { FREE } else { 1.0 };
            cell.samples.iter().map(move |s| (weight, s))
        });
        let rows: Vec<_> = weighed
            .filter(|(_, sample)| sample.belief.kind() == kind)
            .map(|(weight, s)| (weight, row(&s.belief), f64::from(u8::from(s.right))))
            .collect();
        let theta = regression(&rows);
        let part = |from: usize| std::array::from_fn(|i| theta[from * KNOTS + i]);
        table.slope[kind] = part(0);
        table.action[kind] = part(1);
        table.offset[kind] = part(2);
    }
    table
}

/// Weighted logistic regression by Newton's steps.
fn regression(rows: &[(f64, [f64; WIDTH], f64)]) -> [f64; WIDTH] {
    let total: f64 = rows.iter().map(|(w, ..)| w).sum();
    let held: [f64; WIDTH] = std::array::from_fn(|i| if i < KNOTS { 1.0 } else { 0.0 });
    let mut theta = held;
    for _ in 0..30 {
        let mut gradient = [0.0; WIDTH];
        let mut hessian = [[0.0; WIDTH]; WIDTH];
        for (weight, row, right) in rows {
            let p = 1.0 / (1.0 + (-dot(&theta, row)).exp());
            for i in 0..WIDTH {
                gradient[i] += weight * (p - right) * row[i];
                for j in 0..=i {
                    hessian[i][j] += weight * p * (1.0 - p) * row[i] * row[j];
                }
            }
        }
        for i in 0..WIDTH {
            gradient[i] += 2.0 * RIDGE * total * (theta[i] - held[i]);
            hessian[i][i] += 2.0 * RIDGE * total;
        }
        let step = solve(hessian, gradient);
        for (theta, step) in theta.iter_mut().zip(step) {
            *theta -= step;
        }
        if step.iter().all(|s| s.abs() < 1e-9) {
            break;
        }
    }
    theta
}

/// Solves a positive definite system of which the lower half is given (Cholesky).
fn solve(mut a: [[f64; WIDTH]; WIDTH], mut b: [f64; WIDTH]) -> [f64; WIDTH] {
    for i in 0..WIDTH {
        for j in 0..=i {
            let below: f64 = (0..j).map(|k| a[i][k] * a[j][k]).sum();
            let rest = a[i][j] - below;
            a[i][j] = if i == j { rest.sqrt() } else { rest / a[j][j] };
        }
    }
    for i in 0..WIDTH {
        let below: f64 = (0..i).map(|k| a[i][k] * b[k]).sum();
        b[i] = (b[i] - below) / a[i][i];
    }
    for i in (0..WIDTH).rev() {
        let above: f64 = (i + 1..WIDTH).map(|k| a[k][i] * b[k]).sum();
        b[i] = (b[i] - above) / a[i][i];
    }
    b
}

/// The cut by noise class that executes most while no cell's risk exceeds the target: descent along
/// axes and some fixed random directions, from four starts.
#[must_use]
pub fn shape(cells: &[Cell], table: &Table, tolerated: f64) -> [f64; KNOTS] {
    let cells: Vec<(usize, Vec<_>)> = cells
        .iter()
        .filter(|cell| cell.level > 0)
        .map(|cell| {
            let sample =
                |s: &super::Believed| (table.confidence(&s.belief), hat(&s.belief), s.right);
            (cell.level, cell.samples.iter().map(sample).collect())
        })
        .collect();
    let score = |cut: &[f64; KNOTS]| {
        let figures: Vec<(usize, f64, f64)> = cells
            .par_iter()
            .map(|(level, samples)| {
                let executed = samples.iter().filter(|(z, hat, _)| *z >= dot(cut, hat));
                let (all, wrong) = executed.fold((0.0, 0.0), |(all, wrong), (.., right)| {
                    (all + 1.0, wrong + f64::from(u8::from(!right)))
                });
                let n = samples.len().max(1) as f64;
                (*level, all / n, wrong / n)
            })
            .collect();
        let mut executed = [0.0; 5];
        let mut risk: f64 = 0.0;
        let of_level = cells.len() as f64 / 4.0;
        for (level, share, wrong) in figures {
            executed[level.min(4)] += share / of_level;
            risk = risk.max(wrong);
        }
        let lacks: f64 = AIM
            .iter()
            .zip(&executed)
            .map(|(aim, e)| (aim - e).max(0.0))
            .sum();
        dot(&WORTH, &executed) - LACKING * lacks - 20.0 * (risk / tolerated - PART).max(0.0)
    };
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    let mut draw = || -> f64 { StandardNormal.sample(&mut rng) };
    let mut directions: Vec<[f64; KNOTS]> = Vec::new();
    for i in 0..KNOTS {
        for sign in [1.0, -1.0] {
            directions.push(std::array::from_fn(|j| if i == j { sign } else { 0.0 }));
        }
    }
    directions.extend((0..24).map(|_| std::array::from_fn(|_| 0.7 * draw())));
    let starts = [
        [4.0; KNOTS],
        [0.0, 0.0, 3.0, 3.0],
        [0.0, 1.0, 4.0, 3.0],
        [1.0, 2.0, 2.0, 4.0],
    ];
    let mut best = (f64::NEG_INFINITY, starts[0]);
    for start in starts {
        let (mut cut, mut top, mut step) = (start, score(&start), 1.0);
        while step > 0.02 {
            let mut moved = false;
            for direction in &directions {
                let next = std::array::from_fn(|i| (cut[i] + step * direction[i]).max(0.0));
                let value = score(&next);
                if value > top + 1e-9 {
                    (cut, top, moved) = (next, value, true);
                }
            }
            if !moved {
                step /= 2.0;
            }
        }
        if top > best.0 {
            best = (top, cut);
        }
    }
    best.1
}
