//! From frames to messages.

use heapless::Vec;

use super::{CARRIED, CRC_16, FIRST, NEXT, Sender, WHOLE, check_of};
use crate::can::BusFrame;
use crate::command::{Packet, SHORT};

/// Why a frame did not lead to a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParcelError {
    /// A check does not match.
    Corrupt(u16),
    /// A frame of a long message is missing, and so is the message.
    Gap,
    /// A long message is longer than any there is, or shorter than it says.
    Length,
}

/// Makes messages out of frames.
#[derive(Debug)]
pub struct Assembler {
    sender: Sender,
    bytes: Vec<u8, CARRIED>,
    /// How many bytes the long message that is arriving has; 0 when none is.
    wanted: usize,
    sequence: u8,
}

impl Assembler {
    /// For what `sender` says.
    #[must_use]
    pub const fn new(sender: Sender) -> Self {
        Self {
            sender,
            bytes: Vec::new(),
            wanted: 0,
            sequence: 0,
        }
    }

    /// Takes a frame and gives the message that it completes. Frames of others on the bus give
    /// nothing.
    pub fn take<const ROOM: usize>(
        &mut self,
        frame: &BusFrame<ROOM>,
    ) -> Option<Result<Packet, ParcelError>> {
        let (id, data) = (frame.id(), frame.data());
        if id == self.sender.long_id() {
            return self.take_long(data).transpose();
        }
        let layout = self.sender.layouts().iter().find(|l| l.id == id)?;
        let length = layout.bytes();
        if length > SHORT {
            return Some(Err(ParcelError::Length));
        }
        let Some((content, [check])) = data.split_first_chunk::<SHORT>() else {
            return Some(Err(ParcelError::Length));
        };
        if *check != check_of(id, content) {
            return Some(Err(ParcelError::Corrupt(id)));
        }
        let bytes = Vec::from_slice(content.get(..length)?).ok()?;
        Some(Ok(Packet { id, bytes }))
    }

    fn take_long(&mut self, data: &[u8]) -> Result<Option<Packet>, ParcelError> {
        let (head, rest) = data.split_first().ok_or(ParcelError::Length)?;
        let carried = match head & 0xf0 {
            WHOLE => {
                let (length, rest) = rest.split_first().ok_or(ParcelError::Length)?;
                self.begin(usize::from(*length))?;
                if rest.len() < self.wanted {
                    self.wanted = 0;
                    return Err(ParcelError::Length);
                }
                rest
            }
            FIRST => {
                let interrupted = self.wanted > 0;
                let (low, rest) = rest.split_first().ok_or(ParcelError::Length)?;
                self.begin(usize::from(u16::from_be_bytes([head & 0x0f, *low])))?;
                if interrupted {
                    self.append(rest);
                    return Err(ParcelError::Gap);
                }
                rest
            }
            NEXT if self.wanted > 0 && head & 0x0f == self.sequence & 0x0f => rest,
            _ => {
                self.wanted = 0;
                return Err(ParcelError::Gap);
            }
        };
        self.append(carried);
        if self.bytes.len() < self.wanted {
            return Ok(None);
        }
        self.wanted = 0;
        self.complete().map(Some)
    }

    /// Begins a message that carries this many bytes.
    fn begin(&mut self, wanted: usize) -> Result<(), ParcelError> {
        self.bytes.clear();
        self.sequence = 0;
        let possible = wanted > 8 && wanted <= CARRIED;
        self.wanted = if possible { wanted } else { 0 };
        possible.then_some(()).ok_or(ParcelError::Length)
    }

    fn append(&mut self, carried: &[u8]) {
        self.sequence = self.sequence.wrapping_add(1);
        let left = self.wanted.saturating_sub(self.bytes.len());
        let carried = carried.get(..carried.len().min(left)).unwrap_or(&[]);
        let _ = self.bytes.extend_from_slice(carried);
    }

    fn complete(&self) -> Result<Packet, ParcelError> {
        let (body, crc) = self.bytes.split_last_chunk().ok_or(ParcelError::Length)?;
        let (id, bytes) = body.split_first_chunk().ok_or(ParcelError::Length)?;
        let id = u16::from_le_bytes(*id);
        if CRC_16.checksum(body) != u16::from_le_bytes(*crc) {
            return Err(ParcelError::Corrupt(id));
        }
        let bytes = Vec::from_slice(bytes).map_err(|_| ParcelError::Length)?;
        Ok(Packet { id, bytes })
    }
}
