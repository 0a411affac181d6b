//! `deictic-eval bound`

use deictic_eval::bound::{Untold, without};
use deictic_eval::interval::wilson;
use serde::Serialize;

use super::made::Made;

/// Compute how often the best method can be right that knows how the sets were made.
#[derive(clap::Args)]
pub struct Bound {
    #[command(flatten)]
    made: Made,
    /// What it is not told of how D_free was made, but takes as the joint model does
    #[arg(long, value_enum, default_value = "nothing")]
    untold: Untold,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// One set's bound, in percent.
#[derive(Serialize)]
struct Row {
    file: String,
    untold: Untold,
    n: usize,
    triple: f64,
    triple_interval_95: [f64; 2],
    action: f64,
    floor: f64,
}

impl Bound {
    pub fn run(self) -> anyhow::Result<()> {
        let (catalogue, sets) = self.made.sets()?;
        let mut rows = Vec::new();
        for (maker, set) in &sets {
            let bound = without(&catalogue, set, *maker, self.untold);
            rows.push(Row {
                file: set.name.clone(),
                untold: self.untold,
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
}
