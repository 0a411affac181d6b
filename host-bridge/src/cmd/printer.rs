//! What happens in a session, on the terminal or as JSON lines.

mod asking;
mod forbidden;
mod happening;
mod robot;

use miette::Diagnostic;
use serde_json::{Value, json};

use super::{json, paint};
use crate::explain::Advice;
use crate::hand::source::SourceError;
use crate::language::Spoken;
use crate::link::Address;
use crate::session::Session;

/// Prints what happens.
#[derive(Clone, Copy, Debug)]
pub struct Printer {
    /// JSON lines instead of text.
    pub json: bool,
    /// All figures behind a decision instead of those that count.
    pub full: bool,
}

impl Printer {
    /// One line: what it is about, and what is to be said of it.
    pub fn line(self, about: &str, text: impl std::fmt::Display) {
        if !self.json {
            anstream::println!("{} {text}", paint::dim(format!("{about:<8}")));
        }
    }

    /// What comes now.
    pub fn title(self, text: &str) {
        if !self.json {
            anstream::println!("\n{}", paint::good(text));
        }
    }

    /// One JSON object.
    pub fn object(self, value: &Value) {
        if self.json {
            json::print(value);
        }
    }

    fn advice(self, about: &str, event: &str, Advice { what, remedy }: &Advice) {
        self.line(about, paint::bad(what));
        self.line("", paint::dim(remedy));
        self.object(&json!({ "event": event, "why": what, "remedy": remedy }));
    }

    /// What was understood of a text to do nothing.
    pub fn nothing(self, why: &str) {
        self.line("nothing", why);
        self.object(&json!({ "event": "nothing", "why": why }));
    }

    /// A text that was not understood.
    pub fn not_understood(self, what: impl std::fmt::Display, remedy: String) {
        let what = what.to_string();
        self.advice("heard", "not-understood", &Advice { what, remedy });
    }

    /// Who takes part.
    pub fn greet(self, address: &Address, session: &Session<'_>) {
        let hello = session.unit().hello();
        let holds = hello.capacities;
        self.line(
            "unit",
            format!(
                "{} at {address}: protocol {}, schema {:#010x}, boot {:#x}, {} options, {} things, {} words",
                paint::good("ready"), hello.version, hello.schema, hello.boot, holds.options,
                holds.entities, holds.words
            ),
        );
        self.object(&json!({
            "event": "ready", "board": address.to_string(), "version": hello.version,
            "schema": hello.schema, "boot": hello.boot, "scene": session.table().version(),
        }));
        self.table(session);
    }

    /// What is on the table.
    pub fn table(self, session: &Session<'_>) {
        let lexicon = session.lexicon();
        for thing in session.table().scene().entities() {
            let name = lexicon.option_name(thing.category, thing.option);
            let features = lexicon.features().iter().zip(&thing.features);
            let features = features.filter(|(_, f)| **f > 0.0).map(|(name, f)| {
                if *f < 1.0 {
                    format!("{name} {f}")
                } else {
                    name.clone()
                }
            });
            let features: Vec<_> = features.collect();
            let [x, y, z] = thing.position;
            self.line(
                "table",
                format!(
                    "{name:<9} {}",
                    paint::dim(format!("({x:.2}, {y:.2}, {z:.2}) {}", features.join(", ")))
                ),
            );
            self.object(&json!({
                "event": "thing", "category": lexicon.category_name(thing.category),
                "name": name, "position": thing.position, "features": features,
            }));
        }
    }

    /// What can be typed.
    pub fn help(self) {
        self.line("help", "pick the can                    say it");
        self.line("", "// pick can                     show it");
        self.line("", "put it there // put-into drawer say and show it");
        self.line("", "stop                            stand still, at once");
        self.line("", "hold, resume                    stand still, and go on");
        self.line(
            "",
            "home, clear                     go home; a fault was seen to",
        );
        self.line(
            "",
            "cancel                          stand still, and forget what was typed and not begun",
        );
        self.line("", "table, help, quit");
    }

    /// What was said and shown.
    pub fn heard(self, said: Option<&str>, shown: Option<&str>) {
        let or_nothing = |text: Option<&str>| text.unwrap_or("-").to_owned();
        self.line("said", or_nothing(said));
        self.line("shown", or_nothing(shown));
        self.object(&json!({ "event": "heard", "said": said, "shown": shown }));
    }

    /// What was heard, the likeliest first.
    pub fn spoken(self, spoken: &Spoken) {
        let share = |(text, share): &(String, f64)| format!("{text} {:.0} %", share * 100.0);
        let near = spoken
            .alternatives
            .iter()
            .filter(|(_, share)| *share >= 0.01);
        let texts: Vec<_> = near.map(share).collect();
        self.line("heard", texts.join(", "));
        let alternatives = spoken
            .alternatives
            .iter()
            .map(|(text, share)| json!([text, share]));
        let alternatives: Vec<_> = alternatives.collect();
        self.object(&json!({
            "event": "heard", "said": spoken.best(), "alternatives": alternatives,
        }));
    }

    /// Something odd about a hand sensor; it goes on.
    pub fn odd(self, error: &SourceError) {
        let what = error.to_string();
        let remedy = error.help().map(|help| help.to_string());
        let remedy = remedy.unwrap_or_default();
        self.advice("sensor", "odd-sensor", &Advice { what, remedy });
    }

    /// What was said could not be listened to.
    pub fn unheard(self, what: impl std::fmt::Display, remedy: String) {
        let what = what.to_string();
        self.advice("speech", "unheard", &Advice { what, remedy });
    }

    /// A scene that is not taken over.
    pub fn no_scene(self, what: impl std::fmt::Display, remedy: String) {
        let what = what.to_string();
        self.advice("scene", "not-understood", &Advice { what, remedy });
    }

    /// What was answered to a question.
    pub fn answered(self, text: &str) {
        self.line("answered", text);
        self.object(&json!({ "event": "answered", "said": text }));
    }
}
