//! From a message to frames.

use heapless::Vec;

use super::{CARRIED, CRC_16, FIRST, NEXT, Sender, WHOLE, check_of};
use crate::can::BusFrame;
use crate::command::{Packet, SEALED, SHORT};

/// The frames of `ROOM` bytes that carry a message.
pub struct Frames<const ROOM: usize> {
    id: u16,
    bytes: Vec<u8, CARRIED>,
    at: usize,
    sequence: u8,
}

/// Puts a message of `sender` into frames, classic ones or those of CAN FD.
#[must_use]
pub fn frames<const ROOM: usize>(sender: Sender, packet: &Packet) -> Frames<ROOM> {
    let mut bytes = Vec::new();
    let short = packet.bytes.len() <= SHORT && packet.id & SEALED == 0;
    // There is room for the longest packet and its four further bytes.
    if !short {
        let _ = bytes.extend_from_slice(&packet.id.to_le_bytes());
    }
    let _ = bytes.extend_from_slice(&packet.bytes);
    if short {
        let _ = bytes.resize(SHORT, 0);
        let _ = bytes.push(check_of(packet.id, &bytes));
    } else {
        let _ = bytes.extend_from_slice(&CRC_16.checksum(&bytes).to_le_bytes());
    }
    Frames {
        id: if short { packet.id } else { sender.long_id() },
        bytes,
        at: 0,
        sequence: 0,
    }
}

impl<const ROOM: usize> Iterator for Frames<ROOM> {
    type Item = BusFrame<ROOM>;

    fn next(&mut self) -> Option<Self::Item> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = self.bytes.len();
        if length <= 8 {
            let frame = BusFrame::new(self.id, rest);
            self.at = length;
            return frame;
        }
        let [high, low] = u16::try_from(length).unwrap_or(0).to_be_bytes();
        let head: &[u8] = if self.at > 0 {
            &[NEXT | (self.sequence & 0x0f)]
        } else if length.saturating_add(2) <= ROOM {
            &[WHOLE, low]
        } else {
            &[FIRST | high, low]
        };
        let carried = ROOM.saturating_sub(head.len()).min(rest.len());
        let mut data: Vec<u8, ROOM> = Vec::new();
        data.extend_from_slice(head).ok()?;
        data.extend_from_slice(rest.get(..carried)?).ok()?;
        if data.len() < 8 {
            data.resize(8, 0).ok()?;
        }
        self.at = self.at.saturating_add(carried);
        self.sequence = self.sequence.wrapping_add(1);
        BusFrame::new(self.id, &data)
    }
}
