//! The unit's own state machine in this process, for trying things without a board.

use std::io;
use std::time::{Duration, Instant};

use deictic_core::board::Unit;
use deictic_core::protocol::seal::Key;
use deictic_core::time::Micros;

use super::Wire;
use crate::clock;

/// A unit of a board's capacities with nothing between it and the bridge.
pub struct Inside {
    unit: Box<Unit>,
    began: Instant,
}

impl Inside {
    /// A unit that has just started.
    #[must_use]
    pub fn start() -> Self {
        Self {
            unit: Box::new(Unit::new(std::process::id())),
            began: clock::now(),
        }
    }

    /// The unit listens to nobody who has not shown to have this key.
    pub fn lock(&mut self, key: Key) {
        self.unit.lock(key);
    }

    fn now(&self) -> Micros {
        Micros(u64::try_from(clock::since(self.began).as_micros()).unwrap_or(u64::MAX))
    }
}

impl Wire for Inside {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        let now = self.now();
        self.unit.poll(now);
        self.unit.receive(now, bytes);
        Ok(())
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        let until = clock::now() + patience;
        loop {
            let now = self.now();
            self.unit.poll(now);
            let waiting = self.unit.outgoing();
            if !waiting.is_empty() {
                let taken = waiting.len().min(buffer.len());
                for (to, from) in buffer.iter_mut().zip(waiting) {
                    *to = *from;
                }
                self.unit.sent(taken);
                return Ok(taken);
            }
            let Some(left) = clock::until(until) else {
                return Ok(0);
            };
            let wake = Duration::from_micros(self.unit.next_wake().since(now).0);
            clock::sleep(wake.min(left));
        }
    }
}
