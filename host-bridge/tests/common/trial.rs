//! A simulated robot behind a real link, and a bridge's side that reaches it there.
#![allow(dead_code)]

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use deictic::robot::end::{End, Listener, Served};
use deictic::robot::remote::Remote;
use deictic::robot::sim::Sim;
use deictic::robot::way::{self, Way};
use deictic::robot::{Command, CommandId, Event, Fault, Robot, World};
use deictic::scene::{SceneFile, Tabletop};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::intent::Parameter;
use deictic_core::large::Intent;
use deictic_core::time::Micros;

/// A robot that is served in this process.
pub struct Far {
    over: Arc<AtomicBool>,
    moving: Arc<AtomicBool>,
    thread: Option<thread::JoinHandle<()>>,
    pub way: Way,
}

impl Far {
    /// One that listens there, and moves as fast as a careful arm.
    pub fn at(listener: Listener) -> Self {
        Self::hasty(listener, 1.0)
    }

    /// One that is `haste` times as fast.
    pub fn hasty(listener: Listener, haste: f32) -> Self {
        let (over, moving) = (Arc::<AtomicBool>::default(), Arc::<AtomicBool>::default());
        let (ends, moves) = (Arc::clone(&over), Arc::clone(&moving));
        let way = listener.address().parse().unwrap();
        let thread = thread::spawn(move || {
            let end = End::new(Box::new(Sim::new(haste)), Lexicon::tabletop().unwrap(), 1);
            let mut served = Served::new(end, listener);
            while !ends.load(Ordering::Relaxed) {
                served.turn(Duration::from_millis(10));
                moves.store(served.end().is_moving(), Ordering::Relaxed);
            }
        });
        let thread = Some(thread);
        Self {
            over,
            moving,
            thread,
            way,
        }
    }

    /// One on this CAN interface.
    pub fn on(interface: &str) -> Self {
        Self::at(Listener::open(&Way::Can(interface.to_owned())).unwrap())
    }

    /// Whether it is doing a command.
    pub fn is_moving(&self) -> bool {
        self.moving.load(Ordering::Relaxed)
    }
}

impl Drop for Far {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(thread::JoinHandle::join);
    }
}

/// A bridge's side with a table.
pub struct Near {
    pub robot: Remote,
    pub lexicon: Lexicon,
    pub table: Tabletop,
    began: Instant,
    number: u32,
}

impl Near {
    /// One that reaches its robot there.
    pub fn to(way: &Way) -> Self {
        let lexicon = Lexicon::tabletop().unwrap();
        let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
        Self {
            robot: way::reach(way, &lexicon, None).unwrap(),
            lexicon,
            table,
            began: Instant::now(),
            number: 0,
        }
    }

    pub fn now(&self) -> Micros {
        Micros(u64::try_from(self.began.elapsed().as_micros()).unwrap())
    }

    /// Gives a command: an action, and options of its parameters.
    pub fn begin(&mut self, written: &str) -> CommandId {
        self.number += 1;
        let id = CommandId {
            run: 1,
            number: self.number,
        };
        let mut words = written.split_whitespace();
        let option = |category, name| self.lexicon.option(category, name);
        let mut intent = Intent {
            action: option(Category::ACTION, words.next().unwrap()).unwrap(),
            ..Intent::default()
        };
        for word in words {
            let categories = [Category::OBJECT, Category::STORAGE];
            let found = categories
                .into_iter()
                .find_map(|c| Some((c, option(c, word)?)));
            let (category, option) = found.unwrap();
            let quantity = None;
            let parameter = Parameter {
                category,
                option,
                quantity,
            };
            intent.parameters.push(parameter).unwrap();
        }
        let scene = self.table.version();
        let (table, lexicon) = (&self.table, &self.lexicon);
        let now = self.now();
        let command = Command { id, intent, scene };
        self.robot
            .begin(now, &command, World { table, lexicon })
            .unwrap();
        id
    }

    /// What happens up to this, at most thirty seconds.
    pub fn until(&mut self, is_last: impl Fn(&Event) -> bool) -> Vec<Event> {
        let until = Instant::now() + Duration::from_secs(30);
        let mut happened = Vec::new();
        while Instant::now() < until {
            happened.extend(self.robot.poll(self.now()));
            if happened.iter().any(&is_last) {
                return happened;
            }
            thread::sleep(Duration::from_millis(2));
        }
        panic!("it does not come: {happened:?}");
    }

    /// What happens until the command has ended.
    pub fn until_end(&mut self, id: CommandId) -> Vec<Event> {
        self.until(|event| {
            matches!(event, Event::Done(of) | Event::Stopped { id: of, .. } | Event::Failed { id: of, .. }
                | Event::Refused { id: of, .. } if *of == id)
        })
    }

    /// Lets time pass.
    pub fn pass(&mut self, time: Duration) {
        let until = Instant::now() + time;
        while Instant::now() < until {
            let _ = self.robot.poll(self.now());
            thread::sleep(Duration::from_millis(2));
        }
    }

    /// Moves the arm up a little, which must go well.
    pub fn moves_up(&mut self) {
        let id = self.begin("move-up");
        let happened = self.until_end(id);
        assert_eq!(happened.last(), Some(&Event::Done(id)), "{happened:?}");
    }
}

/// Whether the command has failed as one of a lost robot.
pub fn lost(happened: &[Event]) -> bool {
    matches!(
        happened.last(),
        Some(Event::Failed {
            fault: Fault::RobotLost,
            ..
        })
    )
}
