//! A robot under observation: the simulated one, and beside it what it was told and what it did.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard};

use deictic::robot::sim::Sim;
use deictic::robot::{
    Command, CommandId, Event, Fault, Posture, Refusal, Robot, Taken, World as Around,
};
use deictic_core::time::Micros;

/// What a robot was told and did.
pub struct Seen {
    sim: Sim,
    /// Whether somebody has pulled its plug.
    killed: bool,
    /// Commands that it has begun, with the moments.
    pub begun: Vec<(Command, Micros)>,
    /// The command whose end it has not told yet.
    open: Option<CommandId>,
    /// What it died of doing, and has yet to tell.
    last_words: Vec<Event>,
}

/// A handle on the robot.
#[derive(Clone)]
pub struct Watch(Arc<Mutex<Seen>>);

impl Watch {
    /// An arm that moves `haste` times as fast as a careful one.
    #[must_use]
    pub fn new(haste: f32) -> Self {
        Self(Arc::new(Mutex::new(Seen {
            sim: Sim::new(haste),
            killed: false,
            begun: Vec::new(),
            open: None,
            last_words: Vec::new(),
        })))
    }

    /// Looks at it.
    ///
    /// # Panics
    /// When something panicked while it looked.
    pub fn seen(&self) -> MutexGuard<'_, Seen> {
        self.0.lock().expect("nothing panicked in here")
    }

    /// Pulls its plug: it stops, and takes nothing more until it is revived.
    pub fn kill(&self, now: Micros) {
        let mut seen = self.seen();
        if seen.killed {
            return;
        }
        seen.killed = true;
        let doing = seen.open.take();
        seen.sim.stop(now);
        // It does not live to tell how it ended, only, once somebody asks, that it has.
        let _ = seen.sim.poll(now);
        let failed = doing.map(|id| Event::Failed {
            id,
            fault: Fault::RobotLost,
            why: "its plug was pulled".into(),
        });
        seen.last_words.extend(failed);
    }

    /// Puts the plug back.
    pub fn revive(&self) {
        self.seen().killed = false;
    }
}

impl Seen {
    /// Whether it moves at this moment.
    #[must_use]
    pub fn is_moving(&self, now: Micros) -> bool {
        self.sim
            .progress(now)
            .is_some_and(|(_, percent)| percent < 100)
    }

    /// Whether no command was begun twice.
    #[must_use]
    pub fn nothing_twice(&self) -> bool {
        let ids: BTreeSet<CommandId> = self.begun.iter().map(|(command, _)| command.id).collect();
        ids.len() == self.begun.len()
    }
}

impl Robot for Watch {
    fn begin(
        &mut self,
        now: Micros,
        command: &Command,
        around: Around<'_>,
    ) -> Result<Taken, Refusal> {
        let mut seen = self.seen();
        if seen.killed {
            return Err(Refusal::Busy);
        }
        let taken = seen.sim.begin(now, command, around)?;
        seen.begun.push((command.clone(), now));
        seen.open = Some(command.id);
        Ok(taken)
    }

    fn stop(&mut self, now: Micros) {
        let mut seen = self.seen();
        seen.sim.stop(now);
    }

    fn poll(&mut self, now: Micros) -> Vec<Event> {
        let mut seen = self.seen();
        let mut events = std::mem::take(&mut seen.last_words);
        events.extend(seen.sim.poll(now));
        let open = seen.open;
        let ends = |event: &Event| match event {
            Event::Done(id) | Event::Stopped { id, .. } | Event::Failed { id, .. } => {
                open == Some(*id)
            }
            _ => false,
        };
        if events.iter().any(ends) {
            seen.open = None;
        }
        events
    }

    fn progress(&self, now: Micros) -> Option<(CommandId, u8)> {
        self.seen().sim.progress(now)
    }

    fn posture(&self, now: Micros) -> Option<Posture> {
        self.seen().sim.posture(now)
    }

    fn holding(&self) -> Option<&str> {
        // What it holds stands behind a lock; nobody asks in here.
        None
    }
}
