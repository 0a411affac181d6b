//! The cuts of commands that may be asked about: one while more questions are left, one for the last
//! look.
//!
//! A command is executed at the first look that passes its cut, and counts as wrong once, so that the
//! risk is that of all looks together. [`fit`] finds both cuts' shapes on samples with two questions;
//! [`shift`] moves them together by learn-then-test, as [`super::test`] does, over every cell and every
//! number of questions from 1 to 4 at once, on fresh samples.

use deictic_core::clarify::QUESTIONS;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use super::test::at_most;
use super::{KNOTS, RISKS, Table, dot, hat};
use crate::conversation::Look;
use crate::density::six_digits;

/// Both cuts: early, then last.
pub type Cuts = [[f64; KNOTS]; 2];

/// How unlikely it may be that the cuts do not hold what they promise.
const DELTA: f64 = 0.05;

/// The first shift, more cautious than any that is needed ...
const FIRST: f64 = 3.0;
/// ... and by how much each is bolder than the one before, down to minus the first.
const STEP: f64 = 0.02;

/// How much of the tolerated risk the shape may have on the samples it is fitted to.
const PART: f64 = 0.92;

/// What share of each level should be completed; what lacks of it counts fourfold.
const AIM: [f64; 5] = [0.0, 0.99, 0.98, 0.90, 0.77];

/// What it is worth to execute without a question, beside executing at all.
const AT_ONCE: f64 = 0.2;

/// While it can ask, nothing is executed whose chance to be wrong is so many times the tolerated risk, even where the risk of
/// all commands together would bear it.
const BOLD: f64 = 5.0;

/// Questions that the shapes are fitted with.
const USUAL: usize = 2;

/// One look, ready to be cut.
#[derive(Clone, Copy, Debug)]
struct Seen {
    confidence: f64,
    hat: [f64; KNOTS],
    right: bool,
    /// Whether something else than the confidence speaks against it.
    refused: bool,
}

/// Commands of one kind and noise level, each looked at as often as can be.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Its set's name.
    pub name: String,
    level: usize,
    commands: Vec<Vec<Seen>>,
}

impl Cell {
    /// Of all looks at every command, none of which has a cut, with the confidence that a table gives.
    #[must_use]
    pub fn new(name: String, level: usize, commands: &[Vec<Look>], table: &Table) -> Self {
        let seen = |look: &Look| Seen {
            confidence: table.confidence(&look.belief),
            hat: hat(&look.belief),
            right: look.right,
            refused: !look.executes,
        };
        Self {
            name,
            level,
            commands: commands
                .iter()
                .map(|looks| looks.iter().map(seen).collect())
                .collect(),
        }
    }

    /// What cuts make of it with so many questions.
    #[must_use]
    pub fn figures(&self, cuts: &Cuts, questions: usize) -> Figures {
        let [early, last] = cuts;
        let mut figures = Figures::default();
        for looks in &self.commands {
            for (k, look) in looks.iter().take(questions + 1).enumerate() {
                let cut = if k < questions { early } else { last };
                if look.refused || look.confidence < dot(cut, &look.hat) {
                    figures.asked += f64::from(u8::from(k < questions));
                    continue;
                }
                if look.right {
                    figures.completed += 1.0;
                    figures.at_once += f64::from(u8::from(k == 0));
                } else {
                    figures.wrong += 1.0;
                }
                break;
            }
        }
        let per = 1.0 / self.commands.len().max(1) as f64;
        for figure in [
            &mut figures.completed,
            &mut figures.wrong,
            &mut figures.at_once,
            &mut figures.asked,
        ] {
            *figure *= per;
        }
        figures
    }
}

/// Shares of all commands.
#[derive(Clone, Copy, Debug, Default)]
pub struct Figures {
    /// Executed as meant.
    pub completed: f64,
    /// Executed otherwise.
    pub wrong: f64,
    /// Executed as meant without a question.
    pub at_once: f64,
    /// Questions per command.
    pub asked: f64,
}

/// The cuts that complete most while no cell's risk exceeds the target: descent along axes and some
/// fixed random directions, from a few starts. A confidence of 1 less the tolerated risk always
/// suffices here.
#[must_use]
pub fn fit(cells: &[Cell], tolerated: f64) -> Cuts {
    let score = |cuts: &Cuts| {
        let figures: Vec<(usize, Figures)> = cells
            .par_iter()
            .filter(|cell| cell.level > 0)
            .map(|cell| (cell.level, cell.figures(cuts, USUAL)))
            .collect();
        let of_level = figures.len() as f64 / 4.0;
        let (mut completed, mut at_once, mut risk) = ([0.0; 5], 0.0, 0.0_f64);
        for (level, figures) in figures {
            completed[level.min(4)] += figures.completed / of_level;
            at_once += figures.at_once / of_level;
            risk = risk.max(figures.wrong);
        }
        let lacks: f64 = AIM
            .iter()
            .zip(&completed)
            .map(|(aim, c)| (aim - c).max(0.0))
            .sum();
        completed.iter().sum::<f64>() + AT_ONCE * at_once
            - 3.0 * lacks
            - 20.0 * (risk / tolerated - PART).max(0.0)
    };
    let mut rng = ChaCha8Rng::seed_from_u64(0);
    let mut directions: Vec<Cuts> = Vec::new();
    for i in 0..2 * KNOTS {
        for sign in [1.0, -1.0] {
            let mut axis = [[0.0; KNOTS]; 2];
            axis[i / KNOTS][i % KNOTS] = sign;
            directions.push(axis);
        }
    }
    directions.extend((0..32).map(|_| {
        std::array::from_fn(|_| {
            std::array::from_fn(|_| {
                let x: f64 = StandardNormal.sample(&mut rng);
                0.6 * x
            })
        })
    }));
    let logit = |wrong: f64| ((1.0 - wrong) / wrong).ln();
    let enough = logit(tolerated);
    let least = [logit((BOLD * tolerated).min(0.5)), 0.0];
    let starts = [
        [[3.0; KNOTS]; 2],
        [[4.0; KNOTS], [2.0; KNOTS]],
        [[2.0, 3.0, 4.0, 4.0], [1.0, 1.0, 2.0, 2.5]],
    ];
    let mut best = (f64::NEG_INFINITY, starts[0]);
    for start in starts {
        let start = start.map(|cut: [f64; KNOTS]| cut.map(|knot| knot.min(enough)));
        let (mut cuts, mut top, mut step) = (start, score(&start), 1.0);
        while step > 0.02 {
            let mut moved = false;
            for direction in &directions {
                let next: Cuts = std::array::from_fn(|i| {
                    std::array::from_fn(|j| {
                        (cuts[i][j] + step * direction[i][j]).clamp(least[i], enough)
                    })
                });
                let value = score(&next);
                if value > top + 1e-9 {
                    (cuts, top, moved) = (next, value, true);
                }
            }
            if !moved {
                step /= 2.0;
            }
        }
        if top > best.0 {
            best = (top, cuts);
        }
    }
    best.1
}

/// The cuts, shifted as far as passes the test on fresh cells; `None` when not even the most cautious
/// shift does.
#[must_use]
pub fn shift(cells: &[Cell], cuts: &Cuts, tolerated: f64) -> Option<Cuts> {
    let mut passed = None;
    for i in 0..=(2.0 * FIRST / STEP) as u32 {
        let by = FIRST - STEP * f64::from(i);
        let shifted = cuts.map(|cut| cut.map(|knot| knot + by));
        let worst = cells
            .par_iter()
            .map(|cell| {
                let n = cell.commands.len();
                let p = (1..=QUESTIONS).map(|questions| {
                    let wrong = cell.figures(&shifted, questions).wrong * n as f64;
                    at_most(wrong.round() as usize, n, tolerated)
                });
                p.fold(0.0, f64::max)
            })
            .reduce(|| 0.0, f64::max);
        if worst > DELTA {
            break;
        }
        passed = Some(shifted);
    }
    passed
}

/// The core's table: how reliable words are, by options from 2 on, and the cuts per risk.
#[must_use]
pub fn source(reliability: &[[u16; KNOTS]], cuts: &[Cuts; RISKS.len()]) -> String {
    let mut source = format!(
        "//! Made by `deictic-eval calibrate --asking`: do not edit.\n\
         \n\
         use crate::joint::{{LEVELS, Levels}};\n\
         \n\
         /// How probable it is, in thousandths, that a word of 2, 3, ... options is heard right, per noise level.\n\
         #[rustfmt::skip]\n\
         pub const RELIABILITY: [[u16; LEVELS]; {}] = [\n",
        reliability.len()
    );
    for row in reliability {
        source.push_str(&format!("    {row:?},\n"));
    }
    let names = [
        ("EARLY", "while more questions can be asked", 0),
        ("LAST", "when none can be asked any more", 1),
    ];
    source.push_str("];\n");
    for (name, when, at) in names {
        source.push_str(&format!(
            "\n/// The logit of the confidence from which on an intent is executed {when}, for each of\n\
             /// [`crate::joint::calibration::RISKS`].\n\
             #[rustfmt::skip]\n\
             pub const {name}: [Levels; {}] = [\n",
            RISKS.len()
        ));
        for cuts in cuts {
            source.push_str(&format!("    {:?},\n", cuts[at].map(six_digits)));
        }
        source.push_str("];\n");
    }
    source
}
