//! The robot's side of the command set: hears a host, has a [`Robot`] do what it says, and tells how
//! it fares. Packets and time in, packets out; `deictic robot-sim` puts links around it.
//!
//! * It does what has one name at most once, and nothing of a number that was passed over or halted.
//! * It moves only while it hears its host: [`HOST_LOST`] after the last beat it stops.
//! * It tells the end of a command, and all that it changed, as often as it is asked.

mod reading;
mod served;
mod taking;
mod telling;

use std::collections::BTreeMap;

use deictic_core::command::code::Outcome;
use deictic_core::command::field::{Id, Number};
use deictic_core::command::message::{FromRobot, ToRobot, Welcome};
use deictic_core::command::{BEAT, HOST_LOST, Packet};
use deictic_core::time::Micros;

use super::Robot;
use crate::scene::{Measures, Tabletop};
use crate::vocabulary::Lexicon;

use reading::Telling;
pub use served::{ListenError, Listener, Served};
use taking::named;

/// How many runs of hosts are remembered; the oldest run's number is forgotten first.
const RUNS: usize = 1024;

/// The command that was taken last, and all that was said of it.
struct Current {
    id: Id,
    outcome: Outcome,
    /// Its acceptance, changes and end, to be said again when asked.
    said: Vec<Packet>,
    groups: u8,
    step: u8,
    steps: u8,
    /// Whether it is being stopped since the host is not heard.
    host_lost: bool,
}

/// The robot's side.
pub struct End {
    robot: Box<dyn Robot + Send>,
    lexicon: Lexicon,
    boot: u16,
    table: Option<Tabletop>,
    measures: BTreeMap<String, Measures>,
    telling: Option<Telling>,
    /// The run that it hears, and when it heard it last.
    host: Option<(u32, Micros)>,
    /// The newest number of every run.
    newest: BTreeMap<u32, Number>,
    current: Option<Current>,
    held: bool,
    faulted: bool,
    beat: Micros,
}

impl End {
    /// A robot that has just started; `boot` tells this start from others.
    #[must_use]
    pub fn new(robot: Box<dyn Robot + Send>, lexicon: Lexicon, boot: u16) -> Self {
        Self {
            robot,
            lexicon,
            boot,
            table: None,
            measures: BTreeMap::new(),
            telling: None,
            host: None,
            newest: BTreeMap::new(),
            current: None,
            held: false,
            faulted: false,
            beat: Micros(0),
        }
    }

    /// What things weigh and hold, by their names; hosts do not tell it.
    #[must_use]
    pub fn with_measures(mut self, measures: BTreeMap<String, Measures>) -> Self {
        self.measures = measures;
        self
    }

    /// Takes a packet from the host; puts into `out` what there is to say.
    pub fn take(&mut self, now: Micros, packet: &Packet, out: &mut Vec<Packet>) {
        // What is no message of ours is as good as lost.
        let Ok(message) = ToRobot::read(packet) else {
            return;
        };
        match message {
            ToRobot::HostBeat(of) => self.heard(now, of.id.run, out),
            // It asks for none; where there is a key, the gate has taken it.
            ToRobot::Prove(_) => {}
            ToRobot::Halt(of) => self.halt(now, of.id, out),
            // Whether the arm does so is told by its beats.
            ToRobot::Hold(of) => {
                if self.is_running(of.id) {
                    let _ = self.robot.hold(now);
                }
            }
            ToRobot::Resume(of) => {
                if self.is_running(of.id) && self.held && !self.is_alone(now) {
                    let _ = self.robot.resume(now);
                }
            }
            ToRobot::ClearFault(_) => self.faulted &= self.robot.clear_fault(now).is_err(),
            ToRobot::Ask(of) => self.ask(of.id, out),
            ToRobot::Home(of) => {
                if self.is_new(of.id, out) {
                    let name = named(of.id);
                    let taken = self
                        .may_begin(now, of.id)
                        .and_then(|()| self.robot.home(now, name));
                    self.begun(of.id, taken, out);
                }
            }
            ToRobot::Execute(of) => {
                if self.is_new(of.id, out) {
                    let taken = self.execute(now, &of);
                    self.begun(of.id, taken, out);
                }
            }
            ToRobot::Scene(of) => self.scene(&of),
            ToRobot::Item(of) => self.item(&of),
        }
        self.hear_robot(now, out);
    }

    /// Does what is due, and tells what has happened.
    pub fn poll(&mut self, now: Micros, out: &mut Vec<Packet>) {
        if self.is_alone(now)
            && let Some(current) = &mut self.current
            && current.outcome == Outcome::Running
            && !current.host_lost
        {
            current.host_lost = true;
            self.robot.stop(now);
        }
        self.hear_robot(now, out);
        if now >= self.beat {
            self.beat = now.after(BEAT);
            self.show(now, out);
        }
    }

    /// The latest moment at which [`End::poll`] is to be called again.
    #[must_use]
    pub fn next_wake(&self, now: Micros) -> Micros {
        let moving = self.is_moving();
        let soon = if moving {
            now.after(Micros::from_millis(5))
        } else {
            Micros::NEVER
        };
        self.beat.min(soon)
    }

    /// Whether a command is being done.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        let current = self.current.as_ref();
        current.is_some_and(|c| c.outcome == Outcome::Running)
    }

    fn is_running(&self, id: Id) -> bool {
        self.is_moving() && self.current.as_ref().is_some_and(|c| c.id == id)
    }

    fn is_alone(&self, now: Micros) -> bool {
        self.host.is_none_or(|(_, at)| now.since(at) >= HOST_LOST)
    }

    /// Hears a run; another one only when the present one is gone and nothing moves.
    fn heard(&mut self, now: Micros, run: u32, out: &mut Vec<Packet>) {
        let present = self.host.map(|(run, _)| run);
        if present == Some(run) {
            self.host = Some((run, now));
        } else if self.is_alone(now) && !self.is_moving() {
            self.host = Some((run, now));
            let boot = self.boot;
            out.push(FromRobot::from(Welcome { run, boot }).packet());
        }
    }

    /// Stands still, and begins nothing of what was given before.
    fn halt(&mut self, now: Micros, id: Id, out: &mut Vec<Packet>) {
        self.held = false;
        self.robot.stop(now);
        self.hear_robot(now, out);
        if id.number > self.newest_of(id.run) {
            self.count(id);
            // It was lost on the way, and will not be done any more.
            let packet = telling::stopped(id, 0, "before it began");
            self.take_up(id, Outcome::Void, packet);
        }
        self.ask(id, out);
    }

    /// Says again all that was said of a command.
    fn ask(&self, id: Id, out: &mut Vec<Packet>) {
        if let Some(current) = self.current.as_ref().filter(|c| c.id == id) {
            out.extend(current.said.iter().cloned());
        }
    }
}
