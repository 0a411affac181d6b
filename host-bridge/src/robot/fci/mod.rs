//! A Panda or Research 3 over the Franka Control Interface, its own network interface: an intent
//! becomes joint motions within its limits, sent a thousand times a second by a thread of its own.
//!
//! What is different on the table afterwards is what the motions do to it; the hand's place is the
//! measured one. A fault stops the arm where it is, and the command is over.

mod arm;
mod brakes;
mod fault;
mod worker;

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Sender, channel};

use deictic_core::time::Micros;

use super::given::Given;
use super::hold::Hold;
use super::motion::{Kind, Motion, homewards, place, rehearse};
use super::panda::Caps;
use super::plan::plan;
use super::task::Effect;
use super::{Command, CommandId, Event, Posture, Refusal, Robot, Skill, Taken, World, check};
use arm::{Arm, Host};
pub use fault::FciFault;
use worker::{Job, Report, Shared};

/// The command that is being done.
#[derive(Debug)]
struct Running {
    id: CommandId,
    motions: Vec<Motion>,
    /// The motion that is under way.
    at: usize,
}

/// An arm on its own network interface.
#[derive(Debug)]
pub struct Fci {
    shared: Arc<Shared>,
    jobs: Sender<Vec<Job>>,
    hold: Hold,
    /// What things weigh, in kilograms, as far as the table says.
    masses: BTreeMap<String, f32>,
    given: Given,
    running: Option<Running>,
    /// Commands to stop, which are done when the arm stands.
    stops: Vec<CommandId>,
    happened: VecDeque<Event>,
}

impl Fci {
    /// Connects to the arm and its hand, each a name or number, with a port where it is not the usual
    /// one; on a real arm both are the same host. Without `realtime` the machine's scheduling is taken
    /// as it is.
    ///
    /// # Errors
    /// [`FciFault`] with what to do about it.
    pub fn connect(arm: &str, hand: &str, realtime: bool) -> Result<Self, FciFault> {
        let host = Host {
            arm: arm.to_owned(),
            hand: hand.to_owned(),
            realtime,
        };
        let arm = Arm::connect(&host)?;
        let shared = Arc::new(Shared::default());
        shared.met(&arm)?;
        let (jobs, inbox) = channel();
        let theirs = Arc::clone(&shared);
        std::thread::Builder::new()
            .name("fci".into())
            .spawn(move || worker::serve(arm, &host, &inbox, &theirs))
            .map_err(|e| FciFault::Other(e.to_string()))?;
        Ok(Self {
            shared,
            jobs,
            hold: Hold::default(),
            masses: BTreeMap::new(),
            given: Given::default(),
            running: None,
            stops: Vec::new(),
            happened: VecDeque::new(),
        })
    }

    fn start(&mut self, id: CommandId, motions: Vec<Motion>) -> Result<Taken, Refusal> {
        self.given.note(id);
        if motions.is_empty() {
            // The hand holds what it was to pick.
            self.happened.push_back(Event::Done(id));
            return Ok(Taken::Begun);
        }
        self.shared.stop.store(false, Ordering::Relaxed);
        self.shared.hold.store(false, Ordering::Relaxed);
        let gone = || FciFault::Other("the thread that moves the arm is gone".into());
        let jobs = motions.iter().map(|motion| Job {
            motion: motion.clone(),
            load: self.load(&motion.effect),
        });
        let sent = self.jobs.send(jobs.collect());
        sent.map_err(|_| refusal(gone()))?;
        let at = 0;
        self.running = Some(Running { id, motions, at });
        Ok(Taken::Begun)
    }

    /// What the hand carries after this, in kilograms, where that is known.
    fn load(&self, effect: &Effect) -> Option<f32> {
        match effect {
            Effect::Grasp(thing) => self.masses.get(thing).copied(),
            Effect::LetGo | Effect::LeaveIn(..) if !self.masses.is_empty() => Some(0.0),
            _ => None,
        }
    }

    fn take(&mut self, report: Report) {
        let Some(running) = &mut self.running else {
            return;
        };
        let id = running.id;
        let name = |at: usize| running.motions.get(at).map(|m| m.name.clone());
        match report {
            Report::Begun(at) => {
                running.at = at;
                self.happened.push_back(Event::Begun {
                    id,
                    step: name(at).unwrap_or_default(),
                    number: at + 1,
                    of: running.motions.len(),
                });
            }
            Report::Ended(at, joints) => {
                let effect = running.motions.get(at).map(|m| m.effect.clone());
                let changes = effect.map(|effect| self.hold.changes(effect, place(&joints)));
                if let Some(changes) = changes.filter(|changes| !changes.is_empty()) {
                    self.happened.push_back(Event::Changed { id, changes });
                }
            }
            Report::Held => self.happened.push_back(Event::Held(id)),
            Report::Resumed => self.happened.push_back(Event::Resumed(id)),
            Report::Done => {
                self.running = None;
                self.happened.push_back(Event::Done(id));
            }
            Report::Stopped(at, joints) => {
                let step = name(at).unwrap_or_default();
                if let Some(moved) = self.hold.carried(place(&joints)) {
                    let changes = vec![moved];
                    self.happened.push_back(Event::Changed { id, changes });
                }
                self.running = None;
                self.happened.push_back(Event::Stopped { id, step });
            }
            Report::Failed(at, fault) => {
                let step = name(at).unwrap_or_default();
                // Where it was last seen: what it holds has come as far as the hand.
                let seen = self.shared.arm().map(|arm| place(&arm.stance.joints));
                if let Some(moved) = seen.ok().and_then(|hand| self.hold.carried(hand)) {
                    let changes = vec![moved];
                    self.happened.push_back(Event::Changed { id, changes });
                }
                self.running = None;
                let why = format!("{fault} (at: {step}); {}", fault.remedy());
                let fault = fault.code();
                self.happened.push_back(Event::Failed { id, fault, why });
            }
        }
    }
}

fn refusal(fault: FciFault) -> Refusal {
    Refusal::Arm {
        why: fault.to_string(),
        remedy: fault.remedy(),
    }
}

impl Robot for Fci {
    fn begin(
        &mut self,
        now: Micros,
        command: &Command,
        world: World<'_>,
    ) -> Result<Taken, Refusal> {
        self.given.check(command.id)?;
        let skill = Skill::of(&command.intent, world.lexicon)?;
        if skill == Skill::Stop {
            self.given.note(command.id);
            self.stop(now);
            self.stops.push(command.id);
            return Ok(Taken::Begun);
        }
        if self.running.is_some() {
            return Err(Refusal::Busy);
        }
        command.check_scene(world)?;
        let arm = self.shared.arm().map_err(refusal)?;
        self.hold.look(world);
        let measures = world.table.measures().iter();
        let masses = measures.filter_map(|(thing, m)| Some((thing.clone(), m.mass?)));
        self.masses = masses.collect();
        let hand = place(&arm.stance.joints);
        let task = check::check(&self.hold, hand, skill, &command.intent, world)?;
        let held = self.hold.thing().is_some() && task.thing() == self.hold.thing();
        let steps = plan(&task, hand, held);
        let motions = rehearse(&steps, &arm.stance, &arm.limits, &Caps::CAREFUL)?;
        self.start(command.id, motions)
    }

    fn home(&mut self, _now: Micros, id: CommandId) -> Result<Taken, Refusal> {
        self.given.check(id)?;
        if self.running.is_some() {
            return Err(Refusal::Busy);
        }
        let arm = self.shared.arm().map_err(refusal)?;
        let motions = homewards(&arm.stance, &arm.limits, &Caps::CAREFUL)?;
        self.start(id, motions)
    }

    fn hold(&mut self, _now: Micros) -> Result<(), Refusal> {
        self.running.as_ref().ok_or(Refusal::Idle)?;
        self.shared.hold.store(true, Ordering::Relaxed);
        Ok(())
    }

    fn resume(&mut self, _now: Micros) -> Result<(), Refusal> {
        let held = self.shared.hold.swap(false, Ordering::Relaxed);
        let going = self.running.is_some() && held;
        going.then_some(()).ok_or(Refusal::NotHeld)
    }

    fn stop(&mut self, _now: Micros) {
        self.shared.stop.store(true, Ordering::Relaxed);
        let fingers = self.running.as_ref().and_then(|running| {
            let motion = running.motions.get(running.at)?;
            matches!(motion.kind, Kind::Fingers { .. }).then_some(())
        });
        if let (Some(()), Ok(arm)) = (fingers, self.shared.arm()) {
            // It answers when the fingers stand, and the arm's thread reports how that came out.
            std::thread::spawn(move || arm.hand.stop());
        }
    }

    fn poll(&mut self, _now: Micros) -> Vec<Event> {
        for report in self.shared.reports() {
            self.take(report);
        }
        if self.running.is_none() {
            self.happened.extend(self.stops.drain(..).map(Event::Done));
        }
        self.happened.drain(..).collect()
    }

    fn progress(&self, _now: Micros) -> Option<(CommandId, u8)> {
        let running = self.running.as_ref()?;
        let took = |motions: &[Motion]| motions.iter().map(Motion::duration).sum::<f64>();
        let done = took(running.motions.get(..running.at).unwrap_or_default());
        let part = done / took(&running.motions).max(1e-3);
        Some((running.id, (part * 100.0) as u8))
    }

    fn holding(&self) -> Option<&str> {
        self.hold.thing()
    }

    fn posture(&self, _now: Micros) -> Option<Posture> {
        self.shared.arm().ok().map(|arm| arm.stance.into())
    }
}
