//! An emulated board in a hurry, and the line to it, on which frames are lost, damaged, cut, doubled, delayed.

use std::collections::BTreeMap;
use std::io;
use std::process::Command;
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::{Duration, Instant};

use deictic::clock;
use deictic::link::{Emulation, Wire};
use deictic_core::decide::Outcome;
use deictic_core::large::{Intent, Link, ToHost};
use deictic_core::protocol::message::Statistics;
use deictic_core::time::Micros;

use crate::network::around::Around;
use crate::network::inside::Told;
use crate::network::line::{Faults, Line};

/// How many times as fast as ours the board's time passes: its image takes 25 MHz for 1.
pub const HASTE: u32 = 25;

/// The environment variable that names that image, which `cargo xtask soak` sets.
const IMAGE_VARIABLE: &str = "DEICTIC_IMAGE_HASTY";

/// The farthest that the bridge's clock jumps: more than all of its patience with a unit.
const FARTHEST: Duration = Duration::from_secs(5);

/// Whether there is an image to run; says why not when there is none.
#[must_use]
pub fn has_image() -> bool {
    let named = std::env::var_os(IMAGE_VARIABLE).is_some();
    if !named {
        eprintln!(
            "skipped: no image in a hurry; `cargo xtask test` builds one and names it in {IMAGE_VARIABLE}"
        );
    }
    named
}

/// What the board has said, and how it fares.
#[derive(Default)]
pub struct Heard {
    ear: Box<Link>,
    /// Executions of each start of the board, by the number of the decision.
    told: BTreeMap<(u32, u32), Told>,
    /// Decisions since the board started.
    decisions: u32,
    /// Greetings since statistics were looked at last, each of which may have cut one short that counts.
    greetings: u32,
    /// Statistics that were not what had been said.
    pub wrong: Vec<(u32, Statistics)>,
    /// How often statistics were looked at.
    pub looked: u32,
    /// How far the board's clock was behind ours at least, in every start, and what it was last.
    pub behind: BTreeMap<u32, (i64, i64)>,
}

struct Inside {
    /// None in the moment between two boards.
    emulation: Option<Emulation>,
    wire: Box<dyn Wire>,
    boots: u32,
    booted: Instant,
    pulled: Micros,
    to_unit: Line,
    to_host: Line,
    last: Micros,
    heard: Heard,
}

/// A handle on the board and its line, which is also the bridge's wire.
#[derive(Clone)]
pub struct Cable {
    inside: Arc<Mutex<Inside>>,
    began: Instant,
}

fn boot() -> (Emulation, Box<dyn Wire>) {
    let image = std::env::var_os(IMAGE_VARIABLE).expect("an image");
    let mut board = Emulation::start(image.as_ref(), [true, false, false], &[])
        .expect("QEMU is there: `cargo xtask setup` installs it");
    let wire = board.take(0).expect("it was wanted");
    (board, wire)
}

impl Cable {
    /// A board that has just started, and a good line.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let booted = Instant::now();
        let (emulation, wire) = boot();
        let inside = Inside {
            emulation: Some(emulation),
            wire,
            boots: 1,
            booted,
            pulled: Micros(0),
            to_unit: Line::new(seed ^ 1, Faults::NONE),
            to_host: Line::new(seed ^ 2, Faults::NONE),
            last: Micros(0),
            heard: Heard::default(),
        };
        Self {
            inside: Arc::new(Mutex::new(inside)),
            began: clock::now(),
        }
    }

    fn inside(&self) -> MutexGuard<'_, Inside> {
        self.inside.lock().expect("nothing panicked in here")
    }

    /// What the board has said.
    pub fn with_heard<T>(&self, look: impl FnOnce(&Heard) -> T) -> T {
        look(&self.inside().heard)
    }

    /// How often the board has started.
    #[must_use]
    pub fn boots(&self) -> u32 {
        self.inside().boots
    }
}

impl Inside {
    /// Carries over what is due.
    fn carry(&mut self, now: Micros) -> io::Result<()> {
        let due = self.to_unit.take(now, usize::MAX);
        if !due.bytes.is_empty() {
            self.wire.write(&due.bytes)?;
        }
        let mut buffer = [0; 4096];
        loop {
            let read = self.wire.read(&mut buffer, Duration::ZERO)?;
            let bytes = buffer.get(..read).unwrap_or_default();
            if bytes.is_empty() {
                return Ok(());
            }
            let age = self.booted.elapsed() * HASTE;
            self.heard.note(bytes, self.boots, age);
            if now >= self.pulled {
                self.to_host.write(now, bytes);
            }
        }
    }
}

impl Heard {
    fn note(&mut self, bytes: &[u8], boots: u32, age: Duration) {
        for &byte in bytes {
            let Some(received) = self.ear.receive::<ToHost>(byte) else {
                continue;
            };
            match received.message {
                ToHost::Decision(decided) => {
                    self.decisions += 1;
                    if let Outcome::Execute(intent) = decided.decision.outcome {
                        let scene = decided.scene;
                        // Larger capacities, the same form.
                        let intent = Intent {
                            action: intent.action,
                            parameters: intent.parameters,
                        };
                        let number = (boots, decided.number);
                        self.told.insert(number, Told { intent, scene });
                    }
                }
                ToHost::Statistics(counted) => {
                    self.looked += 1;
                    let decided = counted.executes + counted.asks + counted.repeats;
                    let cut = decided.checked_sub(self.decisions);
                    if cut.is_none_or(|cut| cut > self.greetings) {
                        self.wrong.push((self.decisions, counted));
                    }
                    (self.decisions, self.greetings) = (decided, 0);
                }
                ToHost::Hello(_) => self.greetings += 1,
                ToHost::Heartbeat(beat) => {
                    let behind = age.as_micros() as i64 - beat.now.0 as i64;
                    let seen = self.behind.entry(boots).or_insert((behind, behind));
                    *seen = (seen.0.min(behind), behind);
                }
                _ => {}
            }
        }
    }
}

impl Around for Cable {
    fn now(&self) -> Micros {
        Micros(clock::since(self.began).as_micros() as u64)
    }

    fn heard(&self) -> Micros {
        self.inside().last
    }

    fn redeem(&self, scene: u32, intent: &Intent) -> bool {
        let told = &mut self.inside().heard.told;
        let found = told
            .iter()
            .find(|(_, told)| told.scene == scene && told.intent == *intent);
        let number = found.map(|(number, _)| *number);
        number.is_some_and(|number| told.remove(&number).is_some())
    }

    fn set_faults(&self, faults: Faults) {
        let mut inside = self.inside();
        inside.to_unit.faults = faults;
        inside.to_host.faults = faults;
    }

    /// A line of sockets is as wide as it is.
    fn narrow(&self, _: usize) {}

    fn restart(&self) {
        let mut inside = self.inside();
        inside.emulation = None;
        inside.booted = Instant::now();
        let (board, wire) = boot();
        (inside.emulation, inside.wire) = (Some(board), wire);
        inside.boots += 1;
        inside.to_unit.break_after(0);
        (inside.heard.decisions, inside.heard.greetings) = (0, 0);
        *inside.heard.ear = Link::default();
    }

    fn pull(&self, span: Micros, more: usize) {
        let until = self.now().after(span);
        let mut inside = self.inside();
        inside.pulled = until;
        inside.to_unit.break_after(more);
        inside.to_host.break_after(more);
    }

    fn freeze(&self, span: Micros) {
        let inside = self.inside();
        let signal = |name: &str| {
            let id = inside.emulation.as_ref().map_or(0, Emulation::process);
            let id = id.to_string();
            let done = Command::new("kill").args([name, &id]).status();
            assert!(done.is_ok_and(|status| status.success()), "kill {name}");
        };
        signal("-STOP");
        std::thread::sleep(Duration::from_micros(span.0) / HASTE);
        signal("-CONT");
    }

    /// The bridge's clock jumps ahead of the unit's.
    fn jump(&self, span: Micros) {
        clock::jump(Duration::from_micros(span.0).min(FARTHEST));
    }

    fn sleep(&self, span: Micros) {
        clock::sleep(Duration::from_micros(span.0));
    }
}

impl Wire for Cable {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        let now = self.now();
        let mut inside = self.inside();
        if now < inside.pulled {
            return Err(io::Error::other("pulled"));
        }
        inside.to_unit.write(now, bytes);
        inside.carry(now)
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        let until = self.now().after(Micros(patience.as_micros() as u64));
        loop {
            let now = self.now();
            let mut inside = self.inside();
            inside.carry(now)?;
            let arrived = inside.to_host.take(now, buffer.len());
            if arrived.sound {
                inside.last = now;
            }
            if let Some(room) = buffer.get_mut(..arrived.bytes.len())
                && !room.is_empty()
            {
                room.copy_from_slice(&arrived.bytes);
                return Ok(arrived.bytes.len());
            }
            if now < inside.pulled {
                return Err(io::Error::other("pulled"));
            }
            drop(inside);
            if now >= until {
                return Ok(0);
            }
            // A tenth of a millisecond of ours.
            clock::sleep(Duration::from_micros(100) * HASTE);
        }
    }
}
