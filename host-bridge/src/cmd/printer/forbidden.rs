//! What is not done, as the person does not want it, on the terminal or as JSON lines.

use deictic_core::sentence::{GESTURE, LANGUAGE};
use serde_json::json;

use super::Printer;
use crate::cmd::paint;

impl Printer {
    /// The robot is told to stop, as this was said.
    pub fn stopped(self, text: &str) {
        self.line("stopped", paint::ask(format!("the arm, at \"{text}\"")));
        self.object(&json!({ "event": "told-to-stop", "said": text }));
    }

    /// What is to be done now that this corrected it.
    pub fn corrected(self, text: &str, meant: &str) {
        self.line("means", meant);
        self.object(&json!({ "event": "corrected", "said": text, "means": meant }));
    }

    /// What is not taken any more, as it was stopped or forbidden.
    pub fn dropped(self, texts: &[String]) {
        for text in texts {
            self.line(
                "dropped",
                format!("\"{text}\", as it was stopped or forbidden"),
            );
        }
        if !texts.is_empty() {
            self.object(&json!({ "event": "dropped", "count": texts.len(), "said": texts }));
        }
    }

    /// What these modalities told, one bit each, belongs to what was forbidden, asked or not understood.
    pub fn withheld(self, modalities: u8) {
        let names = [(GESTURE, "shown"), (LANGUAGE, "said")];
        let told = names.iter().filter(|(m, _)| modalities & (1 << m) != 0);
        let names: Vec<_> = told.map(|(_, name)| *name).collect();
        let what = match names[..] {
            [name] => format!("what was {name} is not done either"),
            _ => "what was said and shown is not done either".to_owned(),
        };
        self.line("not done", what);
        self.object(&json!({ "event": "withheld", "what": names }));
    }
}
