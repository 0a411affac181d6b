//! The adapter's end of a serial line: a node that is alone on its bus with whoever holds the line's
//! other end.

use std::collections::VecDeque;
use std::io;
use std::time::Duration;

use deictic_core::can::Frame;
use deictic_core::slcan::{self, Wanted, line};

use super::Bus;
use super::reading::Reads;
use crate::link::Wire;

/// A node behind such a line.
pub struct Adapter {
    wire: Box<dyn Wire>,
    state: slcan::Adapter,
    arrived: VecDeque<Frame>,
}

impl Adapter {
    /// Waits for a client at the other end of the line.
    #[must_use]
    pub fn new(wire: Box<dyn Wire>) -> Self {
        Self {
            wire,
            state: slcan::Adapter::new(),
            arrived: VecDeque::new(),
        }
    }
}

impl Reads for Adapter {
    fn wire(&mut self) -> &mut dyn Wire {
        self.wire.as_mut()
    }

    fn take(&mut self, bytes: &[u8]) -> io::Result<()> {
        let mut answers = Vec::new();
        for &byte in bytes {
            let Some((wanted, answer)) = self.state.take(byte) else {
                continue;
            };
            answers.extend_from_slice(answer);
            if let Wanted::Send(frame) = wanted {
                self.arrived.push_back(frame);
            }
        }
        if answers.is_empty() {
            Ok(())
        } else {
            self.wire.write(&answers)
        }
    }

    fn arrived(&mut self) -> &mut VecDeque<Frame> {
        &mut self.arrived
    }
}

impl Bus for Adapter {
    /// A frame for a line that no client has opened is lost, as on a bus without other nodes.
    fn send(&mut self, frame: &Frame) -> io::Result<()> {
        if self.state.is_open() {
            self.wire.write(&line(frame))
        } else {
            Ok(())
        }
    }

    fn receive(&mut self, patience: Duration) -> io::Result<Option<Frame>> {
        self.next(patience)
    }
}
