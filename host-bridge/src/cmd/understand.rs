//! `deictic understand`: what a text says, without deciding anything.

use clap::Args;
use deictic_core::large::Word;
use miette::Result;
use serde_json::{Value, json};

use super::files::Files;
use super::{advice, json, paint};
use crate::language::{Command, Listener};
use crate::understanding::{self, Understood};
use crate::vocabulary::Lexicon;

/// Understand a text: its commands, and how likely each word makes each option
///
/// ```text
/// $ deictic understand "put the kup into the drawer"
/// command 1  put the kup into the drawer
///   action   put-into 1.00, stack 0.12
///   object   cup 0.48, cube 0.15
///   storage  drawer 1.00
/// ```
#[derive(Args, Clone, Debug)]
#[command(verbatim_doc_comment)]
pub struct Understand {
    /// What is said
    #[arg(value_name = "TEXT")]
    text: String,
    #[command(flatten)]
    files: Files,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// Options less likely than this are not worth a line.
const LEAST: f32 = 0.1;

impl Understand {
    /// Runs the command.
    ///
    /// # Errors
    /// A report with what was wrong and what to do.
    pub fn run(self) -> Result<()> {
        let (lexicon, _) = self.files.read()?;
        let listener = Listener::new(&lexicon).map_err(|e| advice(&e, e.remedy()))?;
        let utterance = listener.understand(&self.text);
        let utterance = utterance.map_err(|e| advice(&e, e.remedy()))?;
        let commands = utterance.commands.clone();
        let nothing = match understanding::of(&self.text, utterance) {
            Understood::Nothing(why) => Some(why),
            Understood::Commands(_) => None,
        };
        if self.json {
            let commands = commands.iter().map(|c| self.object(c, &lexicon));
            let commands: Vec<_> = commands.collect();
            json::print(&json!({ "commands": commands, "nothing": nothing }));
            return Ok(());
        }
        if let Some(why) = nothing {
            anstream::println!("{}  {why}", paint::ask("nothing"));
        }
        for (number, command) in (1..).zip(&commands) {
            let about = format!("command {number}");
            anstream::println!("{}  {}", paint::good(about), self.part(command));
            for word in command.sentence.words().iter().filter(|w| w.is_present()) {
                let (name, options) = named(word, &lexicon);
                let mut options: Vec<_> = options.into_iter().filter(|o| o.1 >= LEAST).collect();
                options.sort_by(|a, b| b.1.total_cmp(&a.1));
                let options = options.iter().map(|(option, p)| format!("{option} {p:.2}"));
                let mut options: Vec<_> = options.collect();
                options.extend(word.quantity().map(|q| format!("{q}")));
                anstream::println!("  {name:<9} {}", paint::dim(options.join(", ")));
            }
            for category in &command.pointed {
                let name = lexicon.category_name(*category);
                anstream::println!("  {name:<9} {}", paint::dim("left to the hand"));
            }
        }
        Ok(())
    }

    fn part(&self, command: &Command) -> &str {
        self.text
            .get(command.span.clone())
            .unwrap_or(&self.text)
            .trim()
    }

    fn object(&self, command: &Command, lexicon: &Lexicon) -> Value {
        let words = command.sentence.words().iter().filter(|w| w.is_present());
        let words = words.map(|word| {
            let (category, options) = named(word, lexicon);
            let options: serde_json::Map<_, _> = options
                .into_iter()
                .map(|(name, p)| (name, json!(p)))
                .collect();
            json!({ "category": category, "likelihoods": options, "quantity": word.quantity() })
        });
        let pointed = command.pointed.iter().map(|c| lexicon.category_name(*c));
        json!({
            "text": self.part(command), "words": words.collect::<Vec<_>>(),
            "pointed": pointed.collect::<Vec<_>>(), "corrects": command.corrects,
        })
    }
}

/// The likeliest category of a word and its options with their likelihoods.
fn named(word: &Word, lexicon: &Lexicon) -> (String, Vec<(String, f32)>) {
    let Some(category) = word.category() else {
        return (String::new(), Vec::new());
    };
    let options = (0..).zip(word.likelihoods());
    let options = options.filter(|_| !lexicon.is_quantity_only(category));
    let options = options.map(|(option, p)| (lexicon.option_name(category, option), *p));
    (lexicon.category_name(category), options.collect())
}
