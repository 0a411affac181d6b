//! Messages in CAN frames: classic ones of eight bytes, or those of CAN FD, of up to 64.
//!
//! A message of at most [`SHORT`](super::SHORT) bytes goes in a frame of its own identifier: its bytes, zeros up to
//! the seventh, and a CRC-8 over identifier and bytes. CAN's own CRC ends where a serial adapter's
//! text begins, so what can move an arm has one of its own.
//!
//! A longer one, or one that is sealed, goes in frames of its sender's long identifier, segmented as in ISO 15765-2: first
//! `0x1LLL` and six bytes, then `0x2S` and seven bytes each, `LLL` being the length of what is
//! carried and `S` a number that rises from 1 and wraps after 15. There is no flow control: every
//! receiver has room for the longest message, ten frames. Carried are the message's identifier in two
//! bytes, little end first, its bytes, and a CRC-16 over both, little end first.
//!
//! With CAN FD what is carried goes in one frame where it fits: `0x00`, its length and up to 62 bytes (the same standard's
//! single frame). Two more bytes need `0x1LLL` and 62 bytes first, then `0x2S` and the rest. Zeros fill a frame up to a
//! length that there is. Short messages have the same eight bytes as in classic frames.

mod assembler;
mod frames;

use crc::{CRC_8_SAE_J1850, CRC_16_IBM_3740, Crc, NoTable};

use super::LONGEST;
use super::message::{FromRobot, Layout, ToRobot};

pub use assembler::{Assembler, ParcelError};
pub use frames::{Frames, frames};

const CRC_8: Crc<u8, NoTable> = Crc::<u8, NoTable>::new(&CRC_8_SAE_J1850);
const CRC_16: Crc<u16, NoTable> = Crc::<u16, NoTable>::new(&CRC_16_IBM_3740);

/// What a long message carries at most: identifier, bytes, CRC.
const CARRIED: usize = LONGEST + 4;

const WHOLE: u8 = 0x00;
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
