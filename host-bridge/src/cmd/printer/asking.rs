//! Who listens, and what is said to a question besides its answer.

use deictic_core::large::Decision;
use serde_json::json;

use super::Printer;
use crate::cmd::paint;
use crate::explain;
use crate::vocabulary::Lexicon;

impl Printer {
    /// Which recogniser hears what is spoken.
    pub fn listens(self, recogniser: &str) {
        self.line("hears", recogniser);
        self.object(&json!({ "event": "listens", "recogniser": recogniser }));
    }

    /// What was said instead of an answer to a question, as a command of its own.
    pub fn instead(self, text: &str) {
        self.line(
            "said",
            format!(
                "{text} {}",
                paint::dim("(a new command: the question is dropped)")
            ),
        );
        self.object(
            &json!({ "event": "heard", "said": text, "shown": null, "instead_of_answer": true }),
        );
    }

    /// A question that is put again, as nothing has answered it.
    pub fn asks(self, text: &str) {
        self.line("asks", paint::ask(text));
        self.object(&json!({ "event": "asked-again", "text": text }));
    }
}

/// Why no more is asked.
pub(super) fn gives_up(decision: &Decision, lexicon: &Lexicon) -> String {
    let meant = decision.best.as_ref().map_or_else(
        || "what is meant".to_owned(),
        |best| format!("whether \"{}\" is meant", explain::intent(best, lexicon)),
    );
    format!("it still is not sure enough {meant}, and no more may be asked; please start over")
}
