//! An arm that speaks its own network interface, the bridge's side of it, and a table.
#![allow(dead_code)]

#[path = "bench.rs"]
pub mod bench;
#[path = "fer.rs"]
pub mod fer;

use std::time::{Duration, Instant};

use bench::Bench;
use deictic::robot::fci::Fci;
use deictic::robot::panda::hand;
use deictic::robot::{Command, CommandId, Event, Refusal, Robot, Taken, World};
use deictic_core::category::Category;
use deictic_core::large::Intent;
use deictic_core::time::Micros;
use fer::Fer;

/// An arm, the bridge's side of it, and a table.
pub struct Lab {
    pub fer: Fer,
    pub fci: Fci,
    pub bench: Bench,
    pub number: u32,
}

pub const NOW: Micros = Micros(0);

impl Lab {
    pub fn new() -> Self {
        let fer = Fer::start();
        let fci = Fci::connect(&fer.arm, &fer.hand, false).unwrap();
        let (bench, number) = (Bench::new(), 0);
        Self {
            fer,
            fci,
            bench,
            number,
        }
    }

    pub fn give(&mut self, number: u32, intent: Intent) -> Result<Taken, Refusal> {
        let id = CommandId { run: 1, number };
        let world = World {
            table: &self.bench.table,
            lexicon: &self.bench.lexicon,
        };
        let scene = self.bench.table.version();
        self.fci.begin(NOW, &Command { id, intent, scene }, world)
    }

    pub fn begin(&mut self, action: &str, things: &[(Category, &str)]) -> Result<Taken, Refusal> {
        self.number += 1;
        let intent = self.bench.intent(action, things);
        self.give(self.number, intent)
    }

    pub fn poll(&mut self) -> Vec<Event> {
        let events = self.fci.poll(NOW);
        for event in &events {
            if let Event::Changed { changes, .. } = event {
                let lexicon = &self.bench.lexicon;
                self.bench.table.apply(changes, lexicon).unwrap();
            }
        }
        events
    }

    /// All events up to one that `is_last` accepts.
    pub fn until(&mut self, is_last: impl Fn(&Event) -> bool) -> Vec<Event> {
        let patience = Instant::now() + Duration::from_secs(60);
        let mut all = Vec::new();
        while Instant::now() < patience {
            for event in self.poll() {
                let last = is_last(&event);
                all.push(event);
                if last {
                    return all;
                }
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        panic!("it does not come; so far {all:#?}");
    }

    pub fn ending(&mut self) -> Event {
        let all = self.until(|e| {
            matches!(
                e,
                Event::Done(_) | Event::Stopped { .. } | Event::Failed { .. }
            )
        });
        all.last().unwrap().clone()
    }

    pub fn hand_is_off(&self, place: [f64; 3]) -> f64 {
        let at = hand(&self.fer.state().q).translation.vector;
        let off = at.iter().zip(place).map(|(a, b)| (a - b) * (a - b));
        off.sum::<f64>().sqrt()
    }

    /// Waits until the arm is connected again, which is tried once a second, and moves it; nothing that was given before
    /// is given again.
    pub fn moves_when_it_is_back(&mut self, after: impl std::fmt::Debug) {
        let cycles = self.fer.state().cycles;
        let patience = Instant::now() + Duration::from_secs(20);
        loop {
            match self.begin("move-up", &[]) {
                Ok(_) => break,
                Err(Refusal::Arm { .. }) if Instant::now() < patience => {
                    assert_eq!(self.fer.state().cycles, cycles);
                    std::thread::sleep(Duration::from_millis(100));
                }
                Err(other) => panic!("after {after:?}: {other}"),
            }
        }
        assert!(matches!(self.ending(), Event::Done(_)), "after {after:?}");
    }
}
