//! The unit at the end of its line, and all that happens there.

use std::collections::BTreeMap;

use deictic_core::board::Unit;
use deictic_core::decide::Outcome;
use deictic_core::large::{Intent, ToHost};
use deictic_core::protocol::seal::Key;
use deictic_core::time::Micros;

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
    pub(super) unit: Box<Unit>,
    pub(super) boots: u32,
    /// How far the unit's clock is ahead.
    pub(super) ahead: Micros,
    /// Until when the unit does nothing at all.
    pub(super) frozen: Micros,
    /// Until when the cable is out.
    pub(super) pulled: Micros,
    /// Up to when all has happened.
    pub(super) now: Micros,
    /// Bytes that a full line takes at a time.
    pub(super) width: usize,
    /// What goes to the unit.
    pub to_unit: Line,
    /// What comes from it.
    pub to_host: Line,
    pub(super) ear: Ear,
    /// The key of unit and host, where they have one.
    pub(super) key: Option<Key>,
    /// What each start of the unit has told, by the number of the decision.
    pub told: BTreeMap<(u32, u32), Told>,
    /// When a frame that the host can take last came to it.
    pub heard: Micros,
    /// Reads what comes to the host, as the bridge does.
    pub(super) host_ear: Ear,
    /// The last execution whose frame came to the host, and when it did.
    pub arrived: Option<(Micros, Intent)>,
}

/// A unit that starts, with its key.
pub(super) fn start(boot: u32, key: Option<&Key>) -> Box<Unit> {
    let mut unit = Box::new(Unit::new(boot));
    if let Some(key) = key {
        unit.lock(key.clone());
    }
    unit
}

impl Inside {
    /// A unit that has just started, and a good line.
    pub(super) fn new(seed: u64, key: Option<Key>) -> Self {
        Self {
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
        }
    }

    /// When something happens next.
    pub(super) fn next(&self) -> Micros {
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
    pub(super) fn run(&mut self, until: Micros) {
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
    pub(super) fn listen(&mut self, now: Micros, bytes: &[u8]) {
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
