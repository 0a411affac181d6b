//! The one contract between unit and host: messages, frames, sequence numbers, versions.
//!
//! A frame is, before stuffing, `postcard(sequence: u16, message: Message)` and the CRC-32/ISO-HDLC
//! of those bytes, little end first; the whole is COBS-stuffed and ended by a zero byte, so that a
//! receiver that lost its place finds it again at the next zero.
//!
//! * [`message`]: what is said; [`hand`]: what is said about hands.
//! * [`stuffing`]: bytes to frames and back.
//! * [`link`]: one end of a link: sequence numbers and a counter for every kind of lost frame.
//! * [`seal`]: with a key, a tag on every frame.

mod counters;
pub mod hand;
pub mod link;
mod lock;
pub mod message;
pub mod seal;
pub mod stuffing;

/// The version of the protocol; it changes with every change of [`SCHEMA`].
pub const VERSION: u16 = 1;

/// A digest of how every message is put into bytes: the CRC-32 over the golden frames in
/// `tests/expected/frames-v1.txt`. A test holds it to them, so that a change of any message's form
/// cannot go unnoticed, and both ends exchange it in their Hello.
pub const SCHEMA: u32 = 0x88db_4528;
