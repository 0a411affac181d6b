//! Who may talk to the unit: with a key, only a host that has shown to have it.

use crate::protocol::link::Link;
use crate::protocol::message::Proof;
use crate::protocol::seal::Nonces;

/// What makes every challenge a new one.
#[derive(Debug)]
pub(super) struct Trust {
    /// Tells this start from others.
    pub boot: u32,
    /// How many conversations were opened.
    greetings: u32,
}

impl Trust {
    /// Of a unit that has just started.
    pub const fn new(boot: u32) -> Self {
        Self { boot, greetings: 0 }
    }

    /// What this unit has never said before.
    fn nonce(&self) -> u64 {
        u64::from(self.boot).wrapping_shl(32) | u64::from(self.greetings)
    }

    /// What whoever has said Hello is to prove the key of this link with; `None` where there is no key.
    pub fn challenge<const FRAME: usize>(&mut self, link: &Link<FRAME>) -> Option<u64> {
        self.greetings = self.greetings.wrapping_add(1);
        link.is_shut().then(|| self.nonce())
    }

    /// Seals the link when the proof is right.
    pub fn accepts<const FRAME: usize>(&self, link: &mut Link<FRAME>, proof: &Proof) -> bool {
        let nonces = Nonces {
            unit: self.nonce(),
            host: proof.nonce,
        };
        // One proof per challenge: a conversation that is sealed is not sealed again.
        let proven = link.is_shut()
            && self.greetings > 0
            && link
                .key()
                .is_some_and(|key| key.is_proof(nonces, &proof.proof));
        if proven {
            link.seal(nonces);
        }
        proven
    }
}
