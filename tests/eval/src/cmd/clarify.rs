//! `deictic-eval clarify`

use std::path::PathBuf;

use deictic_core::profile::Profile;
use deictic_eval::conversation::{Strategy, Talk};
use deictic_eval::dataset;
use deictic_eval::interval::wilson;
use serde::Serialize;

/// How many commands are completed when the joint model may ask: answers are heard through the same
/// noise as the commands.
#[derive(clap::Args)]
pub struct Clarify {
    /// Folder with the sets and their vocab.json
    #[arg(long, value_name = "DIR")]
    sets: PathBuf,
    /// How many questions may be asked about a command
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u8).range(0..=4))]
    questions: u8,
    /// Only this way to ask, beside the core's [default: all]
    #[arg(long, value_enum)]
    strategy: Option<Strategy>,
    /// What the answers' errors start from
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What became of a set's commands, in percent of all.
#[derive(Clone, Debug, Serialize)]
struct Figures {
    set: String,
    strategy: String,
    n: usize,
    /// Executed as meant, after however many questions.
    completed: f64,
    /// Executed otherwise.
    wrong: f64,
    wrong_interval_95: [f64; 2],
    /// Executed as meant without a question.
    at_once: f64,
    wrong_at_once: f64,
    /// Given up.
    given_up: f64,
    /// Questions per command.
    questions: f64,
}

impl Clarify {
    pub fn run(self) -> anyhow::Result<()> {
        let (catalogue, sets) = dataset::read_folder(&self.sets)?;
        let profile = Profile {
            questions: self.questions,
            ..Profile::JOINT
        };
        let mut all = Vec::new();
        for strategy in Strategy::ALL {
            if self.strategy.is_some_and(|only| only != strategy) {
                continue;
            }
            for set in &sets {
                let Some(talk) = Talk::new(set, &catalogue)? else {
                    eprintln!(
                        "{}: not a set whose name says how its answers are made",
                        set.name
                    );
                    continue;
                };
                let looks = talk.all(&profile, strategy, self.seed)?;
                let n = looks.len();
                let count = |is: &dyn Fn(usize, bool, bool) -> bool| {
                    looks
                        .iter()
                        .filter_map(|l| l.last().map(|last| (l.len(), last)))
                        .filter(|(k, last)| is(*k, last.executes, last.right))
                        .count()
                };
                let share = |k: usize| 100.0 * k as f64 / n.max(1) as f64;
                let wrong = count(&|_, executes, right| executes && !right);
                let asked: usize = looks.iter().map(|l| l.len() - 1).sum();
                all.push(Figures {
                    set: set.name.clone(),
                    strategy: clap::ValueEnum::to_possible_value(&strategy)
                        .map_or_else(String::new, |v| v.get_name().to_owned()),
                    n,
                    completed: share(count(&|_, executes, right| executes && right)),
                    wrong: share(wrong),
                    wrong_interval_95: wilson(wrong, n),
                    at_once: share(count(&|k, executes, right| k == 1 && executes && right)),
                    wrong_at_once: share(count(&|k, executes, right| k == 1 && executes && !right)),
                    given_up: share(count(&|_, executes, _| !executes)),
                    questions: asked as f64 / n.max(1) as f64,
                });
            }
        }
        if self.json {
            return super::print_json(&all);
        }
        println!("strategy  set          completed  wrong  (at once)  given up  questions each");
        for f in &all {
            println!(
                "{:<9} {:<12} {:>9.1} {:>6.2} {:>6.1}/{:.2} {:>9.1} {:>15.2}",
                f.strategy,
                f.set,
                f.completed,
                f.wrong,
                f.at_once,
                f.wrong_at_once,
                f.given_up,
                f.questions
            );
        }
        Ok(())
    }
}
