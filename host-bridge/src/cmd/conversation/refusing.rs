//! What is not to be done, or not like that: what a person refuses, corrects and forbids, and what was shown with words
//! that nobody understood.

use deictic_core::large::Sentence;
use deictic_core::sentence::GESTURE;

use super::input::Input;
use super::{AGAIN, Conversation, Ending};
use crate::language::speech::SpeechError;
use crate::language::{LanguageError, Utterance};
use crate::session::Session;
use crate::understanding::{self, Understood};

impl Conversation<'_> {
    /// What is being done and what waits is not to be done.
    pub(super) fn refuse(&mut self, session: &mut Session<'_>, text: &str) {
        if session.is_moving() {
            self.printer.stopped(text);
        }
        self.last = Ending::NotDone;
        self.drop_waiting();
        if let Err(error) = session.refuse() {
            self.printer.not_understood(&error, AGAIN.into());
        }
    }

    /// What waits or is being done, as an utterance corrects it; `None` when it does not, or there is nothing of the kind.
    pub(super) fn corrected(
        &self,
        session: &Session<'_>,
        utterance: &Utterance,
    ) -> Option<Sentence> {
        let command = utterance.commands.first().filter(|c| c.corrects)?;
        // What has more words than a sentence is a command of its own.
        session.corrected(command).ok().flatten()
    }

    /// Has what waits or is being done done differently, as soon as the arm stands.
    pub(super) fn correct(&mut self, session: &mut Session<'_>, text: &str, sentence: Sentence) {
        self.refuse(session, text);
        let sentence = Box::new(sentence);
        let text = text.to_owned();
        self.wait(Input::Corrected { text, sentence });
    }

    /// What was shown with what was just said is not to be done.
    pub(super) fn forbid(&mut self, session: &mut Session<'_>) {
        self.last = Ending::NotDone;
        let window = session.window();
        let before = self.waiting.len();
        self.waiting
            .retain(|waiting| !waiting.is_shown_within(window));
        if self.waiting.len() < before {
            self.withheld();
        }
        if let Err(error) = session.forbid() {
            self.printer.not_understood(&error, AGAIN.into());
        }
    }

    /// Something was said that nobody understood. It may have been anything, so what was shown with it is not done.
    pub(super) fn not_understood(&mut self, session: &mut Session<'_>, error: &LanguageError) {
        self.printer.not_understood(error, error.remedy());
        self.forbid(session);
    }

    /// Something was said, and nothing was made of it. When that is not for want of words, what was shown with it is not
    /// done, and the session has not gone well, however it goes on.
    pub fn unheard(&mut self, session: &mut Session<'_>, error: &SpeechError) {
        match error {
            SpeechError::Language(error @ LanguageError::Empty) => {
                self.printer.not_understood(error, error.remedy());
            }
            SpeechError::Language(error) => self.not_understood(session, error),
            failed => {
                self.printer.unheard(failed, failed.remedy());
                self.forbid(session);
                self.failed = true;
            }
        }
    }

    /// Nothing more is heard of who speaks, who could not even say stop: the arm stops, and the session ends.
    pub fn deaf(&mut self, session: &mut Session<'_>) {
        self.failed = true;
        self.drop_waiting();
        // A unit that is not there decides nothing.
        let _ = session.refuse();
        self.quit();
    }

    /// What was shown with words that forbid is not done either.
    pub(super) fn withheld(&mut self) {
        self.last = Ending::NotDone;
        self.printer.withheld(1 << GESTURE);
    }

    /// Tells what was understood to be no command.
    pub(super) fn nothing(&mut self, text: &str, utterance: Utterance) {
        self.last = Ending::NotDone;
        if let Understood::Nothing(why) = understanding::of(text, utterance) {
            self.printer.nothing(&why);
        }
    }

    /// Forgets what waits for its turn.
    pub(super) fn drop_waiting(&mut self) {
        let texts = self.waiting.drain(..);
        let texts: Vec<_> = texts.map(|w| w.input.text().to_owned()).collect();
        self.printer.dropped(&texts);
    }
}
