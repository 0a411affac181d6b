//! Hands in front of a unit in this process: samples on its sensor line, and what it decides.

use std::time::Duration;

use deictic::hand::session::Act;
use deictic::hand::source::recording::framed;
use deictic_core::board::{ToHost, ToUnit, Unit};
use deictic_core::category::Category;
use deictic_core::decide::Outcome;
use deictic_core::gesture::counters::SampleCounters;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::wire::Sample;
use deictic_core::intent::Intent;
use deictic_core::protocol::message::Heartbeat;
use deictic_core::time::Micros;

use crate::gesturing::{OBJECTS, PUT, RATE, STORAGES, ready, separate};
use crate::host::{Host, Wire};

/// A unit in this process whose clock is the test's.
pub struct Clocked {
    /// The unit.
    pub unit: Box<Unit>,
    /// Its clock.
    pub now: Micros,
}

impl Default for Clocked {
    fn default() -> Self {
        Self {
            unit: Box::new(Unit::new(1)),
            now: Micros(1),
        }
    }
}

impl Wire for Clocked {
    fn write(&mut self, bytes: &[u8]) {
        self.unit.receive(self.now, bytes);
    }

    fn read(&mut self, _: Duration) -> Vec<u8> {
        self.unit.poll(self.now);
        let bytes = self.unit.outgoing().to_vec();
        self.unit.sent(bytes.len());
        bytes
    }
}

/// A host with a unit in this process, and samples at the sensor's pace.
pub struct Table(pub Host<Clocked>);

impl Default for Table {
    fn default() -> Self {
        Self::new()
    }
}

impl Table {
    /// Vocabulary, scene and meanings are loaded.
    #[must_use]
    pub fn new() -> Self {
        Self(ready(Clocked::default()))
    }

    /// Time passes.
    pub fn wait(&mut self, span: Micros) {
        let wire = &mut self.0.wire;
        wire.now = wire.now.after(span);
        wire.unit.poll(wire.now);
    }

    /// Bytes on the unit's sensor line, 9 ms after those before; the host lives all the while.
    pub fn sense(&mut self, bytes: &[u8]) {
        self.wait(Micros((1e6 / RATE) as u64));
        let beat = Heartbeat {
            now: Micros(0),
            vocabulary: 0,
            scene: 0,
        };
        self.0.say(&ToUnit::Heartbeat(beat));
        let wire = &mut self.0.wire;
        wire.unit.sense(wire.now, bytes);
    }

    /// Samples on the unit's sensor line, at their pace.
    pub fn sense_all(&mut self, samples: &[Sample]) {
        for sample in samples {
            self.sense(&framed(sample));
            // What the unit says is taken from it in time.
            self.0.hear();
        }
    }

    /// What has become of samples. What was said before and not looked at is dropped.
    pub fn counted(&mut self) -> SampleCounters {
        self.0.say(&ToUnit::AskHand);
        self.0.wait_for(|m| match m {
            ToHost::HandStatistics(statistics) => Some(statistics.samples),
            _ => None,
        })
    }

    /// What the unit has decided to do so far.
    #[must_use]
    pub fn decisions(&mut self) -> Vec<Outcome<8>> {
        let heard = self.0.heard();
        let outcome = |m: ToHost| match m {
            ToHost::Decision(decided) => Some(decided.decision.outcome),
            _ => None,
        };
        heard.into_iter().filter_map(outcome).collect()
    }
}

/// Thumb up, an object, a storage.
#[must_use]
pub fn put() -> [Act; 5] {
    [
        Act::Show(Shape::ThumbsUp),
        separate(),
        Act::Point(OBJECTS[1]),
        separate(),
        Act::Point(STORAGES[0]),
    ]
}

/// An action and its parameters.
pub type Deed = (u8, Vec<(Category, u8)>);

/// What an outcome executes.
#[must_use]
pub fn executed(outcome: &Outcome<8>) -> Option<Deed> {
    let Outcome::Execute(Intent { action, parameters }) = outcome else {
        return None;
    };
    let parameters = parameters.iter().map(|p| (p.category, p.option));
    Some((*action, parameters.collect()))
}

/// What each of these executes.
#[must_use]
pub fn all_executed(outcomes: &[Outcome<8>]) -> Vec<Option<Deed>> {
    outcomes.iter().map(executed).collect()
}

/// What [`put`] means.
#[must_use]
pub fn expected() -> Option<Deed> {
    Some((PUT, vec![(Category::OBJECT, 1), (Category::STORAGE, 0)]))
}
