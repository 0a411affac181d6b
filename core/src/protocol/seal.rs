//! Who may talk: with a key, every frame carries a tag that only its holders can make, over a counter that never comes
//! again, so that neither an invented frame nor a recorded one is taken. docs/threat-model.md says against whom.
//!
//! The tag is HMAC-SHA-256 (RFC 2104), cut to eight bytes, by RustCrypto's `hmac` and `sha2`. On a Cortex-M4 it takes
//! 2.8 KB of flash and two compressions for a frame of up to 30 bytes; CMAC-AES-128 by the same authors takes 5.1 KB, and
//! keyed BLAKE2s 3.3 KB with panics in it.

use core::fmt;

use hmac::{Hmac, Mac};
use sha2::Sha256;

/// Bytes of a key.
pub const KEY: usize = 32;

/// Bytes of a tag: a guess is right once in 1.8e19, and a line takes 10,000 of them a second at most.
pub const TAG: usize = 8;

/// What both ends share, and nobody else has.
#[derive(Clone)]
pub struct Key(Hmac<Sha256>);

impl fmt::Debug for Key {
    /// Says nothing of it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Key")
    }
}

/// Which way a frame goes: one that is sent back to where it came from is not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// From the host to the unit.
    ToUnit,
    /// From the unit to the host.
    ToHost,
    /// From the host to a robot.
    ToRobot,
    /// From a robot to the host.
    FromRobot,
}

impl Way {
    const fn code(self) -> u8 {
        match self {
            Self::ToUnit => 1,
            Self::ToHost => 2,
            Self::ToRobot => 3,
            Self::FromRobot => 4,
        }
    }

    pub(crate) const fn back(self) -> Self {
        match self {
            Self::ToUnit => Self::ToHost,
            Self::ToHost => Self::ToUnit,
            Self::ToRobot => Self::FromRobot,
            Self::FromRobot => Self::ToRobot,
        }
    }
}

/// What nobody has said before: each end gives one when a conversation opens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Nonces {
    /// The unit's, or the robot's.
    pub unit: u64,
    /// The host's.
    pub host: u64,
}

impl Key {
    /// The key of these bytes, which are to be as random as bytes can be.
    #[must_use]
    pub fn new(bytes: &[u8; KEY]) -> Option<Self> {
        // HMAC takes keys of any length; the library says so with a result.
        <Hmac<Sha256> as Mac>::new_from_slice(bytes).ok().map(Self)
    }

    /// What shows the unit that the host has the key, over both nonces.
    #[must_use]
    pub fn proof(&mut self, nonces: Nonces) -> [u8; TAG] {
        self.begin(b'P', nonces);
        self.finish()
    }

    /// Whether that has been shown; takes as long whatever the bytes.
    #[must_use]
    pub fn is_proof(&mut self, nonces: Nonces, proof: &[u8; TAG]) -> bool {
        same(&self.proof(nonces), proof)
    }

    /// Begins a tag, whatever was begun before.
    fn begin(&mut self, kind: u8, nonces: Nonces) {
        self.0.reset();
        self.0.update(&[kind]);
        self.0.update(&nonces.unit.to_le_bytes());
        self.0.update(&nonces.host.to_le_bytes());
    }

    /// Takes the next byte of what is tagged.
    pub(super) fn push(&mut self, byte: u8) {
        self.0.update(&[byte]);
    }

    /// The tag. In place, as a copy would take 200 bytes of the deepest stack.
    #[inline(never)]
    pub(super) fn finish(&mut self) -> [u8; TAG] {
        let whole = self.0.finalize_reset().into_bytes();
        let mut tag = [0; TAG];
        for (to, from) in tag.iter_mut().zip(whole) {
            *to = from;
        }
        tag
    }
}

/// One end's seal for one conversation.
#[derive(Clone, Debug)]
pub struct Seal {
    key: Key,
    nonces: Nonces,
    /// Which way this end's own frames go.
    way: Way,
}

impl Seal {
    /// The seal of a conversation with these nonces, at the end whose frames go this way.
    #[must_use]
    pub fn new(key: Key, nonces: Nonces, way: Way) -> Self {
        Self { key, nonces, way }
    }

    pub(super) fn key(&mut self) -> &mut Key {
        &mut self.key
    }

    pub(crate) fn way(&self) -> Way {
        self.way
    }

    /// Begins the tag of this end's frame number `counter`.
    pub(super) fn tagger(&mut self, counter: u64) -> &mut Key {
        self.begin(self.way, counter);
        &mut self.key
    }

    /// Whether `tag` is that of the other end's frame number `counter` with these contents.
    pub(super) fn is_sound(&mut self, counter: u64, contents: &[u8], tag: &[u8; TAG]) -> bool {
        same(&self.tag(self.way.back(), counter, [contents]), tag)
    }

    /// The tag of message number `counter` that goes `way`, of these contents one behind the other.
    pub(crate) fn tag<const N: usize>(
        &mut self,
        way: Way,
        counter: u64,
        contents: [&[u8]; N],
    ) -> [u8; TAG] {
        self.begin(way, counter);
        contents.iter().for_each(|part| self.key.0.update(part));
        self.key.finish()
    }

    fn begin(&mut self, way: Way, counter: u64) {
        self.key.begin(way.code(), self.nonces);
        self.key.0.update(&counter.to_le_bytes());
    }
}

/// Compares without telling by its time where the first difference is.
pub(crate) fn same(a: &[u8], b: &[u8]) -> bool {
    if a.len() != b.len() {
        return false;
    }
    let difference = a.iter().zip(b).fold(0, |all, (a, b)| all | (a ^ b));
    core::hint::black_box(difference) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tag_is_hmac_sha_256() {
        // RFC 4231, test case 2, with its key filled up with zeros, which HMAC does itself.
        let mut bytes = [0; KEY];
        bytes[..4].copy_from_slice(b"Jefe");
        let mut key = Key::new(&bytes).unwrap();
        for _ in 0..2 {
            for byte in b"what do ya want for nothing?" {
                key.push(*byte);
            }
            assert_eq!(
                key.finish(),
                [0x5b, 0xdc, 0xc1, 0x46, 0xbf, 0x60, 0x75, 0x4e]
            );
        }
    }

    #[test]
    fn another_key_nonce_way_or_counter_makes_another_tag() {
        let key = |b| Key::new(&[b; KEY]).unwrap();
        let nonces = Nonces { unit: 1, host: 2 };
        let mut host = Seal::new(key(7), nonces, Way::ToUnit);
        let tag = {
            let tagger = host.tagger(9);
            b"go".iter().for_each(|b| tagger.push(*b));
            tagger.finish()
        };
        let unit = |key, nonces| Seal::new(key, nonces, Way::ToHost);
        assert!(unit(key(7), nonces).is_sound(9, b"go", &tag));
        assert!(!unit(key(7), nonces).is_sound(10, b"go", &tag));
        assert!(!unit(key(7), nonces).is_sound(9, b"no", &tag));
        assert!(!unit(key(8), nonces).is_sound(9, b"go", &tag));
        assert!(!unit(key(7), Nonces { unit: 3, ..nonces }).is_sound(9, b"go", &tag));
        // Sent back to where it came from.
        assert!(!host.is_sound(9, b"go", &tag));
        assert!(key(7).is_proof(nonces, &key(7).proof(nonces)));
        assert!(!key(7).is_proof(nonces, &key(8).proof(nonces)));
    }
}
