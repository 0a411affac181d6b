//! Messages over a byte stream: packets in the frames of [`crate::protocol::link`], with their CRC-32
//! and sequence numbers.

use crate::protocol::link::{Link, Opening};

use super::Packet;

/// One end of such a stream.
pub type Letters = Link<72>;

/// Identifiers of the two messages that say that their sender lives.
const BEATS: [u16; 2] = [0x020, 0x110];

impl Opening for Packet {
    /// A sender that has started anew shows that it lives before it says anything else, and its
    /// numbers start anew with that. What arrives twice for it is not done twice: commands have
    /// names.
    fn opens(&self) -> bool {
        BEATS.contains(&self.id)
    }
}
