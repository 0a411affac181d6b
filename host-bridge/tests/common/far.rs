//! A robot at the far end of a line that a test can spoil, with time in the test's hands.
#![allow(dead_code)]

#[path = "cord.rs"]
mod cord;

use std::collections::VecDeque;
use std::io;
use std::sync::{Arc, Mutex};

use deictic::robot::end::End;
use deictic::robot::remote::{Carrier, Gate, Remote};
use deictic::robot::sim::Sim;
use deictic::robot::{Command, CommandId, Event, Refusal, Robot, Taken, World};
use deictic::scene::{SceneFile, Tabletop};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::command::Packet;
use deictic_core::command::parcel::Sender;
use deictic_core::command::seal::ON_A_BUS;
use deictic_core::intent::Parameter;
use deictic_core::large::Intent;
use deictic_core::protocol::seal::{KEY, Key};
use deictic_core::time::Micros;

pub use cord::{Cord, Counted, Far, Way};

/// The key of 32 such bytes.
pub fn key(byte: u8) -> Key {
    Key::new(&[byte; KEY]).unwrap()
}

/// The gate before a side that has this key, or none.
pub fn gate(side: Sender, byte: Option<u8>) -> Gate {
    Gate::new(side, byte.map(key).as_ref(), ON_A_BUS).unwrap()
}

/// How a command has ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ended {
    Refused(Refusal),
    Event(Event),
    Never,
}

/// A host, a line and a far robot before a table.
pub struct Scene {
    pub lexicon: Lexicon,
    pub table: Tabletop,
    pub robot: Box<dyn Robot>,
    pub far: Option<Arc<Mutex<Far>>>,
    pub begun: Arc<Mutex<Vec<CommandId>>>,
    pub now: Micros,
    pub number: u32,
    pub events: Vec<Event>,
}

impl Scene {
    /// The arm is in this process.
    pub fn near() -> Self {
        Self::with(Gate::default(), None)
    }

    /// The arm is at the other end of a line.
    pub fn far() -> Self {
        let begun = Arc::new(Mutex::new(Vec::new()));
        let counted = Counted {
            inner: Sim::new(1.0),
            begun: Arc::clone(&begun),
            hangs: false,
        };
        Self::before(counted)
    }

    /// The arm is at the other end of a line, and each side has a key, or none.
    pub fn keyed(near: Option<u8>, far: Option<u8>) -> Self {
        let counted = Counted {
            inner: Sim::new(1.0),
            begun: Arc::default(),
            hangs: false,
        };
        Self::between(gate(Sender::Host, near), counted, gate(Sender::Robot, far))
    }

    pub fn before(counted: Counted) -> Self {
        Self::between(Gate::default(), counted, Gate::default())
    }

    fn between(near: Gate, counted: Counted, gate: Gate) -> Self {
        let lexicon = Lexicon::tabletop().unwrap();
        let begun = Arc::clone(&counted.begun);
        let far = Arc::new(Mutex::new(Far {
            end: End::new(Box::new(counted), lexicon, 1),
            gate,
            now: Micros(0),
            spoil: None,
            cut: false,
            to_host: VecDeque::new(),
        }));
        Self {
            begun,
            ..Self::with(near, Some(far))
        }
    }

    fn with(gate: Gate, far: Option<Arc<Mutex<Far>>>) -> Self {
        let lexicon = Lexicon::tabletop().unwrap();
        let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
        let robot: Box<dyn Robot> = match &far {
            None => Box::new(Sim::new(1.0)),
            Some(far) => {
                let far = Arc::clone(far);
                let open = Box::new(move || {
                    if far.lock().unwrap().cut {
                        return Err(io::Error::other("pulled"));
                    }
                    Ok(Box::new(Cord(Arc::clone(&far))) as Box<dyn Carrier>)
                });
                Box::new(Remote::behind(gate, open, &lexicon).unwrap())
            }
        };
        let mut scene = Self {
            lexicon,
            table,
            robot,
            far,
            begun: Arc::default(),
            now: Micros(0),
            number: 0,
            events: Vec::new(),
        };
        scene.pass(300);
        scene
    }

    /// Lets time pass, 10 ms at a time, and takes over what changes.
    pub fn pass(&mut self, millis: u64) {
        for _ in 0..millis.div_ceil(10) {
            self.tick();
        }
    }

    pub fn tick(&mut self) {
        self.now = self.now.after(Micros::from_millis(10));
        if let Some(far) = &self.far {
            let mut far = far.lock().unwrap();
            far.now = self.now;
            far.live();
        }
        for event in self.robot.poll(self.now) {
            if let Event::Changed { changes, .. } = &event {
                self.table.apply(changes, &self.lexicon).unwrap();
            }
            self.events.push(event);
        }
    }

    pub fn spoil(
        &self,
        spoil: impl FnMut(Way, &Packet) -> io::Result<Vec<Packet>> + Send + 'static,
    ) {
        self.far.as_ref().unwrap().lock().unwrap().spoil = Some(Box::new(spoil));
    }

    pub fn command(&mut self, written: &str) -> Command {
        let mut words = written.split_whitespace();
        let action = words.next().unwrap();
        let mut intent = Intent {
            action: self.lexicon.option(Category::ACTION, action).unwrap(),
            ..Intent::default()
        };
        for word in words {
            let categories = [Category::OBJECT, Category::STORAGE, Category::DIRECTION];
            // A storage of the same name as an object comes second.
            let found = categories.into_iter().find_map(|c| {
                let free = intent.parameter(c).is_none();
                Some((c, self.lexicon.option(c, word).filter(|_| free)?))
            });
            let (category, option) = found.unwrap();
            let quantity = None;
            let parameter = Parameter {
                category,
                option,
                quantity,
            };
            intent.parameters.push(parameter).unwrap();
        }
        self.number += 1;
        Command {
            id: CommandId {
                run: 1,
                number: self.number,
            },
            intent,
            scene: self.table.version(),
        }
    }

    /// Gives a command; how it has ended is told by [`Scene::ending`].
    pub fn begin(&mut self, written: &str) -> (CommandId, Result<Taken, Refusal>) {
        let command = self.command(written);
        let world = World {
            table: &self.table,
            lexicon: &self.lexicon,
        };
        (command.id, self.robot.begin(self.now, &command, world))
    }

    /// Gives a command and lets time pass until it has ended.
    pub fn run(&mut self, written: &str) -> Ended {
        let (id, taken) = self.begin(written);
        if let Err(refusal) = taken {
            return Ended::Refused(refusal);
        }
        self.ending(id)
    }

    /// Lets up to two minutes pass until a command has ended.
    pub fn ending(&mut self, id: CommandId) -> Ended {
        for _ in 0..12_000 {
            if let Some(end) = self.end_of(id) {
                return end;
            }
            self.tick();
        }
        Ended::Never
    }

    /// How a command has ended, if it has; panics if it has ended twice.
    pub fn end_of(&self, id: CommandId) -> Option<Ended> {
        let ends = self.events.iter().filter_map(|event| match event {
            Event::Done(of) if *of == id => Some(Ended::Event(event.clone())),
            Event::Stopped { id: of, .. } | Event::Failed { id: of, .. } if *of == id => {
                Some(Ended::Event(event.clone()))
            }
            Event::Refused { id: of, refusal } if *of == id => {
                Some(Ended::Refused(refusal.clone()))
            }
            _ => None,
        });
        let ends: Vec<_> = ends.collect();
        assert!(ends.len() <= 1, "{ends:?}");
        ends.into_iter().next()
    }

    /// How often the arm has really begun a command.
    pub fn begun(&self) -> usize {
        self.begun.lock().unwrap().len()
    }
}
