//! How commands end, and when a session is over.

use deictic_core::decide::Outcome;

use super::Conversation;
use crate::robot::Event;
use crate::session::{Happening, Session};

/// How the last command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The robot has done it.
    Done,
    /// It was not done, or not to its end.
    NotDone,
}

impl Conversation<'_> {
    /// Keeps account of how commands end.
    pub fn hear(&mut self, happening: &Happening) {
        if let Happening::Asked { text, .. } = happening {
            self.asked = Some(text.clone());
        }
        self.last = match happening {
            Happening::Robot(Event::Done(_)) => Ending::Done,
            Happening::Robot(Event::Stopped { .. } | Event::Failed { .. })
            | Happening::Refused { .. }
            | Happening::Distrusted(_)
            | Happening::Overruled
            | Happening::Fault(_)
            | Happening::NoDecision
            | Happening::Hanging(_)
            | Happening::Declined { .. }
            | Happening::Lost(_)
            | Happening::Dropped(_) => Ending::NotDone,
            Happening::Decided { decision, .. }
                if matches!(decision.outcome, Outcome::Repeat | Outcome::GiveUp) =>
            {
                Ending::NotDone
            }
            _ => return,
        };
    }

    /// Ends the session when what is going on is over.
    pub fn quit(&mut self) {
        self.quits = true;
    }

    /// How it ended, if it did; of a session for one command `once` that is over.
    pub fn ending(&self, session: &Session<'_>, once: bool) -> Option<Ending> {
        let idle = session.is_idle() && !session.is_showing() && self.waiting.is_empty();
        let over = self.quits || (once && session.question().is_none());
        let ended = if self.failed {
            Ending::NotDone
        } else {
            self.last
        };
        (idle && over).then_some(ended)
    }

    /// Something went wrong that no command makes good.
    pub fn fail(&mut self) {
        self.failed = true;
    }
}
