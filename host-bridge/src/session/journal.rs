//! What became of each command: one record for every execution that the unit has decided on, and for every way
//! home, as soon as it is over.

use std::time::Instant;

use deictic_core::decide::Outcome;
use serde::Serialize;

use super::{Happening, Order};
use crate::clock;
use crate::explain;
use crate::report::{self, IntentReport};
use crate::robot::{CommandId, Event};
use crate::vocabulary::Lexicon;

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Became {
    /// The robot has done it.
    Done,
    /// It was stopped on the way.
    Stopped,
    /// It failed on the way.
    Failed,
    /// The robot did not begin it.
    Refused,
    /// The decision could not be trusted, so the robot was not told.
    Distrusted,
    /// A stop was given meanwhile, so the robot was not told.
    Overruled,
}

/// A command that is over.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Record {
    /// When it was decided, in seconds since the session began.
    pub at: f64,
    /// The number of the decision; none of a way home.
    pub decision: Option<u32>,
    /// The version of the scene that it was made on.
    pub scene: Option<u32>,
    /// What was to be done.
    pub intent: IntentReport,
    /// Its name, once the robot has begun it: the run of the bridge, and its number in it.
    pub command: Option<[u32; 2]>,
    /// How many steps the robot has begun.
    pub steps: usize,
    /// How it ended.
    pub became: Became,
    /// Why it was not done.
    pub why: Option<String>,
    /// How long it took from the decision, in seconds.
    pub took: f64,
}

/// Keeps account of a session.
#[derive(Debug)]
pub struct Journal {
    began: Instant,
    /// Decided, and not yet taken or refused by the robot.
    waiting: Option<Record>,
    /// With the robot. A stop is a command of its own beside the one that it stops.
    doing: Vec<Record>,
}

impl Default for Journal {
    fn default() -> Self {
        Self {
            began: clock::now(),
            waiting: None,
            doing: Vec::new(),
        }
    }
}

impl Journal {
    fn now(&self) -> f64 {
        clock::since(self.began).as_secs_f64()
    }

    fn open(&self, decision: Option<u32>, scene: Option<u32>, intent: IntentReport) -> Record {
        Record {
            at: self.now(),
            decision,
            scene,
            intent,
            command: None,
            steps: 0,
            became: Became::Failed,
            why: None,
            took: 0.0,
        }
    }

    fn close(&self, mut record: Record, became: Became, why: Option<String>) -> Record {
        record.took = self.now() - record.at;
        (record.became, record.why) = (became, why);
        record
    }

    /// Takes note of what happened; a command that is over with it.
    pub fn hear(&mut self, happening: &Happening, lexicon: &Lexicon) -> Option<Record> {
        match happening {
            Happening::Decided {
                number,
                scene,
                decision,
                ..
            } => {
                let Outcome::Execute(intent) = &decision.outcome else {
                    return None;
                };
                let intent = report::intent(intent, lexicon);
                self.waiting = Some(self.open(Some(*number), Some(*scene), intent));
                None
            }
            Happening::Accepted(_) => {
                self.doing.extend(self.waiting.take());
                None
            }
            Happening::Homing => {
                let record = self.open(None, None, home());
                self.doing.push(record);
                None
            }
            Happening::Declined {
                order: Order::Home,
                refusal,
            } => {
                let record = self.open(None, None, home());
                Some(self.close(record, Became::Refused, Some(refusal.to_string())))
            }
            Happening::Refused { refusal, .. } => {
                self.untold(Became::Refused, Some(refusal.to_string()))
            }
            Happening::Distrusted(distrust) => {
                self.untold(Became::Distrusted, Some(explain::distrust(distrust).what))
            }
            Happening::Overruled => self.untold(Became::Overruled, None),
            Happening::Robot(event) => self.robot(event),
            Happening::Hanging(id) => {
                let why = Some("the robot hangs".to_owned());
                self.over(*id, Became::Failed, why)
            }
            _ => None,
        }
    }

    /// The command that was decided and did not get to the robot, or not into motion.
    fn untold(&mut self, became: Became, why: Option<String>) -> Option<Record> {
        let record = self.waiting.take()?;
        Some(self.close(record, became, why))
    }

    fn robot(&mut self, event: &Event) -> Option<Record> {
        match event {
            Event::Begun { id, .. } => {
                let at = self.find(*id)?;
                let record = self.doing.get_mut(at)?;
                record.command = Some([id.run, id.number]);
                record.steps += 1;
                None
            }
            Event::Done(id) => self.over(*id, Became::Done, None),
            Event::Stopped { id, step } => self.over(*id, Became::Stopped, Some(step.clone())),
            Event::Failed { id, why, .. } => self.over(*id, Became::Failed, Some(why.clone())),
            _ => None,
        }
    }

    /// The command of this name; else the one that the robot has taken last and not named yet.
    fn find(&self, id: CommandId) -> Option<usize> {
        let name = Some([id.run, id.number]);
        let named = self.doing.iter().position(|r| r.command == name);
        named.or_else(|| self.doing.iter().rposition(|r| r.command.is_none()))
    }

    fn over(&mut self, id: CommandId, became: Became, why: Option<String>) -> Option<Record> {
        let mut record = self.doing.remove(self.find(id)?);
        record.command = Some([id.run, id.number]);
        Some(self.close(record, became, why))
    }
}

/// The way home, as an intent is written.
fn home() -> IntentReport {
    IntentReport {
        action: "home".to_owned(),
        parameters: Vec::new(),
    }
}
