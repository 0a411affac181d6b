//! A simulated Panda: it does what a real one would do to the things on the table, motion by motion,
//! in the time a careful arm takes.

mod check;
mod plan;

use std::collections::BTreeMap;
use std::collections::VecDeque;

use deictic_core::time::Micros;

use super::{Command, CommandId, Event, Refusal, Robot, Skill, Taken, World};
use crate::scene::Change;
use plan::{Effect, Place, Step, plan};

/// How far the arm reaches from its base, in metres (Franka Emika Panda, data sheet).
pub const REACH: f32 = 0.855;

/// Where the hand rests in the arm's ready posture, in metres.
const READY: Place = [0.307, 0.0, 0.487];

/// How fast the hand travels, in metres a second: an eighth of what the arm can.
const SPEED: f32 = 0.2;

/// How long a motion takes at least, in seconds: opening or closing the hand.
const SHORTEST: f32 = 0.4;

/// The features that tell what a thing that was put somewhere does to it.
const CARRYING: [&str; 2] = ["full-container", "full-stack"];

/// The command that is being done.
#[derive(Debug)]
struct Running {
    id: CommandId,
    steps: Vec<Step>,
    /// When each step ends.
    ends: Vec<Micros>,
    began: Micros,
    /// The step that is under way.
    at: usize,
}

impl Running {
    /// Where the hand is in the middle of a step that began at `from`.
    fn hand_at(&self, now: Micros, from: Place, step: &Step) -> Place {
        let before = self.at.checked_sub(1).and_then(|i| self.ends.get(i));
        let began = before.copied().unwrap_or(self.began);
        let end = self.ends.get(self.at).copied().unwrap_or(now);
        let whole = end.since(began).0.max(1) as f32;
        let part = (now.since(began).0 as f32 / whole).min(1.0);
        let mut hand = from;
        for (x, to) in hand.iter_mut().zip(step.hand) {
            *x += part * (to - *x);
        }
        hand
    }
}

/// A simulated arm.
#[derive(Debug)]
pub struct Sim {
    haste: f32,
    hand: Place,
    held: Option<String>,
    running: Option<Running>,
    /// The newest command of every run.
    newest: BTreeMap<u32, u32>,
    /// What stands in or on what, as far as this arm put it there, with the feature that tells so.
    resting: BTreeMap<String, (String, &'static str)>,
    /// The places of the features this arm changes, as the vocabulary has them.
    features: BTreeMap<&'static str, usize>,
    happened: VecDeque<Event>,
}

impl Sim {
    /// An arm in its ready posture that moves `haste` times as fast as a careful one; 1 at least
    /// for a person who watches, more for tests.
    #[must_use]
    pub fn new(haste: f32) -> Self {
        Self {
            haste: haste.max(0.01),
            hand: READY,
            held: None,
            running: None,
            newest: BTreeMap::new(),
            resting: BTreeMap::new(),
            features: BTreeMap::new(),
            happened: VecDeque::new(),
        }
    }

    fn duration(&self, from: Place, to: Place) -> Micros {
        let square: f32 = from.iter().zip(to).map(|(a, b)| (a - b) * (a - b)).sum();
        let seconds = (deictic_core::math::sqrt(square) / SPEED).max(SHORTEST) / self.haste;
        Micros((f64::from(seconds) * 1e6) as u64)
    }

    fn begin_step(&mut self) {
        if let Some(running) = &self.running
            && let Some(step) = running.steps.get(running.at)
        {
            self.happened.push_back(Event::Begun {
                id: running.id,
                step: step.name.clone(),
                number: running.at + 1,
                of: running.steps.len(),
            });
        }
    }

    /// Ends the step that is under way and begins the next one.
    fn end_step(&mut self) {
        let Some(running) = &mut self.running else {
            return;
        };
        let id = running.id;
        let step = running.steps.get(running.at).cloned();
        running.at += 1;
        let over = running.at >= running.steps.len();
        if let Some(step) = step {
            self.hand = step.hand;
            let changes = self.changes(step.effect);
            if !changes.is_empty() {
                self.happened.push_back(Event::Changed { id, changes });
            }
        }
        if over {
            self.running = None;
            self.happened.push_back(Event::Done(id));
        } else {
            self.begin_step();
        }
    }

    fn set(&self, thing: &str, feature: &'static str, likelihood: f32) -> Option<Change> {
        Some(Change::Feature {
            thing: thing.to_owned(),
            feature: *self.features.get(feature)?,
            likelihood,
        })
    }

    /// What a motion that has just ended made different.
    fn changes(&mut self, effect: Effect) -> Vec<Change> {
        let mut changes = Vec::new();
        match effect {
            Effect::None => {}
            Effect::Grasp(thing) => {
                if let Some((base, feature)) = self.resting.remove(&thing) {
                    changes.extend(self.set(&base, feature, 0.0));
                }
                self.held = Some(thing);
            }
            Effect::LetGo => changes.extend(self.drop_here()),
            Effect::LeaveIn(base, feature) => {
                changes.extend(self.set(&base, feature, 1.0));
                if let Some(thing) = self.held.clone() {
                    self.resting.insert(thing, (base, feature));
                }
                changes.extend(self.drop_here());
            }
            Effect::Push(thing) => changes.push(Change::Moved {
                thing,
                position: self.hand,
            }),
            Effect::Loosen(thing) => changes.extend(self.set(&thing, "glued", 0.0)),
            Effect::Pour(from, into) => {
                changes.extend(self.set(&from, "full-liquid", 0.0));
                changes.extend(self.set(&into, "full-liquid", 1.0));
            }
        }
        changes.extend(self.held.clone().map(|thing| Change::Moved {
            thing,
            position: self.hand,
        }));
        changes
    }

    fn drop_here(&mut self) -> Option<Change> {
        self.held.take().map(|thing| Change::Moved {
            thing,
            position: self.hand,
        })
    }
}

impl Robot for Sim {
    fn begin(
        &mut self,
        now: Micros,
        command: &Command,
        world: World<'_>,
    ) -> Result<Taken, Refusal> {
        let CommandId { run, number } = command.id;
        if self.newest.get(&run).is_some_and(|n| number <= *n) {
            return Err(Refusal::Repeated);
        }
        let action = command.intent.action;
        let motion = world.lexicon.motion(action).unwrap_or_default();
        let skill =
            Skill::named(motion).ok_or_else(|| Refusal::UnknownMotion(motion.to_owned()))?;
        if skill == Skill::Stop {
            self.newest.insert(run, number);
            self.stop(now);
            self.happened.push_back(Event::Done(command.id));
            return Ok(Taken::Begun);
        }
        if self.running.is_some() {
            return Err(Refusal::Busy);
        }
        let present = world.table.version();
        if command.scene != present {
            return Err(Refusal::StaleScene {
                decided_on: command.scene,
                present,
            });
        }
        let task = check::check(self, skill, &command.intent, world)?;
        for name in CARRYING.into_iter().chain(["glued", "full-liquid"]) {
            if let Some(at) = world.lexicon.feature(name) {
                self.features.insert(name, at);
            }
        }
        let held = self.held.is_some() && task.thing() == self.held.as_deref();
        let steps = plan(&task, self.hand, held);
        let mut hand = self.hand;
        let mut end = now;
        let ends = steps.iter().map(|step| {
            end = end.after(self.duration(hand, step.hand));
            hand = step.hand;
            end
        });
        let ends: Vec<_> = ends.collect();
        self.newest.insert(run, number);
        if steps.is_empty() {
            // The hand holds what it was to pick.
            self.happened.push_back(Event::Done(command.id));
            return Ok(Taken::Begun);
        }
        self.running = Some(Running {
            id: command.id,
            steps,
            ends,
            began: now,
            at: 0,
        });
        self.begin_step();
        Ok(Taken::Begun)
    }

    fn stop(&mut self, now: Micros) {
        let ended = self.poll(now);
        self.happened.extend(ended);
        let Some(running) = self.running.take() else {
            return;
        };
        let Some(step) = running.steps.get(running.at) else {
            return;
        };
        let id = running.id;
        self.hand = running.hand_at(now, self.hand, step);
        if let Some(thing) = self.held.clone() {
            let position = self.hand;
            let changes = vec![Change::Moved { thing, position }];
            self.happened.push_back(Event::Changed { id, changes });
        }
        self.happened.push_back(Event::Stopped {
            id,
            step: step.name.clone(),
        });
    }

    fn poll(&mut self, now: Micros) -> Vec<Event> {
        while let Some(running) = &self.running
            && running.ends.get(running.at).is_none_or(|end| *end <= now)
        {
            self.end_step();
        }
        self.happened.drain(..).collect()
    }

    fn progress(&self, now: Micros) -> Option<(CommandId, u8)> {
        let running = self.running.as_ref()?;
        let all = running.ends.last()?.since(running.began).0.max(1);
        let done = now.since(running.began).0.saturating_mul(100) / all;
        Some((running.id, u8::try_from(done.min(100)).unwrap_or(100)))
    }

    fn holding(&self) -> Option<&str> {
        self.held.as_deref()
    }
}
