//! `deictic-eval ablate`

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::ValueEnum;
use deictic_eval::ablation::{Outcome, Part, ablate};
use deictic_eval::calibration::calibration_error;
use deictic_eval::dataset;
use deictic_eval::score::Tally;
use serde::Serialize;

/// Take the joint model's parts away one at a time, and say what each is worth.
///
/// The figures are means over the sets of a noise level; what is executed wrongly also in the worst
/// of them.
#[derive(clap::Args)]
pub struct Ablate {
    /// Folder with the sets and their vocab.json
    #[arg(long, value_name = "DIR")]
    sets: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What a level comes to without a part, in percent of all commands.
#[derive(Clone, Debug, Serialize)]
struct Figures {
    without: Part,
    level: String,
    n: usize,
    /// The likeliest intent is what was meant.
    argmax: f64,
    /// What was executed is.
    executed: f64,
    /// It is not.
    wrong: f64,
    wrong_in_worst_set: f64,
    /// Expected calibration error of all sets together.
    calibration_error: f64,
}

impl Figures {
    fn new(without: Part, level: &str, outcomes: &[Outcome]) -> Self {
        let tallies: Vec<Tally> = outcomes.iter().map(|o| o.tally).collect();
        let confidences: Vec<_> = outcomes
            .iter()
            .flat_map(|o| o.confidences.iter().copied())
            .collect();
        let mean = |count: fn(&Tally) -> usize| {
            let shares = tallies.iter().map(|t| t.percent(count(t)));
            shares.sum::<f64>() / tallies.len().max(1) as f64
        };
        let wrong = tallies.iter().map(|t| t.percent(t.triple_wrong_executed));
        Self {
            without,
            level: level.to_owned(),
            n: tallies.iter().map(|t| t.n).sum(),
            argmax: mean(|t| t.triple_argmax),
            executed: mean(|t| t.triple_decided),
            wrong: mean(|t| t.triple_wrong_executed),
            wrong_in_worst_set: wrong.fold(0.0, f64::max),
            calibration_error: calibration_error(&confidences),
        }
    }
}

impl Ablate {
    pub fn run(self) -> anyhow::Result<()> {
        let (catalogue, sets) = dataset::read_folder(&self.sets)?;
        let mut all = Vec::new();
        for &part in Part::value_variants() {
            let mut levels: BTreeMap<&str, Vec<Outcome>> = BTreeMap::new();
            for set in &sets {
                let level = set.name.rsplit('_').next().unwrap_or_default();
                let outcome = ablate(part, set, &catalogue)?;
                levels.entry(level).or_default().push(outcome);
            }
            let figures = levels.iter().map(|(level, t)| Figures::new(part, level, t));
            all.extend(figures);
        }
        if self.json {
            return super::print_json(&all);
        }
        println!(
            "without     level   argmax  executed right   wrong  wrong in the worst set  calibration error"
        );
        for f in &all {
            let name = f.without.to_possible_value();
            println!(
                "{:<11} {:<5} {:>8.2} {:>15.2} {:>7.2} {:>23.2} {:>18.2}",
                name.as_ref().map_or("", |name| name.get_name()),
                f.level,
                f.argmax,
                f.executed,
                f.wrong,
                f.wrong_in_worst_set,
                f.calibration_error
            );
        }
        Ok(())
    }
}
