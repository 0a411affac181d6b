//! A gesture unit that is a node on a bus: its byte stream in frames.

use std::collections::VecDeque;
use std::io;
use std::time::{Duration, Instant};

use deictic_core::can::{FROM_UNIT, Frame, TO_UNIT};

use super::Bus;
use crate::link::Wire;

/// The stream to a unit over a bus.
pub struct Node {
    bus: Box<dyn Bus>,
    arrived: VecDeque<u8>,
}

impl Node {
    /// The unit on this bus.
    #[must_use]
    pub fn new(bus: Box<dyn Bus>) -> Self {
        let arrived = VecDeque::new();
        Self { bus, arrived }
    }
}

impl Wire for Node {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        let mut rest = bytes;
        while let Some((frame, carried)) = Frame::of_stream(TO_UNIT, rest) {
            self.bus.send(&frame)?;
            rest = rest.get(carried..).unwrap_or(&[]);
        }
        Ok(())
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        let until = Instant::now() + patience;
        loop {
            let left = until.saturating_duration_since(Instant::now());
            let wait = if self.arrived.is_empty() {
                left
            } else {
                Duration::ZERO
            };
            match self.bus.receive(wait)? {
                Some(frame) if frame.id() == FROM_UNIT => self.arrived.extend(frame.stream()),
                Some(_) => {}
                None if self.arrived.is_empty() && !left.is_zero() => {}
                None => break,
            }
            if self.arrived.len() >= buffer.len() {
                break;
            }
        }
        let taken = self.arrived.len().min(buffer.len());
        for (to, from) in buffer.iter_mut().zip(self.arrived.drain(..taken)) {
            *to = from;
        }
        Ok(taken)
    }
}
