//! A bus in this process, for trying nodes against each other without an interface.

use std::collections::VecDeque;
use std::io;
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use deictic_core::can::Frame;

use deictic::link::bus::Bus;

#[derive(Default)]
struct Wires {
    /// What every node has not taken yet.
    queues: Mutex<Vec<VecDeque<Frame>>>,
    more: Condvar,
}

/// A bus; every [`Memory`] node made of it hears what the others send.
#[derive(Clone, Default)]
pub struct MemoryBus(Arc<Wires>);

impl MemoryBus {
    /// One more node.
    #[must_use]
    pub fn node(&self) -> Memory {
        let mut queues = self.0.queues.lock().unwrap_or_else(PoisonError::into_inner);
        queues.push(VecDeque::new());
        Memory {
            wires: Arc::clone(&self.0),
            number: queues.len() - 1,
        }
    }
}

/// A node on a [`MemoryBus`].
pub struct Memory {
    wires: Arc<Wires>,
    number: usize,
}

impl Bus for Memory {
    fn send(&mut self, frame: &Frame) -> io::Result<()> {
        let mut queues = self
            .wires
            .queues
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        for (number, queue) in queues.iter_mut().enumerate() {
            if number != self.number {
                queue.push_back(frame.clone());
            }
        }
        self.wires.more.notify_all();
        Ok(())
    }

    fn receive(&mut self, patience: Duration) -> io::Result<Option<Frame>> {
        let until = Instant::now() + patience;
        let mut queues = self
            .wires
            .queues
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        loop {
            if let Some(frame) = queues.get_mut(self.number).and_then(VecDeque::pop_front) {
                return Ok(Some(frame));
            }
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Ok(None);
            }
            let waited = self.wires.more.wait_timeout(queues, left);
            (queues, _) = waited.unwrap_or_else(PoisonError::into_inner);
        }
    }
}
