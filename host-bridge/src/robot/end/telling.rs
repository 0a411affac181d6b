//! What a robot tells its host of itself.

use deictic_core::command::Packet;
use deictic_core::command::code::{Outcome, State};
use deictic_core::command::field::{Angle, Features, Id, Name, Number, Place, Quantity, Text};
use deictic_core::command::message::{
    Became, Changed, Done, Failed, FromRobot, Joint7Gripper, Joints123, Joints456, Moved, Progress,
    RobotBeat, Step, Stopped,
};
use deictic_core::time::Micros;

use super::End;
use crate::robot::remote::thing_named;
use crate::robot::{Event, Fault};
use crate::scene::Change;

/// How long after its last beat a host is still told how the robot is.
const LISTENS: Micros = Micros::from_millis(2_000);

pub(super) fn stopped(id: Id, groups: u8, step: &str) -> Packet {
    let text = Text::new(step);
    FromRobot::from(Stopped { id, groups, text }).packet()
}

fn small(number: usize) -> u8 {
    u8::try_from(number).unwrap_or(u8::MAX)
}

impl End {
    /// Tells what the robot has done since.
    pub(super) fn hear_robot(&mut self, now: Micros, out: &mut Vec<Packet>) {
        for event in self.robot.poll(now) {
            let lexicon = &self.lexicon;
            let Some(current) = &mut self.current else {
                continue;
            };
            let id = current.id;
            let (number, run_low, groups) = (id.number, id.run as u16, current.groups);
            let failed = |fault, text: &str| {
                let text = Text::new(text);
                FromRobot::from(Failed {
                    id,
                    groups,
                    fault,
                    text,
                })
            };
            let last: FromRobot = match event {
                // A robot that answers later has been taken as having begun.
                Event::Accepted(_) => continue,
                Event::Refused { refusal, .. } => {
                    current.outcome = Outcome::Failed;
                    failed(Fault::Other, &refusal.to_string())
                }
                Event::Begun {
                    step, number, of, ..
                } => {
                    (current.step, current.steps) = (small(number), small(of));
                    let (step, steps, text) = (small(number), small(of), Text::new(&step));
                    let said = Step {
                        id,
                        step,
                        steps,
                        text,
                    };
                    out.push(FromRobot::from(said).packet());
                    continue;
                }
                Event::Changed { changes, .. } => {
                    current.groups = groups.saturating_add(1);
                    let told = changes.iter().filter_map(|c| change(c, lexicon));
                    let told: Vec<_> = told.map(|message| message.packet()).collect();
                    let changed = Changed {
                        number,
                        run_low,
                        group: current.groups,
                        changes: small(told.len()),
                    };
                    current.said.extend(told.iter().cloned());
                    out.extend(told);
                    let changed = FromRobot::from(changed).packet();
                    current.said.push(changed.clone());
                    out.push(changed);
                    continue;
                }
                Event::Held(_) | Event::Resumed(_) => {
                    self.held = matches!(event, Event::Held(_));
                    // The next beat tells, and is due at once.
                    self.beat = Micros(0);
                    continue;
                }
                Event::Done(_) => {
                    current.outcome = Outcome::Done;
                    Done {
                        number,
                        run_low,
                        groups,
                    }
                    .into()
                }
                Event::Stopped { step, .. } if current.host_lost => {
                    current.outcome = Outcome::Failed;
                    failed(Fault::HostLost, &format!("no host at: {step}"))
                }
                Event::Stopped { step, .. } => {
                    current.outcome = Outcome::Stopped;
                    let text = Text::new(&step);
                    Stopped { id, groups, text }.into()
                }
                Event::Failed { fault, why, .. } => {
                    current.outcome = Outcome::Failed;
                    self.faulted = true;
                    failed(fault, &why)
                }
            };
            self.held = false;
            let last = last.packet();
            current.said.push(last.clone());
            out.push(last);
        }
    }

    /// Shows that the robot lives, how far it is and how it stands; to a host that was heard of
    /// late, since on a line that nobody reads it would pile up.
    pub(super) fn show(&mut self, now: Micros, out: &mut Vec<Packet>) {
        let Some((run, at)) = self.host else { return };
        if now.since(at) >= LISTENS {
            return;
        }
        let current = self.current.as_ref().filter(|c| c.id.run == run);
        let state = if self.held {
            State::Held
        } else if self.is_moving() {
            State::Moving
        } else if self.faulted {
            State::Faulted
        } else if self.is_alone(now) {
            State::Alone
        } else {
            State::Ready
        };
        let mut say = |message: FromRobot| out.push(message.packet());
        say(FromRobot::RobotBeat(RobotBeat {
            run_low: run as u16,
            number: current.map_or(Number::default(), |c| c.id.number),
            state,
            outcome: current.map_or(Outcome::Nothing, |c| c.outcome),
        }));
        if let Some(current) = current
            && let Some((_, percent)) = self.robot.progress(now)
        {
            say(FromRobot::Progress(Progress {
                number: current.id.number,
                step: current.step,
                steps: current.steps,
                percent,
            }));
        }
        let held = self.robot.holding();
        let held = held.and_then(|thing| thing_named(thing, &self.lexicon));
        let posture = self.robot.posture(now);
        let [a, b, c, d, e, f, g] =
            posture.map_or([Angle(0); 7], |p| p.joints.map(Angle::of_radians));
        if posture.is_some() {
            say(FromRobot::Joints123(Joints123 {
                joint1: a,
                joint2: b,
                joint3: c,
            }));
            say(FromRobot::Joints456(Joints456 {
                joint4: d,
                joint5: e,
                joint6: f,
            }));
        }
        say(FromRobot::Joint7Gripper(Joint7Gripper {
            joint7: g,
            width: posture
                .and_then(|p| Quantity::new(p.width))
                .unwrap_or(Quantity::NONE),
            held: held.unwrap_or(Name::NONE),
        }));
    }
}

fn change(change: &Change, lexicon: &crate::vocabulary::Lexicon) -> Option<FromRobot> {
    Some(match change {
        Change::Moved { thing, position } => FromRobot::Moved(Moved {
            thing: thing_named(thing, lexicon)?,
            place: Place::of_metres(*position)?,
        }),
        Change::Feature {
            thing,
            feature,
            likelihood,
        } => FromRobot::Became(Became {
            thing: thing_named(thing, lexicon)?,
            feature: u8::try_from(*feature).ok()?,
            likelihood: Features::in_255ths(*likelihood),
        }),
    })
}
