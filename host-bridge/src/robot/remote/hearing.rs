//! What the host makes of what the robot says.

use deictic_core::command::code::{Outcome, State};
use deictic_core::command::field::Id;
use deictic_core::command::message::FromRobot;
use deictic_core::time::Micros;

use super::words::{name_of, refusal_of};
use super::{Given, Remote};
use crate::robot::{Event, Fault, Posture};
use crate::scene::Change;

impl Remote {
    /// The command that a message speaks of, when it is the one that was given last.
    fn mine(&mut self, id: Id) -> Option<&mut Given> {
        let given = self.given.as_mut()?;
        (id == Id {
            run: self.run,
            number: self.newest,
        })
        .then_some(given)
    }

    fn mine_in_brief(&mut self, run_low: u16, number: u32) -> Option<&mut Given> {
        let mine = (self.run as u16, self.newest.get()) == (run_low, number);
        self.given.as_mut().filter(|_| mine)
    }

    pub(super) fn hear(&mut self, now: Micros, message: &FromRobot) {
        match message {
            FromRobot::Welcome(of) if of.run == self.run => {
                self.heard = Some(now);
                self.told = None;
                if self.boot.replace(of.boot).is_some_and(|b| b != of.boot) {
                    self.fail(Fault::Restarted, "the robot has started anew");
                }
            }
            FromRobot::Welcome(_) => {}
            // Where this side has a key, its gate has answered.
            FromRobot::Challenge(_) => self.wants_key = true,
            // It lives, but hears another bridge.
            FromRobot::RobotBeat(beat) if beat.run_low != self.run as u16 => {}
            FromRobot::RobotBeat(beat) => {
                self.heard = Some(now);
                let ended = !matches!(beat.outcome, Outcome::Running | Outcome::Nothing);
                let newest = self.newest;
                self.hear_held(beat.state == State::Held, beat.number == newest && !ended);
                if let Some(given) = self.given.as_mut().filter(|_| beat.number == newest) {
                    // What it said of the end is overdue when a second beat speaks of it.
                    if ended && std::mem::replace(&mut given.ended, true) {
                        self.ask();
                    }
                }
            }
            FromRobot::Accepted(of) => {
                if let Some(given) = self.mine(of.id)
                    && !std::mem::replace(&mut given.accepted, true)
                {
                    let id = given.id;
                    self.happened.push_back(Event::Accepted(id));
                }
            }
            FromRobot::Refused(of) => {
                if self.mine(of.id).is_some_and(|given| !given.accepted)
                    && let Some(given) = self.given.take()
                {
                    let id = given.id;
                    let refusal = refusal_of(of, self.told.unwrap_or(0));
                    if matches!(refusal, crate::robot::Refusal::StaleScene { .. }) {
                        self.told = None;
                    }
                    self.happened.push_back(Event::Refused { id, refusal });
                }
            }
            FromRobot::Step(of) => {
                if let Some(given) = self.mine(of.id) {
                    let id = given.id;
                    let step = of.text.get().to_owned();
                    given.step.clone_from(&step);
                    let (number, of) = (usize::from(of.step), usize::from(of.steps));
                    self.accept();
                    self.happened.push_back(Event::Begun {
                        id,
                        step,
                        number,
                        of,
                    });
                }
            }
            FromRobot::Progress(of) => {
                let newest = self.newest;
                if let Some(given) = self.given.as_mut().filter(|_| of.number == newest) {
                    given.percent = of.percent.min(100);
                }
            }
            FromRobot::Moved(of) => {
                let thing = name_of(of.thing, &self.lexicon);
                if let (Some(given), Some(thing)) = (&mut self.given, thing) {
                    let position = of.place.metres();
                    given.changes.push(Change::Moved { thing, position });
                }
            }
            FromRobot::Became(of) => {
                let thing = name_of(of.thing, &self.lexicon);
                if let (Some(given), Some(thing)) = (&mut self.given, thing) {
                    given.changes.push(Change::Feature {
                        thing,
                        feature: usize::from(of.feature),
                        likelihood: f32::from(of.likelihood) / 255.0,
                    });
                }
            }
            FromRobot::Changed(of) => {
                self.changed(of.run_low, of.number.get(), of.group, of.changes)
            }
            FromRobot::Done(of) => {
                if self.complete(of.run_low, of.number.get(), of.groups)
                    && let Some(given) = self.given.take()
                {
                    self.happened.push_back(Event::Done(given.id));
                }
            }
            FromRobot::Stopped(of) => {
                if self.mine(of.id).is_some()
                    && self.complete(of.id.run as u16, of.id.number.get(), of.groups)
                    && let Some(given) = self.given.take()
                {
                    let step = of.text.get().to_owned();
                    let id = given.id;
                    self.happened.push_back(Event::Stopped { id, step });
                }
            }
            FromRobot::Failed(of) => {
                if self.mine(of.id).is_some()
                    && self.complete(of.id.run as u16, of.id.number.get(), of.groups)
                    && let Some(given) = self.given.take()
                {
                    let (fault, why) = (of.fault, of.text.get().to_owned());
                    let id = given.id;
                    self.happened.push_back(Event::Failed { id, fault, why });
                }
            }
            FromRobot::Joints123(of) => {
                self.joint(0, [of.joint1, of.joint2, of.joint3].map(|a| a.radians()));
            }
            FromRobot::Joints456(of) => {
                self.joint(3, [of.joint4, of.joint5, of.joint6].map(|a| a.radians()));
            }
            FromRobot::Joint7Gripper(of) => {
                self.joint(6, [of.joint7.radians()]);
                let joints = self.joints;
                self.posture = of.width.get().map(|width| Posture { joints, width });
                self.held = name_of(of.held, &self.lexicon);
            }
        }
    }

    /// The robot says whether it is held in the newest command, when it is `doing` that.
    fn hear_held(&mut self, held: bool, doing: bool) {
        let Some(given) = self.given.as_mut().filter(|_| doing) else {
            return;
        };
        if given.wanted == Some(held) {
            given.wanted = None;
        }
        if std::mem::replace(&mut given.held, held) != held {
            let id = given.id;
            let told = if held { Event::Held } else { Event::Resumed };
            self.happened.push_back(told(id));
        }
        self.say_wanted();
    }

    fn joint<const N: usize>(&mut self, first: usize, angles: [f32; N]) {
        for (to, from) in self.joints.iter_mut().skip(first).zip(angles) {
            *to = from;
        }
    }

    /// A robot that is heard doing a command has accepted it, whatever became of its saying so.
    fn accept(&mut self) {
        if let Some(given) = &mut self.given
            && !std::mem::replace(&mut given.accepted, true)
        {
            let id = given.id;
            self.happened.push_back(Event::Accepted(id));
        }
    }

    /// A motion's changes have all been told: they count when none was lost on the way, and only
    /// once.
    fn changed(&mut self, run_low: u16, number: u32, group: u8, changes: u8) {
        let Some(given) = self.mine_in_brief(run_low, number) else {
            return;
        };
        let told = std::mem::take(&mut given.changes);
        if group <= given.groups {
            return;
        }
        if group != given.groups.saturating_add(1) || told.len() != usize::from(changes) {
            self.ask();
            return;
        }
        given.groups = group;
        let id = given.id;
        self.accept();
        let changes = told;
        self.happened.push_back(Event::Changed { id, changes });
    }

    /// Whether all that the ended command changed has been told; asks for it again if not.
    fn complete(&mut self, run_low: u16, number: u32, groups: u8) -> bool {
        let Some(given) = self.mine_in_brief(run_low, number) else {
            return false;
        };
        if given.groups != groups {
            self.ask();
            return false;
        }
        self.accept();
        true
    }
}
