//! Whether a command is taken: one that is new, of the host that is heard, on the scene that is known.

use deictic_core::command::Packet;
use deictic_core::command::code::Outcome;
use deictic_core::command::field::{Id, Number};
use deictic_core::command::message::{Accepted, Execute, FromRobot, Refused};
use deictic_core::time::Micros;

use super::reading::intent_of;
use super::{Current, End, RUNS};
use crate::robot::remote::reason_of;
use crate::robot::{Command, CommandId, Refusal, Taken, World};
use crate::scene::Tabletop;

impl End {
    pub(super) fn newest_of(&self, run: u32) -> Number {
        self.newest.get(&run).copied().unwrap_or_default()
    }

    pub(super) fn count(&mut self, id: Id) {
        if self.newest.len() >= RUNS && !self.newest.contains_key(&id.run) {
            self.newest.pop_first();
        }
        self.newest.insert(id.run, id.number);
    }

    /// Whether a command is to be judged; one that was given before is answered as it was.
    pub(super) fn is_new(&mut self, id: Id, out: &mut Vec<Packet>) -> bool {
        if id.number > self.newest_of(id.run) {
            return true;
        }
        match &self.current {
            Some(current) if current.id == id => out.extend(current.said.first().cloned()),
            _ => out.push(refused(id, &Refusal::Repeated)),
        }
        false
    }

    pub(super) fn may_begin(&self, now: Micros, id: Id) -> Result<(), Refusal> {
        if self.host.is_none_or(|(run, _)| run != id.run) || self.is_alone(now) {
            return Err(Refusal::Other("no beat of this host is heard".into()));
        }
        if self.faulted {
            return Err(Refusal::Faulted);
        }
        match (self.held, self.is_moving()) {
            (true, _) => Err(Refusal::Held),
            (_, true) => Err(Refusal::Busy),
            _ => Ok(()),
        }
    }

    pub(super) fn execute(&mut self, now: Micros, of: &Execute) -> Result<Taken, Refusal> {
        self.may_begin(now, of.id)?;
        let present = self.table.as_ref().map_or(0, Tabletop::version);
        let Some(table) = self.table.as_ref().filter(|_| of.scene == present) else {
            return Err(Refusal::StaleScene {
                decided_on: of.scene,
                present,
            });
        };
        let command = Command {
            id: named(of.id),
            intent: intent_of(of, &self.lexicon)?,
            scene: of.scene,
        };
        let lexicon = &self.lexicon;
        self.robot.begin(now, &command, World { table, lexicon })
    }

    pub(super) fn begun(&mut self, id: Id, taken: Result<Taken, Refusal>, out: &mut Vec<Packet>) {
        self.count(id);
        match taken {
            Err(refusal) => {
                let packet = refused(id, &refusal);
                out.push(packet.clone());
                // What is being done goes on, and may still be asked after.
                if !self.is_moving() {
                    self.take_up(id, Outcome::Refused, packet);
                }
            }
            Ok(_) => {
                let packet = FromRobot::from(Accepted { id }).packet();
                out.push(packet.clone());
                self.take_up(id, Outcome::Running, packet);
            }
        }
    }

    pub(super) fn take_up(&mut self, id: Id, outcome: Outcome, first: Packet) {
        self.held = false;
        self.current = Some(Current {
            id,
            outcome,
            said: vec![first],
            groups: 0,
            step: 0,
            steps: 0,
            host_lost: false,
        });
    }
}

pub(super) fn named(id: Id) -> CommandId {
    CommandId {
        run: id.run,
        number: id.number.get(),
    }
}

fn refused(id: Id, refusal: &Refusal) -> Packet {
    let (reason, value, text) = reason_of(refusal);
    let refused = Refused {
        id,
        reason,
        value,
        text,
    };
    FromRobot::from(refused).packet()
}
