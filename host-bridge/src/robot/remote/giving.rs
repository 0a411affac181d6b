//! How a command is given: named, said until it is answered, held and stopped.

use std::time::{Duration, Instant};

use deictic_core::command::field::{Id, Number};
use deictic_core::command::message::{ClearFault, Hold, HostBeat, Resume, ToRobot};
use deictic_core::time::Micros;

use super::{AGAIN, Given, Remote};
use crate::robot::{CommandId, Event, Refusal, Robot, Taken};

/// How long [`Robot::begin`] waits for the robot's answer; one that comes later is an event.
const AT_ONCE: Duration = Duration::from_millis(5);

impl Remote {
    /// Numbers a new command.
    pub(super) fn name(&mut self, id: CommandId) -> Result<Id, Refusal> {
        let old = |last: CommandId| last.run == id.run && id.number <= last.number;
        if self.last.is_some_and(old) {
            return Err(Refusal::Repeated);
        }
        self.last = Some(id);
        match Number::new(self.newest.get().saturating_add(1)) {
            Some(number) => self.newest = number,
            None => {
                self.run = self.run.wrapping_add(1);
                self.newest = Number::new(1).unwrap_or_default();
                self.say(&HostBeat { id: self.id() }.into());
            }
        }
        Ok(self.id())
    }

    /// Gives a command, and waits a little for the answer.
    pub(super) fn give(
        &mut self,
        now: Micros,
        id: CommandId,
        message: &ToRobot,
    ) -> Result<Taken, Refusal> {
        let packet = message.packet();
        // A line that delivers in bursts may hold the last beat's successor back behind the command.
        self.say(&HostBeat { id: self.id() }.into());
        self.send(&packet);
        self.given = Some(Given {
            id,
            packet,
            at: now,
            again: now.after(AGAIN),
            accepted: false,
            stopping: false,
            step: String::new(),
            percent: 0,
            groups: 0,
            changes: Vec::new(),
            ended: false,
            held: false,
            wanted: None,
        });
        let before = self.happened.len();
        let until = Instant::now() + AT_ONCE;
        loop {
            let left = until.saturating_duration_since(Instant::now());
            self.listen(now, left);
            let mine = |e: &Event| match e {
                Event::Accepted(of) => *of == id,
                Event::Refused { id: of, .. } => *of == id,
                _ => false,
            };
            let answered = self.happened.iter().skip(before).position(mine);
            match answered.and_then(|at| self.happened.remove(before + at)) {
                Some(Event::Refused { refusal, .. }) => return Err(refusal),
                Some(_) => return Ok(Taken::Begun),
                None if left.is_zero() || self.carrier.is_none() => return Ok(Taken::Sent),
                None => {}
            }
        }
    }

    /// Why a command cannot be given now.
    pub(super) fn ready(&mut self, now: Micros) -> Result<(), Refusal> {
        self.listen(now, Duration::ZERO);
        if self.given.is_some() {
            return Err(Refusal::Busy);
        }
        if !self.is_there(now) {
            return Err(Refusal::Gone);
        }
        Ok(())
    }

    /// Has the robot hold what it is doing, or go on with it; said again until its beats tell that it does.
    pub(super) fn want(&mut self, hold: bool, otherwise: Refusal) -> Result<(), Refusal> {
        let given = self.given.as_mut().filter(|given| !given.stopping);
        let given = given.ok_or(otherwise)?;
        given.wanted = (given.held != hold).then_some(hold);
        self.say_wanted();
        match self.carrier {
            Some(_) => Ok(()),
            None => Err(Refusal::Gone),
        }
    }

    pub(super) fn say_wanted(&mut self) {
        let id = self.id();
        match self.given.as_ref().and_then(|given| given.wanted) {
            Some(true) => self.say(&Hold { id }.into()),
            Some(false) => self.say(&Resume { id }.into()),
            None => {}
        }
    }

    /// A stop that is a command of its own: it is done when what was being done has ended.
    pub(super) fn stand_still(&mut self, now: Micros, id: CommandId) -> Taken {
        if self.given.is_none() {
            // A person who says "stop" to an arm that stands still has seen to it.
            self.say(&ClearFault { id: self.id() }.into());
        }
        self.stop(now);
        self.last = Some(id);
        self.stops = Some(id);
        let until = Instant::now() + AT_ONCE;
        while self.given.is_some() && self.carrier.is_some() && Instant::now() < until {
            self.listen(now, until.saturating_duration_since(Instant::now()));
        }
        Taken::Begun
    }
}
