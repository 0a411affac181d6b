//! Messages over a byte stream: packets in the frames of [`crate::protocol::link`], with their CRC-32
//! and sequence numbers.

use crate::protocol::link::{Link, Opening};

use super::{Packet, SEALED};

/// One end of such a stream.
pub type Letters = Link<80>;

/// Identifiers of the messages that a sender begins with: of both that say that it lives, and of the challenge.
const BEGIN: [u16; 3] = [0x020, 0x110, 0x11a];

impl Opening for Packet {
    /// A sender that has started anew shows that it lives before it says anything else, and its
    /// numbers start anew with that. What arrives twice for it is not done twice: commands have
    /// names.
    fn opens(&self) -> bool {
        BEGIN.contains(&(self.id & !SEALED))
    }
}
