//! What the unit hears and says, and what must hold of that.

use deictic_core::board::ToHost;
use deictic_core::decide::Outcome;
use deictic_core::protocol::message::Loaded;
use deictic_core::time::Micros;
use deictic_core::unit::{HEARTBEAT, HOST_LOST};

use super::Host;

impl Host {
    /// Gives the unit up to `n` bytes of what was said.
    pub(super) fn deliver(&mut self, n: usize) {
        let n = n.min(self.line.len());
        let bytes: Vec<u8> = self.line.drain(..n).collect();
        let before = self.unit.statistics().link.received;
        self.unit.receive(self.now, &bytes);
        if self.unit.statistics().link.received != before {
            self.spoke = self.now;
        }
    }

    /// Takes up to `n` bytes of what the unit said, and holds it against what may be said.
    pub(super) fn listen(&mut self, n: usize) {
        let waiting = self.unit.outgoing();
        let bytes = waiting[..n.min(waiting.len())].to_vec();
        self.unit.sent(bytes.len());
        for byte in bytes {
            if let Some(heard) = self.ear.receive::<ToHost>(byte) {
                self.hear(heard.message);
            }
        }
        // A Hello cuts short what was being said; nothing else does.
        let counters = self.ear.counters();
        assert!(counters.malformed + counters.corrupt <= self.hellos);
        assert_eq!((counters.undecodable, counters.oversized), (0, 0));
    }

    pub(super) fn hear(&mut self, message: ToHost) {
        match message {
            ToHost::Hello(_) => {
                self.loaded = None;
                self.scene = 0;
                self.open = true;
                self.cut = true;
            }
            ToHost::Loaded(Loaded::Vocabulary(fingerprint)) => {
                self.loaded = Some(fingerprint);
                self.scene = 0;
            }
            ToHost::Loaded(Loaded::Scene(version)) => {
                assert!(version > self.scene);
                self.scene = version;
            }
            ToHost::Decision(decided) => {
                // Whoever has not been greeted, or has fallen silent, hears no decision.
                assert!(self.open);
                // What did not fit the outbox was not said, and shows as a gap.
                let complete = self.unit.statistics().link.unsent == 0;
                assert!(decided.number > self.newest);
                assert!(!complete || self.cut || decided.number == self.newest + 1);
                self.cut = false;
                self.newest = decided.number;
                self.decisions += 1;
                if let Outcome::Execute(intent) = &decided.decision.outcome {
                    let stop = self.vocabulary.stop() == Some(intent.action);
                    assert!(usize::from(intent.action) < self.vocabulary.actions().len());
                    assert!(!complete || Some(decided.vocabulary) == self.loaded);
                    assert!(!complete || decided.scene == self.scene);
                    assert!(stop || decided.scene > 0, "nothing moves without a scene");
                }
            }
            ToHost::Heartbeat(beat) => assert!(beat.now <= self.now),
            ToHost::Statistics(statistics) => {
                let decided = statistics.executes + statistics.asks + statistics.repeats;
                assert!(decided >= self.decisions);
            }
            _ => {}
        }
        if self.open && self.unit.next_wake() != Micros::NEVER {
            assert!(self.unit.next_wake() <= self.now.after(HOST_LOST.max(HEARTBEAT)));
        }
    }
}
