//! A unit in simulated time, which the bridge reaches by a wire.

use std::io;
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::{Duration, Instant};

use deictic::clock;
use deictic::link::Wire;
use deictic_core::large::Intent;
use deictic_core::protocol::seal::Key;
use deictic_core::time::Micros;

use super::around::Around;
use super::ear::Ear;
use super::inside::{Inside, start};
use super::line::Faults;

/// A handle on the world, which is also the bridge's wire to the unit.
#[derive(Clone)]
pub struct World {
    inside: Arc<Mutex<Inside>>,
    began: Instant,
}

impl World {
    /// A unit that has just started, and a good line.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self::keyed(seed, None)
    }

    /// The same; unit and host have this key.
    #[must_use]
    pub fn keyed(seed: u64, key: Option<Key>) -> Self {
        Self {
            inside: Arc::new(Mutex::new(Inside::new(seed, key))),
            began: clock::now(),
        }
    }

    /// Looks into it.
    ///
    /// # Panics
    /// When something panicked while it looked.
    pub fn inside(&self) -> MutexGuard<'_, Inside> {
        self.inside.lock().expect("nothing panicked in here")
    }

    /// Bytes that nobody sent come out of the line at both of its ends.
    pub fn disturb(&self, bytes: &[u8]) {
        let now = self.now();
        let mut inside = self.inside();
        inside.run(now);
        inside.to_unit.disturb(now, bytes);
        inside.to_host.disturb(now, bytes);
    }

    /// Bytes come on the unit's sensor line.
    pub fn sense(&self, bytes: &[u8]) {
        let now = self.now();
        let mut inside = self.inside();
        inside.run(now);
        let unit_now = now.after(inside.ahead);
        inside.unit.sense(unit_now, bytes);
    }
}

impl Around for World {
    fn opened(&self) {
        self.inside().host_ear = Ear::default();
    }

    fn now(&self) -> Micros {
        Micros(clock::since(self.began).as_micros() as u64)
    }

    fn set_faults(&self, faults: Faults) {
        let mut inside = self.inside();
        inside.to_unit.faults = faults;
        inside.to_host.faults = faults;
    }

    fn narrow(&self, width: usize) {
        self.inside().width = width.max(1);
    }

    fn restart(&self) {
        let mut inside = self.inside();
        inside.boots += 1;
        inside.unit = start(inside.boots, inside.key.as_ref());
        // What it was in the middle of saying is not the beginning of what it says now.
        inside.ear = Ear::default();
        inside.ahead = Micros(0);
        inside.to_unit.break_after(0);
    }

    fn freeze(&self, span: Micros) {
        let until = self.now().after(span);
        self.inside().frozen = until;
    }

    fn pull(&self, span: Micros, more: usize) {
        let until = self.now().after(span);
        let mut inside = self.inside();
        inside.pulled = until;
        inside.to_unit.break_after(more);
        inside.to_host.break_after(more);
    }

    fn jump(&self, span: Micros) {
        let mut inside = self.inside();
        inside.ahead = inside.ahead.after(span);
    }

    fn sleep(&self, span: Micros) {
        clock::sleep(Duration::from_micros(span.0));
    }

    fn heard(&self) -> Micros {
        self.inside().heard
    }

    fn redeem(&self, scene: u32, intent: &Intent) -> bool {
        let mut inside = self.inside();
        let found = inside
            .told
            .iter()
            .find(|(_, told)| told.scene == scene && told.intent == *intent);
        let number = found.map(|(number, _)| *number);
        number.is_some_and(|number| inside.told.remove(&number).is_some())
    }
}

impl Wire for World {
    fn key(&self) -> Option<Key> {
        self.inside().key.clone()
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        let now = self.now();
        let mut inside = self.inside();
        inside.run(now);
        if now < inside.pulled {
            return Err(io::Error::other("pulled"));
        }
        inside.to_unit.write(now, bytes);
        Ok(())
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        let until = self.now().after(Micros(patience.as_micros() as u64));
        loop {
            let now = self.now();
            let mut inside = self.inside();
            inside.run(now);
            let arrived = inside.to_host.take(now, buffer.len());
            if !arrived.bytes.is_empty() {
                inside.listen(now, &arrived.bytes);
                buffer[..arrived.bytes.len()].copy_from_slice(&arrived.bytes);
                return Ok(arrived.bytes.len());
            }
            if now < inside.pulled {
                return Err(io::Error::other("pulled"));
            }
            if now >= until {
                return Ok(0);
            }
            let comes = inside.to_host.next().unwrap_or(Micros::NEVER);
            let next = comes
                .min(inside.next())
                .max(now.after(Micros(1)))
                .min(until);
            drop(inside);
            clock::sleep(Duration::from_micros(next.since(now).0));
        }
    }
}
