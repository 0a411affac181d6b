//! What is done at once about what is typed and spoken, whatever is going on, and what waits for its turn.
//!
//! Standing still harms nobody. So a stop, a hold, a prohibition and a "no" wait for nothing, and neither does leaving;
//! what is being done is stopped before all of it is understood. What was shown with words that forbid, ask or are not
//! understood is no command either.

use deictic_core::sentence::GESTURE;

use super::input::{Input, Waiting, parts};
use super::{Conversation, Ending, likeliest_order};
use crate::halting::{Halting, is_likely_stop};
use crate::language::{Spoken, text_of};
use crate::session::{Order, Session};
use crate::understanding::{Bearing, bearing, mentions_stop};

/// A share of what may have been heard that is enough to stand still.
const MAY_BE_STOP: f64 = 0.2;

impl Conversation<'_> {
    /// Takes a typed line. One that says stop, or that what is going on is not to go on, is carried out at once, others
    /// when what was typed before is over.
    pub fn line(&mut self, session: &mut Session<'_>, line: &[u8]) {
        let text = match text_of(line) {
            Ok(text) => text.trim(),
            Err(error) if self.may_be_aside(session) => {
                return self.not_understood(session, &error);
            }
            Err(error) => {
                self.last = Ending::NotDone;
                return self.printer.not_understood(&error, error.remedy());
            }
        };
        if mentions_stop(text, session.lexicon()) {
            self.drop_waiting();
            session.stop();
            self.typed(session, text);
        } else if let Some(order @ (Order::Hold | Order::Resume | Order::Clear)) = Order::of(text) {
            self.order(session, order);
        } else if text == "cancel" {
            self.printer
                .nothing(&format!("{} typed lines are forgotten", self.waiting.len()));
            self.waiting.clear();
            session.cancel();
            if !session.is_idle() {
                self.refuse(session, text);
            }
        } else if session.is_moving() && matches!(text, "quit" | "exit") {
            self.drop_waiting();
            self.printer.stopped(text);
            session.stop();
            self.quit();
        } else if session.is_moving() && matches!(text, "table" | "help" | "?") {
            self.typed(session, text);
        } else if !text.is_empty() && !self.stands_still(session, text) {
            self.arrived(session, text);
        }
    }

    /// Stands still at once, and drops what waits, when a text says so in any words, well or badly written, while
    /// something is going on.
    fn stands_still(&mut self, session: &mut Session<'_>, text: &str) -> bool {
        let (said, shown) = parts(text);
        if said.is_empty() || !self.is_going_on(session) {
            return false;
        }
        let lexicon = session.lexicon();
        let understood = self.listener.understand(said);
        let halting = Halting::of(self.listener.pack());
        let halts = match &understood {
            Ok(utterance) if is_likely_stop(utterance, lexicon) => {
                self.drop_waiting();
                session.stop();
                self.typed(session, text);
                return true;
            }
            Ok(utterance) => {
                let bearing = bearing(said, utterance, lexicon);
                // What refuses or corrects has the arm stand still as well, and says more than that.
                !matches!(bearing, Bearing::Refuses | Bearing::Corrects) && halting.is_in(said)
            }
            Err(_) => halting.is_in(said) || halting.is_like(said),
        };
        if halts {
            let seen = Some(shown).filter(|shown| !shown.is_empty());
            let commands = understood.is_ok_and(|utterance| !utterance.commands.is_empty());
            self.refuse(session, said);
            match commands {
                true => self.wait(Input::Line(text.to_owned())),
                false => self.printer.heard(Some(said), seen),
            }
        }
        halts
    }

    /// Whether the robot moves, or what was said or shown is still to be decided on.
    fn is_going_on(&self, session: &Session<'_>) -> bool {
        session.question().is_none() && !(session.is_idle() && self.waiting.is_empty())
    }

    fn arrived(&mut self, session: &mut Session<'_>, text: &str) {
        let (said, shown) = parts(text);
        if said.is_empty() {
            let passed_on = session.is_idle() || !self.waiting.is_empty();
            if session.forbids() && !passed_on {
                self.printer.heard(None, Some(shown));
                self.withheld();
                return;
            }
            return self.wait(Input::Line(text.to_owned()));
        }
        if session.is_deciding() {
            return self.hold(Input::Line(text.to_owned()));
        }
        let own = matches!(said, "quit" | "exit" | "help" | "?" | "table");
        if own || Order::of(said).is_some() || session.question().is_some() {
            return self.wait(Input::Line(text.to_owned()));
        }
        let listener = self.listener;
        let seen = Some(shown).filter(|shown| !shown.is_empty());
        let heard = |s: &mut Self| s.printer.heard(Some(said), seen);
        match listener.understand(said) {
            Err(error) if self.may_be_aside(session) => {
                heard(self);
                self.not_understood(session, &error);
            }
            Err(_) => self.wait(Input::Line(text.to_owned())),
            Ok(utterance) => match bearing(said, &utterance, session.lexicon()) {
                Bearing::Refuses if utterance.commands.is_empty() => {
                    heard(self);
                    self.refuse(session, said);
                    self.nothing(said, utterance);
                }
                Bearing::Refuses if !session.is_idle() => {
                    self.refuse(session, said);
                    self.wait(Input::Line(text.to_owned()));
                }
                Bearing::Corrects if seen.is_none() => match self.corrected(session, &utterance) {
                    Some(sentence) => {
                        heard(self);
                        self.correct(session, said, sentence);
                    }
                    None => self.wait(Input::Line(text.to_owned())),
                },
                Bearing::Aside if self.may_be_aside(session) => {
                    heard(self);
                    self.nothing(said, utterance);
                    self.forbid(session);
                }
                _ => self.wait(Input::Line(text.to_owned())),
            },
        }
    }

    /// Takes an utterance that was heard. One that may have been stop or no makes the robot stand still at once.
    pub fn spoken(&mut self, session: &mut Session<'_>, spoken: Spoken) {
        let (lexicon, listener) = (session.lexicon(), self.listener);
        let enough = self.enough(session);
        let going_on = self.is_going_on(session);
        let stops = |text: &str| {
            let likely = || {
                let utterance = listener.understand(text);
                utterance.is_ok_and(|utterance| is_likely_stop(&utterance, lexicon))
            };
            mentions_stop(text, lexicon) || (going_on && likely())
        };
        if share_of(&spoken, stops) > enough {
            self.drop_waiting();
            session.stop();
        }
        let (order, share) = likeliest_order(&spoken);
        // Standing still harms nobody, so what may have been hold is done at once.
        let enough = match order {
            Some(Order::Hold) => enough,
            _ => 1.0 - self.listener.risk,
        };
        match order {
            Some(order @ (Order::Hold | Order::Resume | Order::Clear)) if share >= enough => {
                self.printer.spoken(&spoken);
                self.order(session, order);
            }
            _ if session.is_deciding() => self.hold(Input::Spoken(spoken)),
            _ if session.question().is_none() => {
                let ordered = order.is_some() && share > self.listener.risk;
                self.uttered(session, spoken, ordered);
            }
            _ => self.wait(Input::Spoken(spoken)),
        }
    }

    /// Looks again at what came while a decision was about to be made: it may answer the question that was asked, or speak of
    /// what is being done now.
    pub(super) fn look_again(&mut self, session: &mut Session<'_>) {
        if session.is_deciding() {
            return;
        }
        while let Some(at) = self.waiting.iter().position(|waiting| waiting.held) {
            let mut later = self.waiting.split_off(at);
            match later.pop_front().map(|waiting| waiting.input) {
                Some(Input::Line(text)) => self.arrived(session, &text),
                Some(Input::Spoken(spoken)) => self.spoken(session, spoken),
                Some(input @ Input::Corrected { .. }) => self.wait(input),
                None => {}
            }
            self.waiting.append(&mut later);
        }
    }

    /// Takes an utterance that is no stop, and perhaps an order.
    fn uttered(&mut self, session: &mut Session<'_>, spoken: Spoken, ordered: bool) {
        let (listener, lexicon) = (self.listener, session.lexicon());
        let halting = match self.is_going_on(session) {
            true => Halting::of(self.listener.pack()),
            false => Halting::default(),
        };
        let refuses = |text: &str| {
            let utterance = listener.understand(text).ok();
            let bearing = utterance.map(|utterance| bearing(text, &utterance, lexicon));
            matches!(bearing, Some(Bearing::Refuses | Bearing::Corrects)) || halting.is_in(text)
        };
        let refused = share_of(&spoken, refuses) > self.enough(session);
        if !refused && (ordered || spoken.best().is_empty()) {
            return self.wait(Input::Spoken(spoken));
        }
        // What was heard first may be that somebody talked.
        let mut texts = spoken.alternatives.iter().map(|(text, _)| text.as_str());
        let text = texts.find(|text| !text.is_empty()).unwrap_or("").to_owned();
        let aside = self.may_be_aside(session);
        match listener.hear(&spoken) {
            Ok(utterance) if !utterance.commands.is_empty() => {
                let corrected = self.corrected(session, &utterance);
                if let Some(sentence) = corrected.filter(|_| refused) {
                    self.printer.spoken(&spoken);
                    return self.correct(session, &text, sentence);
                }
                if refused && !session.is_idle() {
                    self.refuse(session, &text);
                }
                self.wait(Input::Spoken(spoken));
            }
            Ok(utterance) if refused => {
                self.printer.spoken(&spoken);
                self.refuse(session, &text);
                self.nothing(&text, utterance);
            }
            Err(error) if refused => {
                self.printer.spoken(&spoken);
                self.refuse(session, &text);
                self.printer.not_understood(&error, error.remedy());
            }
            Err(error) if aside => {
                self.printer.spoken(&spoken);
                self.not_understood(session, &error);
            }
            Ok(utterance) if aside && bearing(&text, &utterance, lexicon) == Bearing::Aside => {
                self.printer.spoken(&spoken);
                self.nothing(&text, utterance);
                self.forbid(session);
            }
            _ => self.wait(Input::Spoken(spoken)),
        }
    }

    /// A share of what may have been heard that is enough to stand still: while the arm moves, whatever is above the risk.
    fn enough(&self, session: &Session<'_>) -> f64 {
        match session.is_moving() {
            true => self.listener.risk.min(MAY_BE_STOP),
            false => MAY_BE_STOP,
        }
    }

    /// Whether a question or the like can concern what is shown: not when a command was said before it that waits for
    /// that, or for its turn.
    fn may_be_aside(&self, session: &Session<'_>) -> bool {
        let shown = |waiting: &Waiting| waiting.input.modality() == Some(GESTURE);
        !session.is_waiting_for(GESTURE) && self.waiting.iter().all(shown)
    }

    pub(super) fn wait(&mut self, input: Input) {
        self.waiting.push_back(Waiting::new(input));
    }

    /// Has something looked at again when the decision is there that is about to be made.
    fn hold(&mut self, input: Input) {
        self.waiting.push_back(Waiting::held(input));
    }
}

/// How likely it is that something was said which is such.
fn share_of(spoken: &Spoken, is_such: impl Fn(&str) -> bool) -> f64 {
    let alternatives = spoken.alternatives.iter();
    let such = alternatives.filter(|(text, _)| !text.is_empty() && is_such(text));
    such.map(|(_, share)| share).sum()
}
