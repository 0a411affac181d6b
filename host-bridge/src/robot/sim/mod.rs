//! A simulated Panda: it does what a real one would do to the things on the table, motion by motion,
//! with the joints, limits and speeds of a real one.

use std::collections::VecDeque;

use deictic_core::time::Micros;

use super::given::Given;
use super::hold::Hold;
use super::motion::{Motion, Stance, homewards, place, rehearse};
use super::panda::{Caps, PANDA};
use super::plan::plan;
use super::{Command, CommandId, Event, Posture, Refusal, Robot, Skill, Taken, World, check};

/// The command that is being done.
#[derive(Debug)]
struct Running {
    id: CommandId,
    motions: Vec<Motion>,
    /// When each motion ends.
    ends: Vec<Micros>,
    began: Micros,
    /// Since when it is held.
    held: Option<Micros>,
    /// The motion that is under way.
    at: usize,
}

impl Running {
    /// When the motion that is under way began.
    fn since(&self) -> Micros {
        let before = self.at.checked_sub(1).and_then(|i| self.ends.get(i));
        before.copied().unwrap_or(self.began)
    }
}

/// A simulated arm.
#[derive(Debug)]
pub struct Sim {
    haste: f64,
    stance: Stance,
    hold: Hold,
    running: Option<Running>,
    given: Given,
    happened: VecDeque<Event>,
}

impl Sim {
    /// An arm in its ready posture that moves `haste` times as fast as a careful one; 1 at least
    /// for a person who watches, more for tests.
    #[must_use]
    pub fn new(haste: f32) -> Self {
        Self {
            haste: f64::from(haste.max(0.01)),
            stance: Stance::READY,
            hold: Hold::default(),
            running: None,
            given: Given::default(),
            happened: VecDeque::new(),
        }
    }

    fn begin_motion(&mut self) {
        if let Some(running) = &self.running
            && let Some(motion) = running.motions.get(running.at)
        {
            self.happened.push_back(Event::Begun {
                id: running.id,
                step: motion.name.clone(),
                number: running.at + 1,
                of: running.motions.len(),
            });
        }
    }

    /// Ends the motion that is under way and begins the next one.
    fn end_motion(&mut self) {
        let Some(running) = &mut self.running else {
            return;
        };
        let id = running.id;
        let motion = running.motions.get(running.at).cloned();
        running.at += 1;
        let over = running.at >= running.motions.len();
        if let Some(motion) = motion {
            let end = motion.duration();
            self.stance.joints = motion.joints(end);
            self.stance.opening = motion.opening(end).unwrap_or(self.stance.opening);
            let changes = self.hold.changes(motion.effect, place(&self.stance.joints));
            if !changes.is_empty() {
                self.happened.push_back(Event::Changed { id, changes });
            }
        }
        if over {
            self.running = None;
            self.happened.push_back(Event::Done(id));
        } else {
            self.begin_motion();
        }
    }

    /// How the arm stands in the middle of a motion.
    fn stands(&self, now: Micros) -> Stance {
        let mut stance = self.stance;
        if let Some(running) = &self.running
            && let Some(motion) = running.motions.get(running.at)
        {
            let now = running.held.unwrap_or(now);
            let passed = now.since(running.since()).0 as f64 / 1e6 * self.haste;
            stance.joints = motion.joints(passed);
            stance.opening = motion.opening(passed).unwrap_or(stance.opening);
        }
        stance
    }

    fn start(&mut self, now: Micros, id: CommandId, motions: Vec<Motion>) {
        self.given.note(id);
        if motions.is_empty() {
            // The hand holds what it was to pick.
            self.happened.push_back(Event::Done(id));
            return;
        }
        let mut end = now;
        let ends = motions.iter().map(|motion| {
            end = end.after(Micros((motion.duration() / self.haste * 1e6) as u64));
            end
        });
        self.running = Some(Running {
            id,
            ends: ends.collect(),
            motions,
            began: now,
            held: None,
            at: 0,
        });
        self.begin_motion();
    }
}

impl Robot for Sim {
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
            self.happened.push_back(Event::Done(command.id));
            return Ok(Taken::Begun);
        }
        if self.running.is_some() {
            return Err(Refusal::Busy);
        }
        command.check_scene(world)?;
        self.hold.look(world);
        let hand = place(&self.stance.joints);
        let task = check::check(&self.hold, hand, skill, &command.intent, world)?;
        let held = self.hold.thing().is_some() && task.thing() == self.hold.thing();
        let steps = plan(&task, hand, held);
        let motions = rehearse(&steps, &self.stance, &PANDA, &Caps::CAREFUL)?;
        self.start(now, command.id, motions);
        Ok(Taken::Begun)
    }

    fn home(&mut self, now: Micros, id: CommandId) -> Result<Taken, Refusal> {
        self.given.check(id)?;
        if self.running.is_some() {
            return Err(Refusal::Busy);
        }
        let motions = homewards(&self.stance, &PANDA, &Caps::CAREFUL)?;
        self.start(now, id, motions);
        Ok(Taken::Begun)
    }

    fn hold(&mut self, now: Micros) -> Result<(), Refusal> {
        let ended = self.poll(now);
        self.happened.extend(ended);
        let running = self.running.as_mut().ok_or(Refusal::Idle)?;
        if running.held.is_none() {
            running.held = Some(now);
            self.happened.push_back(Event::Held(running.id));
        }
        Ok(())
    }

    fn resume(&mut self, now: Micros) -> Result<(), Refusal> {
        let running = self.running.as_mut().ok_or(Refusal::NotHeld)?;
        let since = running.held.take().ok_or(Refusal::NotHeld)?;
        let pause = now.since(since);
        for moment in running.ends.iter_mut().chain([&mut running.began]) {
            *moment = moment.after(pause);
        }
        self.happened.push_back(Event::Resumed(running.id));
        Ok(())
    }

    fn stop(&mut self, now: Micros) {
        let ended = self.poll(now);
        self.happened.extend(ended);
        let stands = self.stands(now);
        let Some(running) = self.running.take() else {
            return;
        };
        let Some(motion) = running.motions.get(running.at) else {
            return;
        };
        let id = running.id;
        self.stance = stands;
        if let Some(moved) = self.hold.carried(place(&self.stance.joints)) {
            let changes = vec![moved];
            self.happened.push_back(Event::Changed { id, changes });
        }
        self.happened.push_back(Event::Stopped {
            id,
            step: motion.name.clone(),
        });
    }

    fn poll(&mut self, now: Micros) -> Vec<Event> {
        while let Some(running) = &self.running
            && running.held.is_none()
            && running.ends.get(running.at).is_none_or(|end| *end <= now)
        {
            self.end_motion();
        }
        self.happened.drain(..).collect()
    }

    fn progress(&self, now: Micros) -> Option<(CommandId, u8)> {
        let running = self.running.as_ref()?;
        let all = running.ends.last()?.since(running.began).0.max(1);
        let now = running.held.unwrap_or(now);
        let done = now.since(running.began).0.saturating_mul(100) / all;
        Some((running.id, u8::try_from(done.min(100)).unwrap_or(100)))
    }

    fn holding(&self) -> Option<&str> {
        self.hold.thing()
    }

    fn posture(&self, now: Micros) -> Option<Posture> {
        Some(self.stands(now).into())
    }
}
