//! What carries the command set: a CAN bus, or a byte stream.

use std::collections::VecDeque;
use std::io;
use std::time::{Duration, Instant};

use deictic_core::can::{BusFrame, CLASSIC};
use deictic_core::command::Packet;
use deictic_core::command::letter::Letters;
use deictic_core::command::parcel::{Assembler, Sender, frames};
use deictic_core::protocol::stuffing::Outbox;

use crate::link::Wire;
use crate::link::bus::Bus;

/// Carries packets to the other side and back.
pub trait Carrier: Send {
    /// Gives a packet to the line.
    ///
    /// # Errors
    /// When the line is gone; what it carried before is then unknown.
    fn send(&mut self, packet: &Packet) -> io::Result<()>;

    /// A packet from the other side, waiting up to `patience` for it; `None` when none came.
    ///
    /// # Errors
    /// When the line is gone.
    fn receive(&mut self, patience: Duration) -> io::Result<Option<Packet>>;

    /// Packets that were lost or damaged on the way, as far as this end can tell.
    fn lost(&self) -> u64;
}

/// Packets in CAN frames, classic ones or those of CAN FD.
pub struct OnBus<const ROOM: usize = CLASSIC> {
    bus: Box<dyn Bus<BusFrame<ROOM>>>,
    side: Sender,
    assembler: Assembler,
    lost: u64,
}

impl<const ROOM: usize> OnBus<ROOM> {
    /// The end of `side` on this bus.
    #[must_use]
    pub fn new(bus: Box<dyn Bus<BusFrame<ROOM>>>, side: Sender) -> Self {
        let other = match side {
            Sender::Host => Sender::Robot,
            Sender::Robot => Sender::Host,
        };
        Self {
            bus,
            side,
            assembler: Assembler::new(other),
            lost: 0,
        }
    }
}

impl<const ROOM: usize> Carrier for OnBus<ROOM> {
    fn send(&mut self, packet: &Packet) -> io::Result<()> {
        for frame in frames(self.side, packet) {
            self.bus.send(&frame)?;
        }
        Ok(())
    }

    fn receive(&mut self, patience: Duration) -> io::Result<Option<Packet>> {
        let until = Instant::now() + patience;
        loop {
            let left = until.saturating_duration_since(Instant::now());
            let Some(frame) = self.bus.receive(left)? else {
                return Ok(None);
            };
            match self.assembler.take(&frame) {
                Some(Ok(packet)) => return Ok(Some(packet)),
                Some(Err(_)) => self.lost = self.lost.saturating_add(1),
                None => {}
            }
        }
    }

    fn lost(&self) -> u64 {
        self.lost
    }
}

/// Packets in the protocol's own frames, over a byte stream.
pub struct OnWire {
    wire: Box<dyn Wire>,
    /// Whether something has been said.
    begun: bool,
    letters: Box<Letters>,
    arrived: VecDeque<Packet>,
}

impl OnWire {
    /// An end of this wire.
    #[must_use]
    pub fn new(wire: Box<dyn Wire>) -> Self {
        Self {
            wire,
            begun: false,
            letters: Box::default(),
            arrived: VecDeque::new(),
        }
    }
}

impl Carrier for OnWire {
    fn send(&mut self, packet: &Packet) -> io::Result<()> {
        let mut out = Outbox::<128>::new();
        if !self.letters.send(packet, &mut out) {
            return Err(io::Error::other("a packet does not fit a frame"));
        }
        if !std::mem::replace(&mut self.begun, true) {
            // Ends whatever half a frame the other side may have heard before.
            self.wire.write(&[0])?;
        }
        self.wire.write(out.waiting())
    }

    fn receive(&mut self, patience: Duration) -> io::Result<Option<Packet>> {
        let until = Instant::now() + patience;
        let mut buffer = [0; 512];
        loop {
            if let Some(packet) = self.arrived.pop_front() {
                return Ok(Some(packet));
            }
            let left = until.saturating_duration_since(Instant::now());
            let read = self.wire.read(&mut buffer, left)?;
            for &byte in buffer.iter().take(read) {
                let received = self.letters.receive::<Packet>(byte);
                self.arrived.extend(received.map(|r| r.message));
            }
            if read == 0 && self.arrived.is_empty() && Instant::now() >= until {
                return Ok(None);
            }
        }
    }

    fn lost(&self) -> u64 {
        let counters = self.letters.counters();
        u64::from(counters.dropped()) + u64::from(counters.missed)
    }
}
