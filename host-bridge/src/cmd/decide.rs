//! `deictic decide`: one decision, made here.

use clap::Args;
use deictic_core::decide::Outcome;
use deictic_core::joint::Tables;
use deictic_core::large::{Decision, Intent, Sentence, Trace};
use miette::Result;
use serde::Serialize;

use super::files::Files;
use super::profile::Choice;
use super::{advice, json, paint};
use crate::deciding::{decide, heard};
use crate::explain::reasons::Reasons;
use crate::explain::{self, Advice};
use crate::language::Listener;
use crate::report::{self, DecisionReport};
use crate::scene::Tabletop;
use crate::sensor::{Noise, Sensors};
use crate::sensor_model::SensorModel;
use crate::session::Order;
use crate::showing::showing;
use crate::understanding::{self, Understood, is_stop};
use crate::vocabulary::Lexicon;

/// Decide what a sentence and a gesture mean, without a unit and without a robot.
///
/// ```text
/// $ deictic decide --say "pick the cup" --show "pick cup"
/// execute  pick cup
/// $ deictic decide --say "pick it up" --show "can|cup"
/// ask      Which object for pick: can or cup?
/// ```
///
/// It is the unit's own code that runs, so a unit decides the same, to the bit.
#[derive(Args, Clone, Debug)]
#[command(verbatim_doc_comment)]
pub struct Decide {
    #[command(flatten)]
    files: Files,
    /// What is said, for example "put the can into the drawer"
    #[arg(long, value_name = "TEXT", required_unless_present = "show")]
    say: Option<String>,
    /// What is shown, for example "pick can", "pick|push can" or "pick=0.7|push=0.6 can"
    #[arg(long, value_name = "TEXT")]
    show: Option<String>,
    /// Observe what is said and shown through made-up sensors with this much noise
    #[arg(long, value_enum, value_name = "LEVEL")]
    noise: Option<Noise>,
    /// What the noise starts from; the same seed makes the same noise
    #[arg(long, default_value_t = 1, requires = "noise")]
    seed: u64,
    #[command(flatten)]
    choice: Choice,
    /// Print why: merged words, entropies, penalties, thresholds
    #[arg(long)]
    explain: bool,
    /// Print one JSON object per command, for programs
    #[arg(long)]
    json: bool,
}

/// One line of `--json`.
#[derive(Serialize)]
struct Line {
    #[serde(flatten)]
    decision: DecisionReport,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<Reasons>,
}

impl Decide {
    /// Runs the command.
    ///
    /// # Errors
    /// A report with what was wrong and what to do.
    pub fn run(self) -> Result<()> {
        self.choice.check()?;
        let (lexicon, table) = self.files.read()?;
        let mut listener = Listener::new(&lexicon).map_err(|e| advice(&e, e.remedy()))?;
        listener.uncertainty = self.choice.uncertainty();
        let shown = match &self.show {
            Some(text) => Some(showing(text, &lexicon).map_err(|e| advice(&e, e.remedy()))?),
            None => None,
        };
        if let Some(order) = self.say.as_deref().and_then(Order::of) {
            let why = format!(
                "it tells the robot itself to {order}, and nothing is decided; a session has a robot"
            );
            self.print_nothing(&why);
            return Ok(());
        }
        let said = match &self.say {
            None => vec![None],
            Some(text) => match Self::understand(text, &listener)? {
                Understood::Commands(sentences) => sentences.into_iter().map(Some).collect(),
                Understood::Nothing(why) => {
                    self.print_nothing(&why);
                    return Ok(());
                }
            },
        };
        let model = match self.noise {
            Some(_) => SensorModel::made_up(&lexicon),
            None => SensorModel::calibrated(&lexicon),
        };
        let known = model
            .here()
            .map_err(|e| refused(explain::sensor_error(&e)))?;
        let mut sensors = self.noise.map(|n| Sensors::new(&lexicon, n, self.seed));
        // A gesture belongs to the first command; what is said after it stands alone.
        let mut shown = shown;
        for said in said {
            let sentences = [shown.take(), said].into_iter().flatten();
            self.decide(&lexicon, &table, sentences, sensors.as_mut(), known.view())?;
        }
        Ok(())
    }

    fn understand(text: &str, listener: &Listener<'_>) -> Result<Understood> {
        let utterance = listener.understand(text);
        let utterance = utterance.map_err(|e| advice(&e, e.remedy()))?;
        Ok(understanding::of(text, utterance))
    }

    fn decide(
        &self,
        lexicon: &Lexicon,
        table: &Tabletop,
        sentences: impl Iterator<Item = Sentence>,
        mut sensors: Option<&mut Sensors<'_>>,
        known: Tables<'_>,
    ) -> Result<()> {
        let mut observed = Vec::new();
        for sentence in sentences {
            observed.push(match &mut sensors {
                Some(sensors) => sensors
                    .observe(&sentence)
                    .map_err(|e| refused(explain::sentence_error(&e)))?,
                None => sentence,
            });
        }
        let (scene, profile) = (table.scene(), self.choice.profile());
        let mut trace = Box::new(Trace::new());
        let stop = observed.iter().find(|s| is_stop(s, lexicon, &profile));
        let decision = match stop.and(lexicon.vocabulary().stop()) {
            // As the unit does, whatever else was said or shown.
            Some(action) => stop_now(action),
            None => {
                decide(&observed, scene, lexicon, &profile, known, &mut trace).map_err(refused)?
            }
        };
        let heard = heard(&observed, lexicon, &profile);
        let why = self
            .explain
            .then(|| Reasons::of_trace(&trace, &profile, lexicon));
        if self.json {
            json::print(&Line {
                decision: report::decision(&decision, heard.as_ref(), scene, lexicon),
                why,
            });
        } else {
            anstream::println!("{}", in_words(&decision, heard.as_ref(), table, lexicon));
            if let Some(why) = why {
                anstream::print!("{}", paint::dim(why));
            }
        }
        Ok(())
    }

    fn print_nothing(&self, why: &str) {
        if self.json {
            json::print(&serde_json::json!({ "outcome": "nothing", "because": why }));
        } else {
            anstream::println!("{}  {why}", paint::ask("nothing"));
        }
    }
}

fn refused(Advice { what, remedy }: Advice) -> miette::Report {
    advice(what, remedy)
}

fn stop_now(action: u8) -> Decision {
    let intent = Intent {
        action,
        ..Intent::default()
    };
    Decision {
        outcome: Outcome::Execute(intent.clone()),
        best: Some(intent),
    }
}

fn in_words(
    decision: &Decision,
    heard: Option<&Intent>,
    table: &Tabletop,
    lexicon: &Lexicon,
) -> String {
    match &decision.outcome {
        Outcome::Execute(intent) => {
            let what = explain::intent(intent, lexicon);
            format!("{}  {what}", paint::good("execute"))
        }
        Outcome::Ask(question) => {
            let best = decision.best.as_ref();
            let text = explain::question(question, best, heard, table.scene(), lexicon);
            format!("{}      {text}", paint::ask("ask"))
        }
        Outcome::Repeat => format!(
            "{}   I did not understand. Please say and show it again.",
            paint::bad("repeat")
        ),
        Outcome::GiveUp => format!(
            "{}  I am not sure enough, and may not ask. Please start over.",
            paint::bad("give up")
        ),
    }
}
