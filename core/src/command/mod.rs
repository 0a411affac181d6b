//! The command set between the bridge and a robot: small messages with a fixed layout of whole bytes,
//! little end first, so that they fit classic CAN frames and a DBC file can describe every one.
//!
//! * [`message`]: what is said, and the layouts that the DBC file is made from.
//! * [`field`]: how a value lies in a message.
//! * [`code`]: numbered choices: motions, reasons, faults.
//! * [`parcel`]: messages in CAN frames, long ones in several of them.
//! * [`letter`]: messages over a byte stream, in the frames of [`crate::protocol`].
//!
//! What each side must do, and within which bounds, is written down in `docs/robot.md`.

pub mod code;
pub mod field;
pub mod letter;
pub mod message;
pub mod parcel;
pub mod seal;

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::time::Micros;

/// Bytes of the longest message with its seal.
pub const LONGEST: usize = 56 + seal::ROOM;

/// Bytes of the longest message that goes into one classic CAN frame, whose last byte is a check.
pub const SHORT: usize = 7;

/// Added to the identifier of a message that is sealed ([`seal`]).
pub const SEALED: u16 = 0x8000;

/// How often either side shows that it lives.
pub const BEAT: Micros = Micros::from_millis(100);

/// After how long without the host's [`message::HostBeat`] a robot stops.
pub const HOST_LOST: Micros = Micros::from_millis(350);

/// After how long without a [`message::RobotBeat`] a robot counts as lost.
pub const ROBOT_LOST: Micros = Micros::from_millis(500);

/// A message as it lies in a frame.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Packet {
    /// Which message: its CAN identifier.
    pub id: u16,
    /// Its values, one behind the other.
    pub bytes: Vec<u8, LONGEST>,
}

/// Why a packet is not a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PacketError {
    /// No message of this direction has this identifier.
    UnknownMessage(u16),
    /// It is shorter or longer than its message.
    Length {
        /// Which message.
        id: u16,
        /// How many bytes came.
        got: usize,
    },
    /// A value is none that it can have.
    Value(u16),
}
