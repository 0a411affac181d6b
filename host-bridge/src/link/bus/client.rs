//! A bus behind an adapter at a serial line, reached in LAWICEL's text protocol.

use std::collections::VecDeque;
use std::io;
use std::time::Duration;

use deictic_core::can::Frame;
use deictic_core::slcan::{Heard, Lines, line};

use super::reading::Reads;
use super::{Bus, BusFault};
use crate::link::Wire;

/// How many refusals in a row an adapter may give before its bus counts as gone.
const REFUSALS: u32 = 16;

/// How many frames may be on their way to an adapter that acknowledges: 16 lines of 22 characters fit the
/// queue of 512 that the unit has.
const ON_THE_WAY: u32 = 16;

/// How long an adapter may take to acknowledge; one that takes longer is one that never does.
const ACKNOWLEDGES: Duration = Duration::from_millis(300);

/// The bridge's end of such a line.
pub struct Client {
    wire: Box<dyn Wire>,
    lines: Lines,
    arrived: VecDeque<Frame>,
    refusals: u32,
    on_the_way: u32,
    acknowledges: bool,
    /// Lines that made no sense.
    damaged: u64,
}

impl Client {
    /// Closes whatever was open, sets 1 Mbit/s and opens the bus.
    ///
    /// # Errors
    /// When the wire is gone.
    pub fn open(mut wire: Box<dyn Wire>) -> io::Result<Self> {
        // The first CR ends whatever half a line the adapter may have heard before.
        wire.write(b"\r\rC\rS8\rO\r")?;
        Ok(Self {
            wire,
            lines: Lines::new(),
            arrived: VecDeque::new(),
            refusals: 0,
            on_the_way: 0,
            acknowledges: true,
            damaged: 0,
        })
    }

    /// How many lines made no sense.
    #[must_use]
    pub fn damaged(&self) -> u64 {
        self.damaged
    }
}

impl Reads for Client {
    fn wire(&mut self) -> &mut dyn Wire {
        self.wire.as_mut()
    }

    fn take(&mut self, bytes: &[u8]) -> io::Result<()> {
        for &byte in bytes {
            match self.lines.hear(byte) {
                None => {}
                Some(Heard::Frame(frame)) => self.arrived.push_back(frame),
                Some(Heard::Other) => {
                    self.refusals = 0;
                    self.on_the_way = self.on_the_way.saturating_sub(1);
                }
                Some(Heard::Damaged) => self.damaged = self.damaged.saturating_add(1),
                Some(Heard::Refused) => {
                    self.refusals += 1;
                    if self.refusals >= REFUSALS {
                        return Err(BusFault::Refused.into());
                    }
                }
            }
        }
        Ok(())
    }

    fn arrived(&mut self) -> &mut VecDeque<Frame> {
        &mut self.arrived
    }
}

impl Bus for Client {
    fn send(&mut self, frame: &Frame) -> io::Result<()> {
        let mut buffer = [0; 512];
        while self.acknowledges && self.on_the_way >= ON_THE_WAY {
            let read = self.wire.read(&mut buffer, ACKNOWLEDGES)?;
            self.take(buffer.get(..read).unwrap_or(&[]))?;
            self.acknowledges = read > 0;
        }
        self.on_the_way = self.on_the_way.saturating_add(1);
        self.wire.write(&line(frame))
    }

    fn receive(&mut self, patience: Duration) -> io::Result<Option<Frame>> {
        self.next(patience)
    }
}
