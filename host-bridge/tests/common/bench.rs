//! A simulated arm before a table, with time in a test's hands.
#![allow(dead_code)]

use deictic::robot::sim::Sim;
use deictic::robot::{Command, CommandId, Event, Refusal, Robot, World};
use deictic::scene::{SceneFile, Tabletop};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::intent::Parameter;
use deictic_core::large::Intent;
use deictic_core::time::Micros;

pub const O: Category = Category::OBJECT;
pub const S: Category = Category::STORAGE;

/// The motions that began.
pub fn steps(events: &[Event]) -> Vec<&str> {
    let named = events.iter().filter_map(|e| match e {
        Event::Begun { step, .. } => Some(step.as_str()),
        _ => None,
    });
    named.collect()
}

/// The arm, the table, the time.
pub struct Bench {
    pub lexicon: Lexicon,
    pub table: Tabletop,
    pub sim: Sim,
    pub now: Micros,
    pub number: u32,
}

impl Bench {
    pub fn new() -> Self {
        let lexicon = Lexicon::tabletop().unwrap();
        let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
        let (sim, now, number) = (Sim::new(1.0), Micros(5), 0);
        Self {
            lexicon,
            table,
            sim,
            now,
            number,
        }
    }

    pub fn intent(&self, action: &str, things: &[(Category, &str)]) -> Intent {
        let mut intent = Intent {
            action: self.lexicon.option(Category::ACTION, action).unwrap(),
            ..Intent::default()
        };
        for (category, name) in things {
            self.give(&mut intent, *category, name, None);
        }
        intent
    }

    /// Adds a parameter to an intent.
    pub fn give(&self, intent: &mut Intent, category: Category, name: &str, quantity: Option<f32>) {
        let option = self.lexicon.option(category, name).unwrap();
        let parameter = Parameter {
            category,
            option,
            quantity,
        };
        intent.parameters.push(parameter).unwrap();
    }

    pub fn begin_as(&mut self, number: u32, scene: u32, intent: Intent) -> Result<(), Refusal> {
        let id = CommandId { run: 1, number };
        let world = World {
            table: &self.table,
            lexicon: &self.lexicon,
        };
        self.sim
            .begin(self.now, &Command { id, intent, scene }, world)
            .map(|_| ())
    }

    pub fn begin(&mut self, action: &str, things: &[(Category, &str)]) -> Result<(), Refusal> {
        let intent = self.intent(action, things);
        self.number += 1;
        self.begin_as(self.number, self.table.version(), intent)
    }

    /// Lets time pass and takes over what changes.
    pub fn pass(&mut self, seconds: u64) -> Vec<Event> {
        self.now = self.now.after(Micros::from_millis(seconds * 1000));
        let events = self.sim.poll(self.now);
        for event in &events {
            if let Event::Changed { changes, .. } = event {
                self.table.apply(changes, &self.lexicon).unwrap();
            }
        }
        events
    }

    pub fn run(&mut self, action: &str, things: &[(Category, &str)]) -> Vec<Event> {
        self.begin(action, things).unwrap();
        let events = self.pass(120);
        let id = CommandId {
            run: 1,
            number: self.number,
        };
        assert_eq!(events.last(), Some(&Event::Done(id)), "{action}");
        events
    }

    pub fn feature(&self, category: Category, name: &str, feature: &str) -> f32 {
        let option = self.lexicon.option(category, name).unwrap();
        let thing = self.table.find(category, option).unwrap();
        thing.features[self.lexicon.feature(feature).unwrap()]
    }

    /// Whether a thing is within a millimetre of a place.
    pub fn is_at(&self, name: &str, place: [f32; 3]) -> bool {
        let apart = self.position(name).into_iter().zip(place);
        apart.map(|(a, b)| (a - b).abs()).all(|off| off < 1e-3)
    }

    pub fn position(&self, name: &str) -> [f32; 3] {
        let option = self.lexicon.option(Category::OBJECT, name).unwrap();
        self.table.find(Category::OBJECT, option).unwrap().position
    }
}
