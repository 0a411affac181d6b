//! A sealed conversation: what is said under one pair of nonces, counted.

use heapless::Vec;

use super::{COUNTER, SEALED};
use crate::command::{LONGEST, Packet};
use crate::protocol::seal::{Key, Nonces, Seal, TAG, Way, same};

/// What both have said since a challenge was answered.
#[derive(Debug)]
pub(super) struct Conversation {
    seal: Seal,
    next: u64,
    expected: u64,
}

/// Why a message is not taken.
pub(super) enum Why {
    Unsealed,
    Forged,
    Replayed,
}

impl Conversation {
    pub(super) fn new(key: Key, nonces: Nonces, way: Way) -> Self {
        Self {
            seal: Seal::new(key, nonces, way),
            next: 0,
            expected: 0,
        }
    }

    /// The message with its seal; none when it is too long for one, which no message is.
    pub(super) fn seal(&mut self, packet: &Packet, tag: usize) -> Option<Packet> {
        let (counter, way) = (self.next, self.seal.way());
        self.next = counter.wrapping_add(1);
        let whole = self.tag(way, counter, packet.id, &packet.bytes);
        let mut bytes: Vec<u8, LONGEST> = packet.bytes.clone();
        let [low, high, ..] = counter.to_le_bytes();
        bytes.extend_from_slice(&[low, high]).ok()?;
        bytes.extend_from_slice(whole.get(..tag)?).ok()?;
        let id = packet.id | SEALED;
        Some(Packet { id, bytes })
    }

    /// The message under the seal, when it is the other side's and newer than all before.
    pub(super) fn open(&mut self, packet: &Packet, tag: usize) -> Result<Packet, Why> {
        let room = COUNTER.saturating_add(tag);
        let length = packet.bytes.len().checked_sub(room).ok_or(Why::Forged)?;
        let (bytes, mark) = packet.bytes.split_at_checked(length).ok_or(Why::Forged)?;
        let (low, claimed) = mark.split_first_chunk().ok_or(Why::Forged)?;
        // The number that is nearest to the expected one, as a replay is behind it.
        let ahead = u16::from_le_bytes(*low).wrapping_sub(self.expected as u16) as i16;
        let counter = self.expected.wrapping_add_signed(i64::from(ahead));
        let id = packet.id & !SEALED;
        let whole = self.tag(self.seal.way().back(), counter, id, bytes);
        if !whole.get(..tag).is_some_and(|tag| same(tag, claimed)) {
            return Err(Why::Forged);
        }
        if ahead < 0 {
            return Err(Why::Replayed);
        }
        self.expected = counter.wrapping_add(1);
        let bytes = Vec::from_slice(bytes).map_err(|_| Why::Forged)?;
        Ok(Packet { id, bytes })
    }

    fn tag(&mut self, way: Way, counter: u64, id: u16, bytes: &[u8]) -> [u8; TAG] {
        self.seal.tag(way, counter, [&id.to_le_bytes(), bytes])
    }
}
