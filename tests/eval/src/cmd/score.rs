//! `deictic-eval score`

use std::path::PathBuf;

use deictic_eval::dataset;
use deictic_eval::score::{Field, Score as Result};
use deictic_eval::situation::FeatureForm;
use deictic_eval::variant::{MergeName, ModelName, ProfileName, ThresholdName, Variant};

/// Score a variant of the method on every set in a folder.
///
/// `decided` is executed and right. With the reference's profile the action counts as decided on
/// its own, as in its published accuracies, and a triple when all that its action takes is.
#[derive(clap::Args)]
pub struct Score {
    /// Folder with the sets and their vocab.json
    #[arg(long, value_name = "DIR")]
    sets: PathBuf,
    /// Which penalties apply
    #[arg(long, value_enum, default_value = "m3")]
    model: ModelName,
    /// How modalities are mixed [default: max for the baseline, else add]
    #[arg(long, value_enum)]
    merge: Option<MergeName>,
    /// What makes an option clear [default: none for the baseline, else entropy]
    #[arg(long, value_enum)]
    threshold: Option<ThresholdName>,
    /// Whose habits the core follows
    #[arg(long, value_enum, default_value = "paper")]
    profile: ProfileName,
    /// In which form the core sees features
    #[arg(long, value_enum, default_value = "sure")]
    features: FeatureForm,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Score {
    pub fn run(self) -> anyhow::Result<()> {
        let (catalogue, sets) = dataset::read_folder(&self.sets)?;
        let variant = Variant::new(self.model, self.merge, self.threshold, self.profile);
        let mut scores = Vec::new();
        for set in &sets {
            let field = Field::new(set, &catalogue, self.profile, self.features)?;
            scores.push(Result::new(&set.name, &variant, &field.tally(&variant)?));
        }
        if self.json {
            return super::print_json(&scores);
        }
        println!(
            "set          triple argmax        action  executed right        wrong  undecided"
        );
        for Result {
            file,
            shares: s,
            interval_95: i,
            ..
        } in &scores
        {
            let [low, high] = i.triple_argmax;
            println!(
                "{file:<12} {:>6.1} ({low:>5.1} to {high:>5.1}) {:>6.1} {:>15.1} {:>12.1} {:>10.1}",
                s.triple_argmax,
                s.action_argmax,
                s.triple_decided,
                s.triple_wrong_executed,
                s.undecided
            );
        }
        Ok(())
    }
}
