//! Messages in classic CAN frames of eight bytes.
//!
//! A message of at most [`SHORT`] bytes goes in a frame of its own identifier: its bytes, zeros up to
//! the seventh, and a CRC-8 over identifier and bytes. CAN's own CRC ends where a serial adapter's
//! text begins, so what can move an arm has one of its own.
//!
//! A longer one, or one that is sealed, goes in frames of its sender's long identifier, segmented as in ISO 15765-2: first
//! `0x1LLL` and six bytes, then `0x2S` and seven bytes each, `LLL` being the length of what is
//! carried and `S` a number that rises from 1 and wraps after 15. There is no flow control: every
//! receiver has room for the longest message, ten frames. Carried are the message's identifier in two
//! bytes, little end first, its bytes, and a CRC-16 over both, little end first.

use crc::{CRC_8_SAE_J1850, CRC_16_IBM_3740, Crc, NoTable};
use heapless::Vec;

use super::message::{FromRobot, Layout, ToRobot};
use super::seal::SEALED;
use super::{LONGEST, Packet, SHORT};
use crate::can::Frame;

const CRC_8: Crc<u8, NoTable> = Crc::<u8, NoTable>::new(&CRC_8_SAE_J1850);
const CRC_16: Crc<u16, NoTable> = Crc::<u16, NoTable>::new(&CRC_16_IBM_3740);

/// What a long message carries at most: identifier, bytes, CRC.
const CARRIED: usize = LONGEST + 4;

const FIRST: u8 = 0x10;
const NEXT: u8 = 0x20;

/// Who sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sender {
    /// The bridge.
    Host,
    /// The robot.
    Robot,
}

impl Sender {
    /// The identifier of the frames that carry its long messages.
    #[must_use]
    pub const fn long_id(self) -> u16 {
        match self {
            Self::Host => 0x018,
            Self::Robot => 0x118,
        }
    }

    /// Its messages.
    #[must_use]
    pub const fn layouts(self) -> &'static [Layout] {
        match self {
            Self::Host => ToRobot::LAYOUTS,
            Self::Robot => FromRobot::LAYOUTS,
        }
    }
}

fn check_of(id: u16, bytes: &[u8]) -> u8 {
    let mut digest = CRC_8.digest();
    digest.update(&id.to_le_bytes());
    digest.update(bytes);
    digest.finalize()
}

/// The frames that carry a message.
pub struct Frames {
    id: u16,
    bytes: Vec<u8, CARRIED>,
    at: usize,
    sequence: u8,
}

/// Puts a message of `sender` into frames.
#[must_use]
pub fn frames(sender: Sender, packet: &Packet) -> Frames {
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

impl Iterator for Frames {
    type Item = Frame;

    fn next(&mut self) -> Option<Frame> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        if self.bytes.len() <= 8 {
            let frame = Frame::new(self.id, rest);
            self.at = self.bytes.len();
            return frame;
        }
        let length = u16::try_from(self.bytes.len()).unwrap_or(0).to_be_bytes();
        let mut data = [0; 8];
        let head: &[u8] = if self.at == 0 {
            &[FIRST | length[0], length[1]]
        } else {
            &[NEXT | (self.sequence & 0x0f)]
        };
        let places = data.iter_mut();
        for (to, from) in places.zip(head.iter().chain(rest)) {
            *to = *from;
        }
        let carried = data.len().saturating_sub(head.len());
        self.at = self.at.saturating_add(carried);
        self.sequence = self.sequence.wrapping_add(1);
        Frame::new(self.id, &data)
    }
}

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
    pub fn take(&mut self, frame: &Frame) -> Option<Result<Packet, ParcelError>> {
        let id = frame.id();
        if id == self.sender.long_id() {
            return self.take_long(frame.data()).transpose();
        }
        let layout = self.sender.layouts().iter().find(|l| l.id == id)?;
        let length = layout.bytes();
        if length > SHORT {
            return Some(Err(ParcelError::Length));
        }
        let Some((content, [check])) = frame.data().split_first_chunk::<SHORT>() else {
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
            FIRST => {
                let interrupted = self.wanted > 0;
                let (low, rest) = rest.split_first().ok_or(ParcelError::Length)?;
                self.bytes.clear();
                self.wanted = usize::from(u16::from_be_bytes([head & 0x0f, *low]));
                self.sequence = 1;
                if self.wanted <= 8 || self.wanted > CARRIED {
                    self.wanted = 0;
                    return Err(ParcelError::Length);
                }
                let _ = self.bytes.extend_from_slice(rest);
                return if interrupted {
                    Err(ParcelError::Gap)
                } else {
                    Ok(None)
                };
            }
            NEXT if self.wanted > 0 && head & 0x0f == self.sequence & 0x0f => rest,
            _ => {
                self.wanted = 0;
                return Err(ParcelError::Gap);
            }
        };
        self.sequence = self.sequence.wrapping_add(1);
        let left = self.wanted.saturating_sub(self.bytes.len());
        let carried = carried.get(..carried.len().min(left)).unwrap_or(&[]);
        let _ = self.bytes.extend_from_slice(carried);
        if self.bytes.len() < self.wanted {
            return Ok(None);
        }
        self.wanted = 0;
        self.complete().map(Some)
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
