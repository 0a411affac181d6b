//! What a person answers to a question.

use deictic_core::decide::Question;

use super::{AGAIN, Conversation};
use crate::answering::{Reply, reply};
use crate::session::Session;
use crate::understanding::{Bearing, Understood, bearing};

impl Conversation<'_> {
    /// Takes what was said while a question is open: its answer, a command of its own, or nothing that tells more, so
    /// that the question is put again.
    pub(super) fn answer(&mut self, session: &mut Session<'_>, text: &str, question: &Question) {
        let reply = reply(text, question, self.listener, session.lexicon());
        match &reply {
            Ok(Reply::Command(Understood::Commands(_))) => self.printer.instead(text),
            _ => self.printer.answered(text),
        }
        let told = match reply {
            Ok(Reply::Answer(sentence)) => session.answer(*sentence),
            Ok(Reply::YesOrNo(likelihoods)) => session.yes_or_no(likelihoods),
            Ok(Reply::Neither) => {
                self.refuse(session, text);
                self.printer.nothing("the question is withdrawn");
                return;
            }
            Ok(Reply::Command(Understood::Nothing(why))) => {
                self.printer.nothing(&why);
                let utterance = self.listener.understand(text).unwrap_or_default();
                if bearing(text, &utterance, session.lexicon()) == Bearing::Refuses {
                    return self.refuse(session, text);
                }
                return self.ask_again();
            }
            Ok(Reply::Command(Understood::Commands(commands))) => {
                return self.give(session, commands, None);
            }
            Ok(Reply::Unclear) => {
                self.printer
                    .nothing(&format!("\"{text}\" does not say which"));
                return self.ask_again();
            }
            Err(error) => {
                self.printer.not_understood(&error, error.remedy());
                return self.ask_again();
            }
        };
        if let Err(error) = told {
            self.printer.not_understood(&error, AGAIN.into());
        }
    }

    fn ask_again(&self) {
        if let Some(text) = &self.asked {
            self.printer.asks(text);
        }
    }
}
