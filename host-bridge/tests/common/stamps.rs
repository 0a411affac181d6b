//! When a decision left the unit, a command went to the robot, and its acceptance came back.

use std::io;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use deictic::link::Wire;
use deictic::robot::remote::Carrier;
use deictic_core::command::Packet;
use deictic_core::command::message::{FromRobot, ToRobot};
use deictic_core::large::{Link, ToHost};
use serde_json::{Value, json};

/// The moments of one command.
#[derive(Clone, Copy, Default)]
struct Moments {
    decided: Option<Instant>,
    given: Option<Instant>,
    accepted: Option<Instant>,
    told: Option<Instant>,
}

/// A handle on them.
#[derive(Clone, Default)]
pub struct Stamps(Arc<Mutex<Moments>>);

impl Stamps {
    fn with(&self, act: impl FnOnce(&mut Moments)) {
        act(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner));
    }

    /// Before the next command.
    pub fn clear(&self) {
        self.with(|moments| *moments = Moments::default());
    }

    /// The session has said that the robot accepted.
    pub fn told(&self) {
        let now = Instant::now();
        self.with(|moments| moments.told = Some(now));
    }
}

/// A wire that notes when a decision's last byte has left the unit.
pub struct Stamped {
    wire: Box<dyn Wire>,
    ear: Box<Link>,
    stamps: Stamps,
}

impl Stamped {
    pub fn new(wire: Box<dyn Wire>, stamps: Stamps) -> Self {
        let ear = Box::default();
        Self { wire, ear, stamps }
    }
}

impl Wire for Stamped {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.wire.write(bytes)
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        let read = self.wire.read(buffer, patience)?;
        let now = Instant::now();
        for &byte in buffer.iter().take(read) {
            let heard = self.ear.receive::<ToHost>(byte).map(|r| r.message);
            if matches!(heard, Some(ToHost::Decision(_))) {
                self.stamps
                    .with(|moments| _ = moments.decided.get_or_insert(now));
            }
        }
        Ok(read)
    }
}

/// A carrier that notes when a command goes to the robot, and when its acceptance is here.
pub struct StampedCarrier {
    carrier: Box<dyn Carrier>,
    stamps: Stamps,
}

impl StampedCarrier {
    pub fn new(carrier: Box<dyn Carrier>, stamps: Stamps) -> Self {
        Self { carrier, stamps }
    }
}

impl Carrier for StampedCarrier {
    fn send(&mut self, packet: &Packet) -> io::Result<()> {
        let now = Instant::now();
        if matches!(ToRobot::read(packet), Ok(ToRobot::Execute(_))) {
            self.stamps
                .with(|moments| _ = moments.given.get_or_insert(now));
        }
        self.carrier.send(packet)
    }

    fn receive(&mut self, patience: Duration) -> io::Result<Option<Packet>> {
        let packet = self.carrier.receive(patience)?;
        let now = Instant::now();
        let message = packet.as_ref().map(FromRobot::read);
        if matches!(message, Some(Ok(FromRobot::Accepted(_)))) {
            self.stamps
                .with(|moments| _ = moments.accepted.get_or_insert(now));
        }
        Ok(packet)
    }

    fn lost(&self) -> u64 {
        self.carrier.lost()
    }
}

/// How long commands took, in microseconds.
#[derive(Default)]
pub struct Shares {
    whole: Vec<u128>,
    bridge: Vec<u128>,
}

impl Shares {
    /// Takes over the moments of a command, if it was accepted.
    pub fn take(&mut self, stamps: &Stamps) {
        let moments = *stamps.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Moments {
            decided: Some(decided),
            given: Some(given),
            accepted: Some(accepted),
            told: Some(told),
        } = moments
        {
            let (whole, line) = (told - decided, accepted - given);
            self.whole.push(whole.as_micros());
            self.bridge.push(whole.saturating_sub(line).as_micros());
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.whole.len()
    }

    /// As a line for programs.
    pub fn told(&self, link: &str) -> Value {
        let at = |took: &[u128], share: usize| {
            let mut took = took.to_vec();
            took.sort_unstable();
            let last = took.len().saturating_sub(1);
            took.get(last * share / 100).copied().unwrap_or_default()
        };
        json!({
            "event": "latency", "link": link, "commands": self.count(), "unit": "us",
            "p50": at(&self.whole, 50), "p99": at(&self.whole, 99), "longest": at(&self.whole, 100),
            "bridge_p50": at(&self.bridge, 50), "bridge_p99": at(&self.bridge, 99),
            "bridge_longest": at(&self.bridge, 100),
        })
    }
}
