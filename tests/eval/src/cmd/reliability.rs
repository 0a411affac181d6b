//! `deictic-eval reliability`

use std::collections::BTreeMap;
use std::path::PathBuf;

use deictic_eval::calibration::{calibration_error, reliability};
use deictic_eval::dataset;
use deictic_eval::score::Field;
use deictic_eval::situation::FeatureForm;
use deictic_eval::variant::ProfileName;
use serde::Serialize;

/// Show how far the joint model's confidence means what it says: per set, per noise level and on
/// the mixture of all.
#[derive(clap::Args)]
pub struct Reliability {
    /// Folder with the sets and their vocab.json
    #[arg(long, value_name = "DIR")]
    sets: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// The reliability of some samples.
#[derive(Serialize)]
struct Figures {
    of: String,
    n: usize,
    /// Expected calibration error in percent, over ten bins.
    calibration_error: f64,
    executed: f64,
    wrong_of_all: f64,
    wrong_of_executed: f64,
    /// Per tenth of confidence: samples, mean confidence, share that is right.
    bins: [[f64; 3]; 10],
}

impl Reliability {
    pub fn run(self) -> anyhow::Result<()> {
        let (catalogue, sets) = dataset::read_folder(&self.sets)?;
        let mut pools: BTreeMap<(u8, String), Vec<_>> = BTreeMap::new();
        for set in &sets {
            let field = Field::new(set, &catalogue, ProfileName::Paper, FeatureForm::Sure)?;
            let samples = field.beliefs()?;
            let level = set.name.rsplit('_').next().unwrap_or("").to_owned();
            for key in [(0, set.name.clone()), (1, level), (2, "all".to_owned())] {
                pools
                    .entry(key)
                    .or_default()
                    .extend(samples.iter().copied());
            }
        }
        let mut all = Vec::new();
        for ((_, of), samples) in pools {
            let pairs: Vec<_> = samples
                .iter()
                .map(|s| (f64::from(s.belief.confidence()), s.right))
                .collect();
            let executed = samples.iter().filter(|s| s.executed).count();
            let wrong = samples.iter().filter(|s| s.executed && !s.right).count();
            let share = |k: usize, n: usize| 100.0 * k as f64 / n.max(1) as f64;
            all.push(Figures {
                of,
                n: samples.len(),
                calibration_error: calibration_error(&pairs),
                executed: share(executed, samples.len()),
                wrong_of_all: share(wrong, samples.len()),
                wrong_of_executed: share(wrong, executed),
                bins: reliability(&pairs),
            });
        }
        if self.json {
            return super::print_json(&all);
        }
        println!("samples      calibration error  executed  wrong of all  wrong of executed");
        for f in &all {
            println!(
                "{:<12} {:>17.2} {:>9.1} {:>13.2} {:>18.2}",
                f.of, f.calibration_error, f.executed, f.wrong_of_all, f.wrong_of_executed
            );
        }
        Ok(())
    }
}
