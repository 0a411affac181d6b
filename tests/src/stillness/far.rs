//! A robot at the far end of a bus that is always busy.

use std::time::Duration;

use deictic::robot::end::End;
use deictic::robot::remote::{Carrier, OnBus};
use deictic::vocabulary::Lexicon;
use deictic_core::command::message::ToRobot;
use deictic_core::command::parcel::Sender;
use deictic_core::time::Micros;

use super::bus::Node;
use crate::network::watch::Watch;

/// The robot's side, which is turned once in every control period.
pub struct Far {
    end: End,
    carrier: OnBus,
    /// When it last heard that it is to stand still.
    pub halted: Option<Micros>,
    /// When it last heard that its host lives.
    pub beat: Micros,
}

impl Far {
    /// A robot that has just started.
    #[must_use]
    pub fn new(arm: &Watch, lexicon: &Lexicon, node: Node) -> Self {
        Self {
            end: End::new(Box::new(arm.clone()), lexicon.clone(), 1),
            carrier: OnBus::new(Box::new(node), Sender::Robot),
            halted: None,
            beat: Micros(0),
        }
    }

    /// One control period.
    ///
    /// # Panics
    /// Never: this bus does not break.
    pub fn turn(&mut self, now: Micros) {
        let mut out = Vec::new();
        let whole = "this bus does not break";
        while let Some(packet) = self.carrier.receive(Duration::ZERO).expect(whole) {
            match ToRobot::read(&packet) {
                Ok(ToRobot::Halt(_)) => self.halted = Some(now),
                Ok(ToRobot::HostBeat(_)) => self.beat = now,
                _ => {}
            }
            self.end.take(now, &packet, &mut out);
        }
        self.end.poll(now, &mut out);
        for packet in out {
            self.carrier.send(&packet).expect(whole);
        }
    }
}
