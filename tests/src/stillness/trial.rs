//! One motion under full load, and how it came to an end.

use std::io;
use std::time::Duration;

use deictic::clock::Simulated;
use deictic::hand::meaning::HandSetup;
use deictic::link::Wire;
use deictic::robot::remote::{Carrier, OnBus, Remote};
use deictic::robot::{Posture, Robot};
use deictic::session::Session;
use deictic_core::command::parcel::Sender;
use deictic_core::gesture::mapping::Gesture;
use deictic_core::gesture::shape::Shape;
use deictic_core::protocol::hand::Meaning;
use deictic_core::protocol::message::Configuration;
use deictic_core::sentence::{GESTURE, LANGUAGE};
use deictic_core::time::Micros;

use super::PERIOD;
use super::bus::bus;
use super::far::Far;
use super::load::Load;
use crate::network::around::Around;
pub use crate::network::setting::Setting;
use crate::network::watch::Watch;
use crate::network::world::World;

/// Where the arm is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// In the bridge's own process.
    Near,
    /// Behind a CAN bus.
    Far,
}

/// How long the arm may take to begin, and a hand to come to its stop, in control periods.
const PATIENCE: u64 = 20_000;

/// For how long it is looked at after it was stopped.
const AFTER: u64 = 500;

/// How much slower than a careful arm it is, so that it still moves when the hand comes to its stop.
const HASTE: f32 = 0.3;

/// How it ended, in control periods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stillness {
    /// From the period in which the bridge had the cause before it to the one in which the robot's end had it.
    pub under_way: u64,
    /// From then on to the last period in which anything of the arm moved; 0 for none after it.
    pub moved: u64,
}

struct Cell<'a> {
    world: World,
    session: Session<'a>,
    began: Micros,
    arm: Watch,
    far: Option<Far>,
    load: Load,
    loaded: bool,
    /// How the arm stood in the last period.
    stood: Option<Posture>,
    period: u64,
    /// The last period in which it moved.
    moved: u64,
}

impl<'a> Cell<'a> {
    fn new(setting: &'a Setting, ends: Ends, seed: u64) -> Self {
        let world = World::new(seed);
        let wire = world.clone();
        let arm = Watch::new(HASTE);
        let mut far = None;
        let robot: Box<dyn Robot> = match ends {
            Ends::Near => Box::new(arm.clone()),
            Ends::Far => {
                let [host, robot] = bus(seed);
                far = Some(Far::new(&arm, &setting.lexicon, robot));
                let mut host = Some(host);
                let open = move || {
                    let host = host
                        .take()
                        .ok_or_else(|| io::Error::other("opened before"))?;
                    Ok(Box::new(OnBus::new(Box::new(host), Sender::Host)) as Box<dyn Carrier>)
                };
                let remote = Remote::open(Box::new(open), &setting.lexicon);
                Box::new(remote.expect("it opens once"))
            }
        };
        let mut session = Session::open(
            Box::new(move || Ok(Box::new(wire.clone()) as Box<dyn Wire>)),
            robot,
            setting.table.clone(),
            &setting.lexicon,
            Configuration {
                window: Micros::from_millis(200),
                explain: true,
                ..Configuration::DEFAULT
            },
        )
        .expect("nothing is wrong yet");
        let began = world.now();
        let stop = setting.lexicon.vocabulary().stop();
        let meaning = Meaning {
            gesture: Gesture::Shape(Shape::Two as u8),
            action: stop.expect("the tabletop has one"),
        };
        let setup = HandSetup {
            meanings: [meaning].into_iter().collect(),
            ..HandSetup::default()
        };
        session.set_hand(setup).expect("the unit is there");
        Self {
            began,
            session,
            arm,
            far,
            load: Load::new(seed, setting.say("pick", LANGUAGE)),
            loaded: false,
            stood: None,
            period: 0,
            moved: 0,
            world,
        }
    }

    /// The period that a moment of the world falls into.
    fn period_of(&self, moment: Micros) -> u64 {
        moment.since(self.began).0 / PERIOD.0
    }

    /// One control period; with `host` the bridge lives in it.
    fn turn(&mut self, host: bool) {
        let end = self.began.after(Micros((self.period + 1) * PERIOD.0));
        if self.loaded {
            self.load.turn(&self.world, &mut self.session);
        }
        while self.world.now() < end {
            let left = end.since(self.world.now());
            if host {
                let _ = self.session.turn(Duration::from_micros(left.0));
            } else {
                self.world.sleep(left);
            }
        }
        let now = Micros(self.world.now().since(self.began).0);
        if let Some(far) = &mut self.far {
            far.turn(now);
        }
        let stands = self.arm.posture(now);
        if self.stood.is_some() && self.stood != stands {
            self.moved = self.period;
        }
        self.stood = stands;
        self.period += 1;
    }

    /// Has the arm begin a long motion, and fills the lines once it moves.
    fn set_going(&mut self, setting: &Setting) {
        for _ in 0..400 {
            self.turn(true);
        }
        for modality in [LANGUAGE, GESTURE] {
            let heard = self
                .session
                .observe(setting.say("put-into can drawer", modality));
            heard.expect("the unit is there");
        }
        let until = self.period + PATIENCE;
        while self.moved < self.period.saturating_sub(2) || self.moved == 0 {
            self.turn(true);
            assert!(self.period < until, "it never begins");
        }
        self.loaded = true;
    }

    fn is_moving(&self) -> bool {
        self.moved + 2 >= self.period
    }

    /// Looks on after what should have stopped it in period `cause`.
    fn ended(&mut self, host: bool, heard: u64, cause: u64) -> Stillness {
        for _ in 0..AFTER {
            self.turn(host);
        }
        Stillness {
            under_way: cause.saturating_sub(heard),
            moved: self.moved.saturating_sub(cause),
        }
    }
}

/// The unit reads a stop off the hand while the arm moves.
///
/// # Panics
/// When the arm does not move, or nobody stops it.
#[must_use]
pub fn stops(setting: &Setting, ends: Ends, seed: u64) -> Stillness {
    let _clock = Simulated::start();
    let mut cell = Cell::new(setting, ends, seed);
    let stop = setting.lexicon.vocabulary().stop();
    cell.set_going(setting);
    let until = cell.period + PATIENCE;
    let heard = loop {
        let moves = cell.is_moving();
        cell.turn(true);
        let told = cell.world.inside().arrived.clone();
        if let Some((at, intent)) = told
            && Some(intent.action) == stop
        {
            assert!(moves, "it stood still before it was stopped");
            break cell.period_of(at);
        }
        assert!(cell.period < until, "the hand's stop is never read");
    };
    let mut cause = heard;
    if cell.far.is_some() {
        // Beginnings of conversations say it too, long before.
        let halted = |cell: &Cell<'_>| {
            let at = cell.far.as_ref().and_then(|far| far.halted);
            at.map(|at| at.0 / PERIOD.0).filter(|at| *at >= heard)
        };
        while halted(&cell).is_none() {
            cell.turn(true);
            assert!(cell.period < until, "the stop never gets to the robot");
        }
        cause = halted(&cell).unwrap_or_default();
    }
    cell.ended(true, heard, cause)
}

/// The unit falls silent while the arm moves: counted from the last whole frame that came from it.
///
/// # Panics
/// When the arm does not move.
#[must_use]
pub fn loses_its_unit(setting: &Setting, ends: Ends, seed: u64) -> Stillness {
    let _clock = Simulated::start();
    let mut cell = Cell::new(setting, ends, seed);
    cell.set_going(setting);
    for _ in 0..200 {
        cell.turn(true);
    }
    assert!(cell.is_moving());
    cell.world.freeze(Micros::from_millis(3_600_000));
    for _ in 0..2_000 {
        cell.turn(true);
    }
    let heard = cell.period_of(cell.world.inside().heard);
    cell.ended(true, heard, heard)
}

/// The bridge hangs while the arm moves: counted from the last sign of its life that came to the robot.
///
/// # Panics
/// When the arm does not move, or is in the bridge's own process.
#[must_use]
pub fn loses_its_host(setting: &Setting, seed: u64) -> Stillness {
    let _clock = Simulated::start();
    let mut cell = Cell::new(setting, Ends::Far, seed);
    cell.set_going(setting);
    for _ in 0..200 {
        cell.turn(true);
    }
    assert!(cell.is_moving());
    cell.loaded = false;
    for _ in 0..200 {
        cell.turn(false);
    }
    let beat = cell.far.as_ref().expect("a robot behind a bus").beat.0 / PERIOD.0;
    cell.ended(false, beat, beat)
}
