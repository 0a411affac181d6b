//! `deictic-eval calibrate`

use std::path::PathBuf;

use anyhow::Context;
use deictic_core::clarify::QUESTIONS;
use deictic_core::profile::{Profile, Threshold};
use deictic_eval::calibration::{Cell, KNOTS, RISKS, Table, asking, fit, reliability, test};
use deictic_eval::catalogue::Catalogue;
use deictic_eval::conversation::{Strategy, Talk};
use deictic_eval::density;
use deictic_eval::free;
use deictic_eval::generate::{Kind, set};
use deictic_eval::noise::Level;
use deictic_eval::recipe::Recipe;
use deictic_eval::score::Field;
use deictic_eval::situation::FeatureForm;
use deictic_eval::variant::ProfileName;

/// Seed of the samples that are fitted to; no set of an experiment has it.
const FIT_SEED: u64 = 0x0f17;
/// Seed of the samples that the cut is tested on.
const TEST_SEED: u64 = 0x7e57;

/// Fit the joint model's confidence and its cut to generated samples, and write the core's table.
///
/// The confidence is scaled on one half of the samples, the cut is tested on the other
/// (learn-then-test): with 95 % probability at most 1 % of the commands are executed wrongly in
/// each of the 15 cells of kind and noise, as long as commands are like the generated ones.
#[derive(clap::Args)]
pub struct Calibrate {
    /// A vocabulary with its recipe of scenes [default: the paper's]
    #[arg(long, value_name = "FILE.toml")]
    vocabulary: Option<PathBuf>,
    /// Where to write the table [default: standard output]
    #[arg(long, value_name = "FILE.rs")]
    out: Option<PathBuf>,
    /// Samples per cell that are fitted to
    #[arg(long, default_value_t = 15_000)]
    fit: usize,
    /// Samples per cell that the cut is tested on
    #[arg(long, default_value_t = 40_000)]
    test: usize,
    /// Write the tables of costs instead
    #[arg(long)]
    tables: bool,
    /// Write the table for commands that may be asked about instead, with the same confidence
    #[arg(long, conflicts_with = "tables")]
    asking: bool,
}

impl Calibrate {
    pub fn run(self) -> anyhow::Result<()> {
        if self.tables {
            return self.write(&density::source());
        }
        let (catalogue, recipe) = match &self.vocabulary {
            None => Catalogue::papers(),
            Some(file) => Catalogue::read_toml(file)?,
        };
        let draw = |n, seed| cells(&catalogue, &recipe, n, seed);
        let samples = draw(self.fit, FIT_SEED)?;
        let mut pool = samples.clone();
        pool.extend(free_cells(&catalogue, &recipe, self.fit, FIT_SEED)?);
        let mut table = fit::scaling(&pool);
        if self.asking {
            return self.asking(&catalogue, &recipe, &table);
        }
        let fresh = draw(self.test, TEST_SEED)?;
        for (i, risk) in RISKS.into_iter().enumerate() {
            let mut cut = fit::shape(&samples, &table, risk);
            let shift = test::shift(&fresh, &table, &cut, risk)
                .context("no cut can be promised: more samples are needed, or better sensors")?;
            cut.iter_mut().for_each(|knot| *knot += shift);
            table.cuts[i] = cut;
            eprintln!(
                "at a risk of {} %: executed, wrong of all, in percent",
                100.0 * risk
            );
            for cell in &fresh {
                let [executed, wrong] = test::shares(cell, &table, &cut);
                let [executed, wrong] = [100.0 * executed, 100.0 * wrong];
                eprintln!("{:<12} {executed:>8.1} {wrong:>8.2}", cell.name);
            }
        }
        self.write(&table.source())
    }

    fn asking(
        &self,
        catalogue: &Catalogue,
        recipe: &Recipe,
        scaling: &Table,
    ) -> anyhow::Result<()> {
        let samples = talks(catalogue, recipe, self.fit, FIT_SEED, scaling)?;
        let fresh = talks(catalogue, recipe, self.test, TEST_SEED, scaling)?;
        let mut table = [[[0.0; KNOTS]; 2]; RISKS.len()];
        for (cuts, risk) in table.iter_mut().zip(RISKS) {
            *cuts = asking::shift(&fresh, &asking::fit(&samples, risk), risk)
                .context("no cut can be promised: more samples are needed, or better sensors")?;
            eprintln!("at a risk of {} %, cuts {cuts:.2?}", 100.0 * risk);
            eprintln!("two questions     completed  wrong  at once  questions each");
            for cell in &fresh {
                let f = cell.figures(cuts, 2);
                let [completed, wrong, at_once] =
                    [f.completed, f.wrong, f.at_once].map(|x| 100.0 * x);
                eprintln!(
                    "{:<16} {completed:>10.1} {wrong:>6.2} {at_once:>8.1} {:>15.2}",
                    cell.name, f.asked
                );
            }
        }
        self.write(&asking::source(&reliability::table(), &table))
    }

    fn write(&self, source: &str) -> anyhow::Result<()> {
        match &self.out {
            None => {
                print!("{source}");
                Ok(())
            }
            Some(file) => std::fs::write(file, source)
                .with_context(|| format!("cannot write {}", file.display())),
        }
    }
}

/// Commands that are looked at to the end of all questions.
fn talks(
    catalogue: &Catalogue,
    recipe: &Recipe,
    n: usize,
    seed: u64,
    scaling: &Table,
) -> anyhow::Result<Vec<asking::Cell>> {
    let profile = Profile {
        threshold: Threshold::None,
        questions: QUESTIONS as u8,
        ..Profile::JOINT
    };
    let mut cells = Vec::new();
    for kind in Kind::ALL {
        for level in Level::ALL {
            let set = set(catalogue, recipe, kind, level, n, seed);
            let Some(talk) = Talk::new(&set, catalogue)? else {
                continue;
            };
            let looks = talk.all(&profile, Strategy::Gain, seed)?;
            let level = level.number();
            cells.push(asking::Cell::new(set.name.clone(), level, &looks, scaling));
        }
    }
    Ok(cells)
}

fn cells(catalogue: &Catalogue, recipe: &Recipe, n: usize, seed: u64) -> anyhow::Result<Vec<Cell>> {
    let mut cells = Vec::new();
    for kind in Kind::ALL {
        for level in Level::ALL {
            let set = set(catalogue, recipe, kind, level, n, seed);
            let field = Field::new(&set, catalogue, ProfileName::Paper, FeatureForm::Sure)?;
            cells.push(Cell {
                name: set.name.clone(),
                level: level.number(),
                free: false,
                samples: field.beliefs()?,
            });
        }
    }
    Ok(cells)
}

fn free_cells(
    catalogue: &Catalogue,
    recipe: &Recipe,
    n: usize,
    seed: u64,
) -> anyhow::Result<Vec<Cell>> {
    let mut cells = Vec::new();
    for level in Level::ALL {
        let set = free::set(catalogue, recipe, level, n, seed);
        let field = Field::new(&set, catalogue, ProfileName::Paper, FeatureForm::Graded)?;
        cells.push(Cell {
            name: set.name.clone(),
            level: level.number(),
            free: true,
            samples: field.beliefs()?,
        });
    }
    Ok(cells)
}
