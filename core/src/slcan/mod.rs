//! CAN over a serial line, in the text protocol of LAWICEL's CAN232 adapter that Linux's `slcan`,
//! `slcand` and python-can speak.
//!
//! | a client writes | an adapter answers |
//! |---|---|
//! | `S0`..`S8` CR: bit rate 10k to 1M; `s` and registers | CR |
//! | `O` CR: open; `L` CR: open, listen only; `C` CR: close | CR; a second `O` is well, as python-can sends it |
//! | `tIIIL` and data CR: send a frame | `z` CR when it was sent, BEL when not |
//! | `V`, `N`, `F` CR: version, serial number, status | `V1013`, `NDEIC`, `F00` and CR |
//!
//! Frames that arrive are written as `tIIIL` and data CR by the adapter unasked. Frames with 29-bit
//! identifiers and remote frames are none of ours: an adapter refuses to send them, a client passes
//! over them.

mod adapter;
mod lines;

pub use adapter::{Adapter, Wanted};
pub use lines::{BELL, CR, FRAME_LINE, Heard, Lines, line};
