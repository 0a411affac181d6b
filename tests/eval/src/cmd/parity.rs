//! `deictic-eval parity`

use std::collections::BTreeMap;
use std::path::PathBuf;

use deictic_eval::{dataset, parity};

/// Compare the core, with the reference's habits, to the reference's recorded answers.
///
/// Exits with failure when less than 99.9 % agree.
#[derive(clap::Args)]
pub struct Parity {
    /// Folder with the sets and their vocab.json
    #[arg(long, value_name = "DIR")]
    sets: PathBuf,
    /// Folder with the recorded answers, one .json.gz per set
    #[arg(long, value_name = "DIR")]
    reference: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Parity {
    pub fn run(self) -> anyhow::Result<()> {
        let (catalogue, sets) = dataset::read_folder(&self.sets)?;
        let parity = parity::compare(&catalogue, &sets, &self.reference)?;
        if self.json {
            super::print_json(&parity)?;
        } else {
            let mut fields: BTreeMap<(&str, &str, bool), usize> = BTreeMap::new();
            for d in &parity.differences {
                *fields.entry((&d.key, &d.field, d.tie)).or_default() += 1;
            }
            for ((key, field, tie), n) in fields {
                let why = if tie { "ties" } else { "not ties" };
                println!("{key:<18} {field:<12} {n:>5} differ, {why}");
            }
            println!(
                "{} answers compared: {:.4} % agree, {:.4} % with ties not excused",
                parity.compared,
                100.0 * parity.agreement,
                100.0 * parity.identical
            );
        }
        anyhow::ensure!(
            parity.agreement >= 0.999,
            "only {:.4} % of the answers agree",
            100.0 * parity.agreement
        );
        Ok(())
    }
}
