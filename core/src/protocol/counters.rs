//! What has become of frames, counted by kind.

use serde::{Deserialize, Serialize};

/// What has become of frames since the start. Every counter stops at its largest value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counters {
    /// Frames that were taken.
    pub received: u32,
    /// Frames that were written.
    pub sent: u32,
    /// Dropped: the stuffing was broken or the frame was cut short.
    pub malformed: u32,
    /// Dropped: the CRC did not match.
    pub corrupt: u32,
    /// Dropped: longer than the receive buffer.
    pub oversized: u32,
    /// Dropped: sound, but not a message of this schema.
    pub undecodable: u32,
    /// Dropped: the same sequence number as the frame before.
    pub duplicated: u32,
    /// Dropped: older than the frame before.
    pub reordered: u32,
    /// Frames that never came, by the gaps in the sequence numbers.
    pub missed: u32,
    /// Frames of our own for which there was no room.
    pub unsent: u32,
    /// Dropped: not by somebody who has the key, or not of this conversation.
    pub unauthentic: u32,
}

impl Counters {
    /// Nothing has happened yet.
    pub const ZERO: Self = Self {
        received: 0,
        sent: 0,
        malformed: 0,
        corrupt: 0,
        oversized: 0,
        undecodable: 0,
        duplicated: 0,
        reordered: 0,
        missed: 0,
        unsent: 0,
        unauthentic: 0,
    };

    /// How many received frames were dropped, whatever the reason.
    #[must_use]
    pub fn dropped(&self) -> u32 {
        [
            self.malformed,
            self.corrupt,
            self.oversized,
            self.undecodable,
            self.duplicated,
            self.reordered,
            self.unauthentic,
        ]
        .iter()
        .fold(0, |sum, n| sum.saturating_add(*n))
    }
}

/// Counts one more, up to the largest number.
pub(super) fn count(counter: &mut u32) {
    *counter = counter.saturating_add(1);
}
