//! One file per subcommand.

mod ablate;
mod align;
mod bound;
mod calibrate;
mod clarify;
mod generate;
mod gestures;
mod made;
mod modalities;
mod paper;
mod parity;
mod reliability;
mod score;
mod sentences;
mod speech;
mod speed;

use clap::Subcommand;

/// What to do.
#[derive(Subcommand)]
pub enum Command {
    Ablate(ablate::Ablate),
    Align(align::Align),
    Bound(bound::Bound),
    Calibrate(calibrate::Calibrate),
    Clarify(clarify::Clarify),
    Generate(generate::Generate),
    Gestures(gestures::Gestures),
    Modalities(modalities::Modalities),
    Paper(paper::Paper),
    Parity(parity::Parity),
    Reliability(reliability::Reliability),
    Score(score::Score),
    Sentences(sentences::Sentences),
    Speech(speech::Speech),
    Speed(speed::Speed),
}

impl Command {
    /// Does it.
    pub fn run(self) -> anyhow::Result<()> {
        match self {
            Self::Ablate(command) => command.run(),
            Self::Align(command) => command.run(),
            Self::Bound(command) => command.run(),
            Self::Calibrate(command) => command.run(),
            Self::Clarify(command) => command.run(),
            Self::Generate(command) => command.run(),
            Self::Gestures(command) => command.run(),
            Self::Modalities(command) => command.run(),
            Self::Paper(command) => command.run(),
            Self::Parity(command) => command.run(),
            Self::Reliability(command) => command.run(),
            Self::Score(command) => command.run(),
            Self::Sentences(command) => command.run(),
            Self::Speech(command) => command.run(),
            Self::Speed(command) => command.run(),
        }
    }
}

/// Prints a value as JSON on standard output.
fn print_json(value: &impl serde::Serialize) -> anyhow::Result<()> {
    println!("{}", serde_json::to_string_pretty(value)?);
    Ok(())
}

/// Reads a number of samples.
fn at_least_one(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(0) => Err("at least 1 sample is needed".to_owned()),
        Ok(n) => Ok(n),
        Err(error) => Err(format!("{error}: a whole number is needed")),
    }
}
