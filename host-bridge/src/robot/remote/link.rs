//! The link to a robot: what is said and heard over it, what is said again, and when it counts as lost.

use std::io;
use std::time::Duration;

use deictic_core::command::message::{Ask, FromRobot, Halt, HostBeat, ToRobot};
use deictic_core::command::seal::Heard;
use deictic_core::command::{BEAT, Packet};
use deictic_core::time::Micros;

use super::{AGAIN, Remote};
use crate::robot::{Event, Fault};

/// When an unanswered command counts as lost.
const GIVEN_UP: Micros = Micros::from_millis(600);

/// How often a lost link is opened anew.
const REOPEN: Micros = Micros::from_millis(500);

impl Remote {
    /// After opening: whatever an earlier end of this link left behind is not begun any more.
    pub(super) fn greet(&mut self, now: Micros) {
        self.told = None;
        self.heard = None;
        self.beat = now.after(BEAT);
        let id = self.id();
        self.say(&HostBeat { id }.into());
        self.say(&Halt { id }.into());
    }

    pub(super) fn say(&mut self, message: &ToRobot) {
        self.send(&message.packet());
    }

    pub(super) fn send(&mut self, packet: &Packet) {
        for packet in self.gate.say(packet) {
            self.carry(&packet);
        }
    }

    /// Gives a packet to the link as it is.
    fn carry(&mut self, packet: &Packet) {
        if let Some(carrier) = &mut self.carrier
            && let Err(error) = carrier.send(packet)
        {
            self.lose(&error);
        }
    }

    fn lose(&mut self, error: &io::Error) {
        self.carrier = None;
        self.gone = error.to_string();
    }

    /// Takes what has arrived, waiting for the first of it.
    pub(super) fn listen(&mut self, now: Micros, patience: Duration) {
        let mut patience = patience;
        while let Some(carrier) = &mut self.carrier {
            match carrier.receive(patience) {
                Ok(Some(packet)) => match self.gate.hear(packet) {
                    Heard::Message(packet) => {
                        // What is no message of ours is as good as lost.
                        if let Ok(message) = FromRobot::read(&packet) {
                            self.hear(now, &message);
                        }
                    }
                    Heard::Answer(packet) => self.carry(&packet),
                    Heard::Nothing => {}
                },
                Ok(None) => return,
                Err(error) => self.lose(&error),
            }
            patience = Duration::ZERO;
        }
    }

    pub(super) fn fail(&mut self, fault: Fault, why: &str) {
        if let Some(given) = self.given.take() {
            let (id, why) = (given.id, why.to_owned());
            self.happened.push_back(Event::Failed { id, fault, why });
            // Should it still arrive, or be going on unheard, it ends here.
            self.say(&Halt { id: self.id() }.into());
        }
    }

    /// What is due: a link to be opened anew, a command to be given again, a robot that is lost.
    pub(super) fn see_to(&mut self, now: Micros) {
        if self.carrier.is_none() {
            let why = format!("the link to the robot is gone: {}", self.gone);
            self.fail(Fault::RobotLost, &why);
            if now >= self.reopen {
                self.reopen = now.after(REOPEN);
                self.carrier = (self.open)().ok();
                if self.carrier.is_some() {
                    self.greet(now);
                }
            }
            return;
        }
        if now >= self.beat {
            self.beat = now.after(BEAT);
            self.say(&HostBeat { id: self.id() }.into());
        }
        let there = self.is_there(now);
        let Some(given) = &mut self.given else { return };
        if !there {
            self.fail(Fault::RobotLost, "the robot is not heard any more");
        } else if now >= given.again && (!given.accepted || given.stopping) {
            if now.since(given.at) >= GIVEN_UP {
                self.fail(Fault::RobotLost, "the robot does not answer");
                return;
            }
            given.again = now.after(AGAIN);
            let (stopping, packet) = (given.stopping, given.packet.clone());
            if stopping {
                self.say(&Halt { id: self.id() }.into());
            } else {
                self.send(&packet);
            }
        }
    }

    pub(super) fn ask(&mut self) {
        self.say(&Ask { id: self.id() }.into());
    }
}
