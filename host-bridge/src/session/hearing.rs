//! What a session does about what the unit and the robot tell it.

use std::time::Duration;

use deictic_core::decide::Outcome;
use deictic_core::large::{Intent, Sentence};
use deictic_core::protocol::hand::HandFault;
use deictic_core::protocol::message::{Decided, Fault, RobotState};
use deictic_core::time::Micros;

use super::{Doing, Happening, Order, PATIENCE, Session, Source};
use crate::clock;
use crate::deciding::heard;
use crate::explain;
use crate::explain::reasons::Reasons;
use crate::robot::{self, Command, CommandId, Taken, World};
use crate::unit;

impl Session<'_> {
    pub(super) fn hear_unit(&mut self, event: unit::Event) {
        match event {
            unit::Event::Decision { decided, trust } => {
                self.decided(*decided, trust);
                if !self.stopping && self.forbidding == 0 {
                    self.due = None;
                }
            }
            unit::Event::WhyActions(why) => {
                if let Some((reasons, _)) = &mut self.reasons {
                    reasons.add_actions(&why, self.lexicon);
                }
            }
            unit::Event::Why(why) => {
                if let Some((reasons, _)) = &mut self.reasons {
                    reasons.add(&why, self.lexicon);
                }
            }
            unit::Event::WhyWhole(why) => {
                if let Some((reasons, _)) = &mut self.reasons {
                    reasons.add_whole(&why);
                }
            }
            // Asked for after every decision that is explained, so that all reasons are before it.
            unit::Event::Statistics(_) => self.tell_reasons(),
            unit::Event::Fault(fault @ Fault::Hand(HandFault::SensorLost)) => {
                // What was said stays said.
                self.happened.push(Happening::Fault(fault));
            }
            unit::Event::Showing(true) => self.showing = Some(clock::now()),
            unit::Event::Showing(false) => {
                self.showing = None;
                // What waited for the hand is decided now.
                if let Some(due) = &mut self.due {
                    *due = clock::now() + PATIENCE;
                }
            }
            unit::Event::Shown { sentence, answers } => self.shown(*sentence, answers),
            unit::Event::Withheld(withheld) => self.withheld(withheld),
            unit::Event::Hand(_) | unit::Event::HandStatistics(_) | unit::Event::Sample(_) => {}
            unit::Event::Fault(fault) => {
                if self.forbidding == 0 {
                    self.due = None;
                }
                self.happened.push(Happening::Fault(fault));
                self.drop_queue();
            }
            unit::Event::Lost(loss) => {
                self.robot.stop(self.now());
                self.due = None;
                self.stopping = false;
                self.forbidding = 0;
                self.question = None;
                self.showing = None;
                self.reasons = None;
                self.happened.push(Happening::Lost(loss));
                self.drop_queue();
            }
            unit::Event::Back(hello) => {
                self.happened.push(Happening::Back(hello));
                self.forbid_again();
            }
        }
    }

    /// The unit goes by what a hand said, as if it had been told here.
    fn shown(&mut self, sentence: Sentence, answers: Option<u32>) {
        let wait = match answers {
            Some(_) => {
                self.question = None;
                PATIENCE
            }
            None => {
                self.hears(&sentence);
                Duration::from_micros(self.configuration.window.0) + PATIENCE
            }
        };
        let text = explain::sentence(&sentence, self.lexicon);
        self.happened.push(Happening::Shown { text });
        self.spoken.push(sentence);
        self.due = Some(clock::now() + wait);
    }

    fn decided(&mut self, decided: Decided<16>, trust: Result<(), unit::Distrust>) {
        let (number, left) = (decided.number, decided.questions_left);
        let decision = decided.decision;
        let heard = heard(&self.spoken, self.lexicon, &self.configuration.profile);
        if !matches!(decision.outcome, Outcome::Ask(_)) {
            self.spoken.clear();
        }
        self.happened.push(Happening::Decided {
            number,
            scene: decided.scene,
            decision: Box::new(decision.clone()),
            heard: heard.clone(),
        });
        let stops = match &decision.outcome {
            Outcome::Execute(intent) => Some(intent.action) == self.lexicon.vocabulary().stop(),
            _ => false,
        };
        if self.configuration.explain && !stops {
            self.reasons = Some((Reasons::default(), clock::now() + PATIENCE));
            // A unit that cannot be told is lost, which is an event of its own.
            let _ = self.unit.ask_statistics();
        }
        if (self.stopping || self.forbidding > 0) && !stops {
            self.happened.push(Happening::Overruled);
            self.report(number, RobotState::Refused);
            return;
        }
        if stops {
            self.stopping = false;
            // Whatever frames were lost before it: standing still is always safe.
            self.halt();
        } else if let Err(distrust) = trust {
            self.happened.push(Happening::Distrusted(distrust));
            self.drop_queue();
            self.report(number, RobotState::Refused);
            return;
        }
        match decision.outcome {
            Outcome::Execute(intent) => self.execute(number, decided.scene, intent),
            Outcome::Ask(question) => {
                let best = decision.best.as_ref();
                let scene = self.table.scene();
                let text = explain::question(&question, best, heard.as_ref(), scene, self.lexicon);
                self.question = Some((number, question.clone()));
                self.happened.push(Happening::Asked {
                    id: number,
                    left,
                    question,
                    text,
                });
                self.drop_queue();
            }
            Outcome::Repeat | Outcome::GiveUp => self.drop_queue(),
        }
    }

    fn execute(&mut self, decision: u32, scene: u32, intent: Intent) {
        self.hear_robot();
        self.commands = self.commands.saturating_add(1);
        let id = CommandId {
            run: self.run,
            number: self.commands,
        };
        let command = Command { id, intent, scene };
        let world = World {
            table: &self.table,
            lexicon: self.lexicon,
        };
        let now = self.now();
        match self.robot.begin(now, &command, world) {
            Ok(taken) => {
                let intent = command.intent;
                if taken == Taken::Begun {
                    self.happened.push(Happening::Accepted(intent.clone()));
                    self.report(decision, RobotState::Running(0));
                }
                let doing = Doing {
                    id,
                    source: Some(Source { decision, intent }),
                    held: false,
                    relaid: false,
                    percent: 0,
                    heard: clock::now(),
                };
                self.overtaken.extend(self.doing.replace(doing));
            }
            Err(refusal) => {
                let intent = command.intent;
                self.happened.push(Happening::Refused { intent, refusal });
                self.drop_queue();
                if self.doing.is_none() {
                    self.report(decision, RobotState::Refused);
                }
            }
        }
        self.hear_robot();
    }

    pub(super) fn hear_robot(&mut self) {
        let now = self.now();
        for event in self.robot.poll(now) {
            if let Some(doing) = &mut self.doing {
                doing.heard = clock::now();
            }
            match event {
                robot::Event::Accepted(id) => self.accepted(id),
                robot::Event::Refused { id, refusal } => self.refused(id, refusal),
                other => self.moved(now, other),
            }
        }
    }

    fn accepted(&mut self, id: CommandId) {
        let mine = self.doing.as_ref().filter(|d| d.id == id);
        match mine.map(|doing| doing.source.clone()) {
            None => {}
            Some(None) => self.happened.push(Happening::Homing),
            Some(Some(Source { decision, intent })) => {
                self.happened.push(Happening::Accepted(intent));
                self.report(decision, RobotState::Running(0));
            }
        }
    }

    fn refused(&mut self, id: CommandId, refusal: robot::Refusal) {
        let Some(doing) = self.doing.take_if(|d| d.id == id) else {
            return;
        };
        match doing.source {
            None => {
                let order = Order::Home;
                self.happened.push(Happening::Declined { order, refusal });
            }
            Some(Source { decision, intent }) => {
                self.happened.push(Happening::Refused { intent, refusal });
                self.report(decision, RobotState::Refused);
            }
        }
        self.drop_queue();
    }

    fn moved(&mut self, now: Micros, event: robot::Event) {
        self.happened.push(Happening::Robot(event.clone()));
        match event {
            robot::Event::Accepted(_) | robot::Event::Refused { .. } => {}
            robot::Event::Begun { id, .. } => {
                let mine = self.doing.as_ref().filter(|d| d.id == id);
                let decision = mine
                    .and_then(|doing| doing.source.as_ref())
                    .map(|s| s.decision);
                if let Some(decision) = decision {
                    let percent = self.robot.progress(now).map_or(0, |(_, p)| p);
                    self.report(decision, RobotState::Running(percent));
                }
            }
            robot::Event::Held(id) | robot::Event::Resumed(id) => {
                if let Some(doing) = self.doing.as_mut().filter(|d| d.id == id) {
                    doing.held = matches!(event, robot::Event::Held(_));
                }
            }
            robot::Event::Changed { changes, .. } => {
                match self.table.apply(&changes, self.lexicon) {
                    Err(error) => self.happened.push(Happening::BadTable(error)),
                    Ok(()) => {
                        self.happened.push(Happening::Table(self.table.version()));
                        // A unit that is not there gets it when it comes back.
                        let _ = self.unit.set_scene(self.table.scene());
                    }
                }
            }
            robot::Event::Done(id) => self.over(id, RobotState::Done),
            robot::Event::Stopped { id, .. } => self.over(id, RobotState::Stopped),
            robot::Event::Failed { id, .. } => self.over(id, RobotState::Failed),
        }
    }
}
