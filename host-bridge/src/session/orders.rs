//! What a person tells the robot itself, past the unit: to hold, to go on, to go home, and that a fault was seen to.
//! None of it is decided on; a stop is [`Session::stop`].

use std::fmt;

use super::{Doing, Happening, Session};
use crate::clock;
use crate::robot::{CommandId, Refusal, Taken};

/// What a robot can be told directly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Stand still in the middle of the command, ready to go on.
    Hold,
    /// Go on with the command.
    Resume,
    /// Go to the ready posture.
    Home,
    /// What went wrong has been seen to.
    Clear,
}

impl Order {
    /// The order that a text is, word for word: what says more may be a command of the vocabulary.
    #[must_use]
    pub fn of(text: &str) -> Option<Self> {
        let text = text.trim_matches(|c: char| !c.is_alphanumeric());
        Some(match text.to_lowercase().as_str() {
            "hold" | "hold still" | "pause" => Self::Hold,
            "resume" | "go on" | "continue" => Self::Resume,
            "home" | "go home" => Self::Home,
            "clear" | "clear fault" => Self::Clear,
            _ => return None,
        })
    }
}

impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Hold => "hold",
            Self::Resume => "resume",
            Self::Home => "go home",
            Self::Clear => "clear its fault",
        })
    }
}

impl Session<'_> {
    /// Tells the robot directly; what it does follows as happenings.
    ///
    /// # Errors
    /// [`Refusal`]; nothing moves then. What is held goes on only on the table that it was held on. What a robot that stands
    /// was about to be told when it is to hold is not begun at all.
    pub fn order(&mut self, order: Order) -> Result<(), Refusal> {
        let now = self.now();
        match order {
            Order::Hold if !self.is_moving() && self.is_pending() => self.withhold(),
            Order::Hold => self.robot.hold(now)?,
            Order::Resume => {
                if self.doing.as_ref().is_some_and(|doing| doing.relaid) {
                    return Err(Refusal::Relaid);
                }
                self.robot.resume(now)?;
            }
            Order::Clear if self.doing.is_some() => return Err(Refusal::Busy),
            Order::Clear => self.robot.clear_fault(now)?,
            Order::Home => self.go_home()?,
        }
        self.hear_robot();
        Ok(())
    }

    /// Whether something is still to be decided on, or to be said to the unit.
    fn is_pending(&self) -> bool {
        self.due.is_some() || !self.queue.is_empty()
    }

    /// Keeps what is pending from beginning. There is nothing to go on with then.
    fn withhold(&mut self) {
        self.drop_queue();
        // A unit that cannot be told is lost, and decides nothing.
        let _ = self.forbid();
    }

    fn go_home(&mut self) -> Result<(), Refusal> {
        if self.doing.is_some() || self.due.is_some() {
            return Err(Refusal::Busy);
        }
        self.commands = self.commands.saturating_add(1);
        let (run, number) = (self.run, self.commands);
        let id = CommandId { run, number };
        let taken = self.robot.home(self.now(), id)?;
        if taken == Taken::Begun {
            self.happened.push(Happening::Homing);
        }
        self.doing = Some(Doing {
            id,
            source: None,
            held: false,
            relaid: false,
            percent: 0,
            heard: clock::now(),
        });
        Ok(())
    }
}
