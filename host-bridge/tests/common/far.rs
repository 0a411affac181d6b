//! A robot at the far end of a line that a test can spoil, with time in the test's hands.
#![allow(dead_code)]

use std::collections::VecDeque;
use std::io;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use deictic::robot::end::End;
use deictic::robot::remote::{Carrier, Remote};
use deictic::robot::sim::Sim;
use deictic::robot::{Command, CommandId, Event, Posture, Refusal, Robot, Taken, World};
use deictic::scene::{SceneFile, Tabletop};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::command::Packet;
use deictic_core::intent::Parameter;
use deictic_core::large::Intent;
use deictic_core::time::Micros;

/// Which way a packet goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    ToRobot,
    ToHost,
}

/// What becomes of a packet: those that arrive in its place; an error is a cable that is pulled.
pub type Spoil = Box<dyn FnMut(Way, &Packet) -> io::Result<Vec<Packet>> + Send>;

/// Counts what an arm really begins.
pub struct Counted {
    pub inner: Sim,
    pub begun: Arc<Mutex<Vec<CommandId>>>,
    /// It begins, but never ends by itself.
    pub hangs: bool,
}

impl Robot for Counted {
    fn begin(
        &mut self,
        now: Micros,
        command: &Command,
        world: World<'_>,
    ) -> Result<Taken, Refusal> {
        let taken = self.inner.begin(now, command, world)?;
        self.begun.lock().unwrap().push(command.id);
        Ok(taken)
    }

    fn stop(&mut self, now: Micros) {
        // Hosts stop whatever it may be doing when they come.
        self.hangs &= self.begun.lock().unwrap().is_empty();
        self.inner.stop(now);
    }

    fn poll(&mut self, now: Micros) -> Vec<Event> {
        if self.hangs {
            return Vec::new();
        }
        self.inner.poll(now)
    }

    fn progress(&self, now: Micros) -> Option<(CommandId, u8)> {
        self.inner.progress(now)
    }

    fn holding(&self) -> Option<&str> {
        self.inner.holding()
    }

    fn posture(&self, now: Micros) -> Option<Posture> {
        self.inner.posture(now)
    }
}

/// The far end and the line to it.
pub struct Far {
    pub end: End,
    pub now: Micros,
    pub spoil: Option<Spoil>,
    /// Reading and writing fail.
    pub cut: bool,
    to_host: VecDeque<Packet>,
}

impl Far {
    fn carry(&mut self, way: Way, packets: Vec<Packet>) -> io::Result<Vec<Packet>> {
        let Some(spoil) = &mut self.spoil else {
            return Ok(packets);
        };
        let mut arrive = Vec::new();
        for packet in packets {
            arrive.extend(spoil(way, &packet).inspect_err(|_| self.cut = true)?);
        }
        Ok(arrive)
    }

    /// The far end lives on, whoever listens.
    pub fn live(&mut self) {
        let mut out = Vec::new();
        self.end.poll(self.now, &mut out);
        if !self.cut {
            let arrived = self.carry(Way::ToHost, out).unwrap_or_default();
            self.to_host.extend(arrived);
        }
    }
}

/// The host's end of the line.
pub struct Cord(pub Arc<Mutex<Far>>);

impl Carrier for Cord {
    fn send(&mut self, packet: &Packet) -> io::Result<()> {
        let mut far = self.0.lock().unwrap();
        if far.cut {
            return Err(io::Error::other("pulled"));
        }
        for packet in far.carry(Way::ToRobot, vec![packet.clone()])? {
            let (now, mut out) = (far.now, Vec::new());
            far.end.take(now, &packet, &mut out);
            let out = far.carry(Way::ToHost, out)?;
            far.to_host.extend(out);
        }
        Ok(())
    }

    fn receive(&mut self, patience: Duration) -> io::Result<Option<Packet>> {
        let mut far = self.0.lock().unwrap();
        far.live();
        if far.cut {
            return Err(io::Error::other("pulled"));
        }
        let packet = far.to_host.pop_front();
        drop(far);
        if packet.is_none() && !patience.is_zero() {
            std::thread::sleep(Duration::from_millis(1));
        }
        Ok(packet)
    }

    fn lost(&self) -> u64 {
        0
    }
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
        Self::with(None)
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

    pub fn before(counted: Counted) -> Self {
        let lexicon = Lexicon::tabletop().unwrap();
        let begun = Arc::clone(&counted.begun);
        let far = Arc::new(Mutex::new(Far {
            end: End::new(Box::new(counted), lexicon, 1),
            now: Micros(0),
            spoil: None,
            cut: false,
            to_host: VecDeque::new(),
        }));
        Self {
            begun,
            ..Self::with(Some(far))
        }
    }

    fn with(far: Option<Arc<Mutex<Far>>>) -> Self {
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
                Box::new(Remote::open(open, &lexicon).unwrap())
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
