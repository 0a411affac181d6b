//! The unit at the end of its line, in simulated time.

use std::collections::BTreeMap;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard};
use std::time::{Duration, Instant};

use deictic::clock;
use deictic::link::Wire;
use deictic_core::board::Unit;
use deictic_core::decide::Outcome;
use deictic_core::large::{Intent, ToHost};
use deictic_core::protocol::seal::Key;
use deictic_core::time::Micros;

use super::around::Around;
use super::ear::Ear;
use super::line::{Faults, Line};

/// An execution that a unit has told.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// What to do.
    pub intent: Intent,
    /// On which scene it was decided.
    pub scene: u32,
}

/// What there is besides the bridge.
pub struct Inside {
    unit: Box<Unit>,
    boots: u32,
    /// How far the unit's clock is ahead.
    ahead: Micros,
    /// Until when the unit does nothing at all.
    frozen: Micros,
    /// Until when the cable is out.
    pulled: Micros,
    /// Up to when all has happened.
    now: Micros,
    /// Bytes that a full line takes at a time.
    width: usize,
    /// What goes to the unit.
    pub to_unit: Line,
    /// What comes from it.
    pub to_host: Line,
    ear: Ear,
    /// The key of unit and host, where they have one.
    key: Option<Key>,
    /// What each start of the unit has told, by the number of the decision.
    pub told: BTreeMap<(u32, u32), Told>,
    /// When a frame that the host can take last came to it.
    pub heard: Micros,
    /// Reads what comes to the host, as the bridge does.
    host_ear: Ear,
    /// The last execution whose frame came to the host, and when it did.
    pub arrived: Option<(Micros, Intent)>,
}

/// A handle on the world, which is also the bridge's wire to the unit.
#[derive(Clone)]
pub struct World {
    inside: Arc<Mutex<Inside>>,
    began: Instant,
}

/// A unit that starts, with its key.
fn start(boot: u32, key: Option<&Key>) -> Box<Unit> {
    let mut unit = Box::new(Unit::new(boot));
    if let Some(key) = key {
        unit.lock(key.clone());
    }
    unit
}

impl World {
    /// A unit that has just started, and a good line.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self::keyed(seed, None)
    }

    /// The same; unit and host have this key.
    #[must_use]
    pub fn keyed(seed: u64, key: Option<Key>) -> Self {
        let inside = Inside {
            unit: start(1, key.as_ref()),
            boots: 1,
            ahead: Micros(0),
            frozen: Micros(0),
            pulled: Micros(0),
            now: Micros(0),
            width: usize::MAX,
            to_unit: Line::new(seed ^ 1, Faults::NONE),
            to_host: Line::new(seed ^ 2, Faults::NONE),
            ear: Ear::default(),
            key,
            told: BTreeMap::new(),
            heard: Micros(0),
            host_ear: Ear::default(),
            arrived: None,
        };
        Self {
            inside: Arc::new(Mutex::new(inside)),
            began: clock::now(),
        }
    }

    /// Looks into it.
    ///
    /// # Panics
    /// When something panicked while it looked.
    pub fn inside(&self) -> MutexGuard<'_, Inside> {
        self.inside.lock().expect("nothing panicked in here")
    }

    /// Bytes that nobody sent come out of the line at both of its ends.
    pub fn disturb(&self, bytes: &[u8]) {
        let now = self.now();
        let mut inside = self.inside();
        inside.run(now);
        inside.to_unit.disturb(now, bytes);
        inside.to_host.disturb(now, bytes);
    }

    /// Bytes come on the unit's sensor line.
    pub fn sense(&self, bytes: &[u8]) {
        let now = self.now();
        let mut inside = self.inside();
        inside.run(now);
        let unit_now = now.after(inside.ahead);
        inside.unit.sense(unit_now, bytes);
    }
}

impl Around for World {
    fn opened(&self) {
        self.inside().host_ear = Ear::default();
    }

    fn now(&self) -> Micros {
        Micros(clock::since(self.began).as_micros() as u64)
    }

    fn set_faults(&self, faults: Faults) {
        let mut inside = self.inside();
        inside.to_unit.faults = faults;
        inside.to_host.faults = faults;
    }

    fn narrow(&self, width: usize) {
        self.inside().width = width.max(1);
    }

    fn restart(&self) {
        let mut inside = self.inside();
        inside.boots += 1;
        inside.unit = start(inside.boots, inside.key.as_ref());
        // What it was in the middle of saying is not the beginning of what it says now.
        inside.ear = Ear::default();
        inside.ahead = Micros(0);
        inside.to_unit.break_after(0);
    }

    fn freeze(&self, span: Micros) {
        let until = self.now().after(span);
        self.inside().frozen = until;
    }

    fn pull(&self, span: Micros, more: usize) {
        let until = self.now().after(span);
        let mut inside = self.inside();
        inside.pulled = until;
        inside.to_unit.break_after(more);
        inside.to_host.break_after(more);
    }

    fn jump(&self, span: Micros) {
        let mut inside = self.inside();
        inside.ahead = inside.ahead.after(span);
    }

    fn sleep(&self, span: Micros) {
        clock::sleep(Duration::from_micros(span.0));
    }

    fn heard(&self) -> Micros {
        self.inside().heard
    }

    fn redeem(&self, scene: u32, intent: &Intent) -> bool {
        let mut inside = self.inside();
        let found = inside
            .told
            .iter()
            .find(|(_, told)| told.scene == scene && told.intent == *intent);
        let number = found.map(|(number, _)| *number);
        number.is_some_and(|number| inside.told.remove(&number).is_some())
    }
}

impl Inside {
    /// When something happens next.
    fn next(&self) -> Micros {
        let wake = match self.unit.next_wake() {
            Micros::NEVER => Micros::NEVER,
            wake => Micros(wake.since(self.ahead).0).max(self.frozen),
        };
        let line = self
            .to_unit
            .next()
            .unwrap_or(Micros::NEVER)
            .max(self.frozen);
        let writes = match self.unit.outgoing() {
            [] => Micros::NEVER,
            _ => self.now.after(Micros::from_millis(1)),
        };
        wake.min(line).min(writes)
    }

    /// Lets everything happen up to `until`.
    fn run(&mut self, until: Micros) {
        loop {
            let next = self.next().max(self.now);
            if next > until {
                break;
            }
            // Time passes even where everything is due at once.
            self.now = next.max(self.now.after(Micros(1)));
            if self.now < self.frozen {
                continue;
            }
            let unit_now = self.now.after(self.ahead);
            let arrived = self.to_unit.take(self.now, usize::MAX);
            self.unit.receive(unit_now, &arrived.bytes);
            self.unit.poll(unit_now);
            let waiting = self.unit.outgoing();
            let bytes = waiting[..waiting.len().min(self.width)].to_vec();
            self.unit.sent(bytes.len());
            self.note(&bytes);
            if self.now >= self.pulled {
                self.to_host.write(self.now, &bytes);
            }
        }
        self.now = self.now.max(until);
    }

    /// Notes when something whole comes to the host, and the executions among it.
    fn listen(&mut self, now: Micros, bytes: &[u8]) {
        for &byte in bytes {
            let Some(message) = self.host_ear.hear(byte) else {
                continue;
            };
            self.heard = now;
            if let ToHost::Decision(decided) = message
                && let Outcome::Execute(intent) = decided.decision.outcome
            {
                self.arrived = Some((now, intent));
            }
        }
    }

    /// Remembers what the unit tells to be done.
    fn note(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            if let Some(ToHost::Decision(decided)) = self.ear.hear(byte)
                && let Outcome::Execute(intent) = decided.decision.outcome
            {
                let scene = decided.scene;
                // Larger capacities, the same form.
                let intent = Intent {
                    action: intent.action,
                    parameters: intent.parameters,
                };
                self.told
                    .insert((self.boots, decided.number), Told { intent, scene });
            }
        }
    }
}

impl Wire for World {
    fn key(&self) -> Option<Key> {
        self.inside().key.clone()
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        let now = self.now();
        let mut inside = self.inside();
        inside.run(now);
        if now < inside.pulled {
            return Err(io::Error::other("pulled"));
        }
        inside.to_unit.write(now, bytes);
        Ok(())
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        let until = self.now().after(Micros(patience.as_micros() as u64));
        loop {
            let now = self.now();
            let mut inside = self.inside();
            inside.run(now);
            let arrived = inside.to_host.take(now, buffer.len());
            if !arrived.bytes.is_empty() {
                inside.listen(now, &arrived.bytes);
                buffer[..arrived.bytes.len()].copy_from_slice(&arrived.bytes);
                return Ok(arrived.bytes.len());
            }
            if now < inside.pulled {
                return Err(io::Error::other("pulled"));
            }
            if now >= until {
                return Ok(0);
            }
            let comes = inside.to_host.next().unwrap_or(Micros::NEVER);
            let next = comes
                .min(inside.next())
                .max(now.after(Micros(1)))
                .min(until);
            drop(inside);
            clock::sleep(Duration::from_micros(next.since(now).0));
        }
    }
}
