//! A session over the unit's own state machine and a wire that can be made faulty.
#![allow(dead_code)]

use std::io;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use deictic::link::{Inside, Wire};
use deictic::robot::Robot;
use deictic::robot::sim::Sim;
use deictic::scene::{SceneFile, Tabletop};
use deictic::session::{Happening, Session};
use deictic::showing::showing;
use deictic::understanding::{Understood, understand};
use deictic::vocabulary::Lexicon;
use deictic_core::large::{Link, Sentence, ToHost, ToUnit};
use deictic_core::protocol::message::Configuration;
use deictic_core::sentence::LANGUAGE;
use deictic_core::time::Micros;

/// What becomes of a frame from the unit: the bytes that arrive in its place.
pub type Filter = Box<dyn FnMut(&ToHost, &[u8]) -> Vec<u8> + Send>;

/// A line whose faults a test controls.
pub struct Line {
    /// The unit at its end; survives a cut.
    unit: Inside,
    /// The line is broken: reading and writing fail.
    pub cut: bool,
    /// Nothing arrives at either end.
    pub dead: bool,
    /// What becomes of frames from the unit.
    pub filter: Option<Filter>,
    /// What is said to the unit and lost on the way.
    pub swallow: Option<fn(&ToUnit) -> bool>,
    /// How long it takes to say something.
    pub slow: Duration,
    /// How often the line was opened.
    pub opened: usize,
    ear: Box<Link>,
    mouth: Box<Link>,
    frame: Vec<u8>,
}

/// A handle on a line.
#[derive(Clone)]
pub struct Cable(pub Arc<Mutex<Line>>);

impl Cable {
    pub fn new() -> Self {
        Self(Arc::new(Mutex::new(Line {
            unit: Inside::start(),
            cut: false,
            dead: false,
            filter: None,
            swallow: None,
            slow: Duration::ZERO,
            opened: 0,
            ear: Box::default(),
            mouth: Box::default(),
            frame: Vec::new(),
        })))
    }

    pub fn with<T>(&self, act: impl FnOnce(&mut Line) -> T) -> T {
        act(&mut self.0.lock().unwrap())
    }

    /// The unit starts anew, as after a power cut.
    pub fn restart(&self) {
        self.with(|line| line.unit = Inside::start());
    }
}

impl Wire for Cable {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        std::thread::sleep(self.with(|line| line.slow));
        self.with(|line| {
            if line.cut {
                return Err(io::Error::other("pulled"));
            }
            let mut lost = line.dead;
            for &byte in bytes {
                if let Some(said) = line.mouth.receive::<ToUnit>(byte) {
                    lost |= line.swallow.is_some_and(|swallow| swallow(&said.message));
                }
            }
            if lost {
                return Ok(());
            }
            line.unit.write(bytes)
        })
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        let mut taken = [0; 512];
        self.with(|line| {
            if line.cut {
                return Err(io::Error::other("pulled"));
            }
            let n = line
                .unit
                .read(&mut taken, patience.min(Duration::from_millis(2)))?;
            let mut arrived = Vec::new();
            for &byte in &taken[..n] {
                line.frame.push(byte);
                let message = line.ear.receive::<ToHost>(byte).map(|r| r.message);
                if byte == 0 {
                    let frame = std::mem::take(&mut line.frame);
                    match (&mut line.filter, message) {
                        (Some(filter), Some(message)) => arrived.extend(filter(&message, &frame)),
                        _ => arrived.extend(frame),
                    }
                }
            }
            if line.dead {
                arrived.clear();
            }
            assert!(
                arrived.len() <= buffer.len(),
                "a test's buffer is too small"
            );
            buffer[..arrived.len()].copy_from_slice(&arrived);
            Ok(arrived.len())
        })
    }
}

pub fn lexicon() -> Lexicon {
    Lexicon::tabletop().unwrap()
}

pub fn table(lexicon: &Lexicon) -> Tabletop {
    SceneFile::table().unwrap().tabletop(lexicon).unwrap()
}

/// A session with a short window and a fast arm.
pub fn open<'a>(cable: &Cable, lexicon: &'a Lexicon, haste: f32) -> Session<'a> {
    open_on(cable, lexicon, haste, table(lexicon))
}

pub fn open_on<'a>(
    cable: &Cable,
    lexicon: &'a Lexicon,
    haste: f32,
    table: Tabletop,
) -> Session<'a> {
    open_with(cable, lexicon, Box::new(Sim::new(haste)), table)
}

pub fn open_with<'a>(
    cable: &Cable,
    lexicon: &'a Lexicon,
    robot: Box<dyn Robot>,
    table: Tabletop,
) -> Session<'a> {
    open_within(cable, lexicon, robot, table, Micros::from_millis(30))
}

/// A session with this pairing window.
pub fn open_within<'a>(
    cable: &Cable,
    lexicon: &'a Lexicon,
    robot: Box<dyn Robot>,
    table: Tabletop,
    window: Micros,
) -> Session<'a> {
    let wire = cable.clone();
    let opener = Box::new(move || {
        wire.with(|line| line.opened += 1);
        Ok(Box::new(wire.clone()) as Box<dyn Wire>)
    });
    let configuration = Configuration {
        window,
        ..Configuration::DEFAULT
    };
    Session::open(opener, robot, table, lexicon, configuration).unwrap()
}

pub fn said(text: &str, lexicon: &Lexicon) -> Sentence {
    match understand(text, lexicon).unwrap() {
        Understood::Commands(mut sentences) => sentences.remove(0),
        Understood::Nothing(why) => panic!("{why}"),
    }
}

/// The same as shown, but observed as language.
pub fn surely_said(text: &str, lexicon: &Lexicon) -> Sentence {
    let mut sentence = Sentence::new(LANGUAGE);
    for word in showing(text, lexicon).unwrap().words() {
        sentence.push(word.clone()).unwrap();
    }
    sentence
}

/// Turns until something happened that `is_last` accepts; gives all that happened. Panics when it
/// does not come in a great many turns.
pub fn until(session: &mut Session<'_>, is_last: impl Fn(&Happening) -> bool) -> Vec<Happening> {
    let mut all = Vec::new();
    for _ in 0..20_000 {
        for happening in session.turn(Duration::from_millis(1)) {
            let last = is_last(&happening);
            all.push(happening);
            if last {
                return all;
            }
        }
    }
    panic!("it does not come; so far {all:#?}");
}

/// Turns until the session is idle; gives all that happened.
pub fn settle(session: &mut Session<'_>) -> Vec<Happening> {
    let mut all = Vec::new();
    for _ in 0..20_000 {
        all.extend(session.turn(Duration::from_millis(1)));
        if session.is_idle() && session.unit().is_there() {
            return all;
        }
    }
    panic!("it never settles; so far {all:#?}");
}

pub fn moved(happened: &[Happening]) -> bool {
    happened.iter().any(|h| {
        matches!(
            h,
            Happening::Robot(deictic::robot::Event::Begun { .. }) | Happening::Accepted(_)
        )
    })
}

pub fn is_done(h: &Happening) -> bool {
    matches!(h, Happening::Robot(deictic::robot::Event::Done(_)))
}
