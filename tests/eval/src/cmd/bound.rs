//! `deictic-eval bound`

use std::path::PathBuf;

use deictic_eval::bound::{Maker, of};
use deictic_eval::catalogue::Catalogue;
use deictic_eval::dataset::{self, Set};
use deictic_eval::generate::{self, Kind};
use deictic_eval::noise::Level;
use deictic_eval::{free, interval::wilson};
use serde::Serialize;

/// Compute how often the best method can be right that knows how the sets were made.
#[derive(clap::Args)]
pub struct Bound {
    /// Folder with sets of the usual names (D_A_n0 ... D_free_n4) [default: sets made here]
    #[arg(long, value_name = "DIR")]
    sets: Option<PathBuf>,
    /// Samples per set where sets are made
    #[arg(long, default_value_t = 1000, value_parser = super::at_least_one)]
    samples: usize,
    /// Seed of sets made here
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// One set's bound, in percent.
#[derive(Serialize)]
struct Row {
    file: String,
    n: usize,
    triple: f64,
    triple_interval_95: [f64; 2],
    action: f64,
    floor: f64,
}

impl Bound {
    pub fn run(self) -> anyhow::Result<()> {
        let (catalogue, sets) = match &self.sets {
            Some(folder) => dataset::read_folder(folder)?,
            None => self.made(),
        };
        let mut rows = Vec::new();
        for set in &sets {
            let Some(maker) = Maker::of(&set.name) else {
                anyhow::bail!("{}: it is not known how this set was made", set.name);
            };
            let bound = of(&catalogue, set, maker);
            rows.push(Row {
                file: set.name.clone(),
                n: bound.n,
                triple: bound.percent(bound.triple),
                triple_interval_95: wilson(bound.triple as usize, bound.n),
                action: bound.percent(bound.action),
                floor: bound.percent(bound.floor),
            });
        }
        if self.json {
            return super::print_json(&rows);
        }
        println!("set            triple             action   floor");
        for row in rows {
            let [low, high] = row.triple_interval_95;
            println!(
                "{:<12} {:>6.1} ({low:>5.1} to {high:>5.1}) {:>6.1} {:>7.1}",
                row.file, row.triple, row.action, row.floor
            );
        }
        Ok(())
    }

    fn made(&self) -> (Catalogue, Vec<Set>) {
        let (catalogue, recipe) = Catalogue::papers();
        let (n, seed) = (self.samples, self.seed);
        let mut sets = Vec::new();
        for level in Level::ALL {
            for kind in Kind::ALL {
                sets.push(generate::set(&catalogue, &recipe, kind, level, n, seed));
            }
            sets.push(free::set(&catalogue, &recipe, level, n, seed));
        }
        sets.sort_by(|a, b| a.name.cmp(&b.name));
        (catalogue, sets)
    }
}
