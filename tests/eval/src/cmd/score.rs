//! `deictic-eval score`

use std::path::PathBuf;

use deictic_core::profile::{Profile, ProfileError, Threshold};
use deictic_eval::calibration::RISKS;
use deictic_eval::dataset;
use deictic_eval::maker::Maker;
use deictic_eval::score::{Field, Score as Result};
use deictic_eval::situation::FeatureForm;
use deictic_eval::variant::{AlignName, MergeName, ModelName, ProfileName, ThresholdName, Variant};

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
    /// Which words of different modalities speak of the same thing
    #[arg(long, value_enum, default_value = "category")]
    align: AlignName,
    /// The share of all commands that may be executed wrongly; for the risk threshold
    #[arg(long, value_name = "SHARE", default_value_t = 0.01)]
    risk: f32,
    /// In which form the core sees features [default: graded of D_free, else sure]
    #[arg(long, value_enum)]
    features: Option<FeatureForm>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Score {
    pub fn run(self) -> anyhow::Result<()> {
        let (catalogue, sets) = dataset::read_folder(&self.sets)?;
        let variant = Variant::new(self.model, self.merge, self.threshold, self.profile);
        let mut settings = Profile {
            align: self.align.into(),
            ..variant.settings()
        };
        if let Threshold::Risk { rate } = &mut settings.threshold {
            *rate = self.risk;
        }
        if let Err(error) = settings.check() {
            anyhow::bail!("{}", wrong(error));
        }
        let mut scores = Vec::new();
        for set in &sets {
            let usual = Maker::of(&set.name).map_or(FeatureForm::Sure, Maker::form);
            let form = self.features.unwrap_or(usual);
            let field = Field::new(set, &catalogue, self.profile, form)?;
            scores.push(Result::new(&set.name, &variant, &field.decide(&settings)?));
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

/// What is wrong with settings, and what to do.
fn wrong(error: ProfileError) -> String {
    match error {
        ProfileError::Risk => format!(
            "--risk must be below 1 and at least {}, the smallest that there is a cut for",
            RISKS[0]
        ),
        ProfileError::ModelAndThreshold => {
            "--threshold risk is for --model joint, which takes no other but none".to_owned()
        }
        other => format!("these settings cannot be: {other:?}"),
    }
}
