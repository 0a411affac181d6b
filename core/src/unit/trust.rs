//! Who may talk to the unit: with a key, only a host that has shown to have it.

use super::Unit;
use crate::protocol::message::{Fault, Proof, ToHost};
use crate::protocol::seal::{Key, Nonces, Way};
use crate::time::Micros;

impl<
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
    const FRAME: usize,
    const OUT: usize,
    const S: usize,
> Unit<N, C, F, E, W, FRAME, OUT, S>
{
    /// From now on only a host that has the key is listened to. It is told after the unit's Hello what to prove it with.
    #[inline(never)]
    pub fn lock(&mut self, key: Key) {
        self.link.lock(key, Way::ToHost);
        self.open = false;
    }

    /// What this unit has never said before: `boot` tells its starts apart, the count its conversations.
    fn nonce(&self) -> u64 {
        u64::from(self.boot).wrapping_shl(32) | u64::from(self.greetings)
    }

    /// Asks whoever has said Hello for a proof. Nothing else is taken until it has come.
    pub(super) fn challenge(&mut self) {
        self.greetings = self.greetings.wrapping_add(1);
        if self.link.is_shut() {
            self.open = false;
            let nonce = self.nonce();
            self.send(&ToHost::Challenge(nonce));
        }
    }

    #[inline(never)]
    pub(super) fn take_proof(&mut self, now: Micros, proof: &Proof) {
        let nonces = Nonces {
            unit: self.nonce(),
            host: proof.nonce,
        };
        // One proof per challenge: a conversation that is sealed is not sealed again.
        let proven = self.link.is_shut()
            && self.greetings > 0
            && self
                .link
                .key()
                .is_some_and(|key| key.is_proof(nonces, &proof.proof));
        if !proven {
            self.fault(Fault::NotProven);
            return;
        }
        self.link.seal(nonces);
        self.open = true;
        self.heard = now;
        self.send(&ToHost::Proven);
    }
}
