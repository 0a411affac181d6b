//! The form of a [`HandFrame`] on a sensor's serial line: 88 bytes, 94 with its framing, so that 120
//! frames/s take 11.3 kB/s and fit a line of 115,200 baud.
//!
//! Little end first:
//!
//! | bytes | what |
//! |---|---|
//! | 0 | bits 0..=4: which fingers are followed, thumb first; bit 5: right hand; bit 6: there is a hand; bit 7: 1, this version |
//! | 1..5 | time, us, u32, wraps |
//! | 5, 6, 7 | grab, pinch, confidence, each u8 / 255 |
//! | 8..14 | palm x, y, z, i16 of 0.1 mm |
//! | 14..20 | velocity x, y, z, i16 of 1 mm/s |
//! | 20..23 | normal x, y, z, i8 / 127 |
//! | 23..26 | direction x, y, z, i8 / 127 |
//! | 26..88 | 45 numbers of 11 bits, two's complement, of 0.1 mm, lowest bit first: for each finger knuckle - palm, middle - knuckle, tip - middle, each x, y, z; one bit stays 0 |
//!
//! Parts of a hand that is not there, or of a finger that is not followed, are 0 and ignored. Around
//! it goes the framing of the host link ([`super::line`]): CRC-32, COBS, a zero byte.

use super::bits::{Reader, Writer};
use super::frame::{FINGERS, Finger, FrameError, HandFrame, Part, Side};
use crate::protocol::stuffing;

/// Bytes of a frame before framing.
pub const PAYLOAD: usize = 88;

const BITS: u32 = 11;
const HALF: i32 = 1 << (BITS - 1);
const THERE: u8 = 1 << 6;
const RIGHT: u8 = 1 << 5;
const VERSION: u8 = 1 << 7;

/// What one frame of a sensor tells.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(
    clippy::large_enum_variant,
    reason = "without a heap there is nowhere to put the larger one"
)]
pub enum Sample {
    /// The sensor sees this hand.
    Hand(HandFrame),
    /// The sensor sees no hand at this time (us of its clock).
    Nothing(u32),
}

/// Why bytes gave no [`Sample`], or a sample no bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WireError {
    /// The framing is broken: bytes were lost, the speed of the line is wrong, or the other end
    /// speaks something else.
    Framing(stuffing::FrameError),
    /// Not 88 bytes.
    Length(u8),
    /// Another version of this form; the first byte is given.
    Version(u8),
    /// What the frame says cannot be.
    Frame(FrameError),
}

/// Puts a sample into its 88 bytes.
///
/// # Errors
/// [`WireError::Frame`] for a frame that fails [`HandFrame::check`] or whose joints lie more than
/// 102.3 mm apart along an axis ([`FrameError::OutOfRange`]), as those of no hand do.
pub fn encode(sample: &Sample) -> Result<[u8; PAYLOAD], WireError> {
    let mut out = Writer::new();
    let frame = match sample {
        Sample::Nothing(time) => {
            out.bits(u32::from(VERSION), 8);
            out.bits(*time, 32);
            return Ok(out.bytes);
        }
        Sample::Hand(frame) => frame,
    };
    frame.check().map_err(WireError::Frame)?;
    let mut header = VERSION | THERE;
    if frame.side == Side::Right {
        header |= RIGHT;
    }
    for (i, finger) in frame.fingers.iter().enumerate() {
        header |= u8::from(finger.is_some()).wrapping_shl(i as u32);
    }
    out.bits(u32::from(header), 8);
    out.bits(frame.time, 32);
    for share in [frame.grab, frame.pinch, frame.confidence] {
        out.bits(round(share * 255.0) as u32, 8);
    }
    let palm = frame.palm.map(tenths);
    for n in palm.into_iter().chain(frame.velocity.map(round)) {
        out.bits(n as u32, 16);
    }
    for n in frame.normal.into_iter().chain(frame.direction) {
        out.bits(round(n * 127.0).clamp(-127, 127) as u32, 8);
    }
    for (finger, number) in frame.fingers.iter().zip(0..) {
        let mut from = palm;
        let finger = finger.as_ref();
        for joint in [
            finger.map(|f| f.knuckle),
            finger.map(|f| f.middle),
            finger.map(|f| f.tip),
        ] {
            let to = joint.map_or(from, |point| point.map(tenths));
            for (a, b) in to.into_iter().zip(from) {
                let step = a.wrapping_sub(b);
                if !(-HALF..HALF).contains(&step) {
                    return Err(WireError::Frame(FrameError::OutOfRange(Part::Finger(
                        number,
                    ))));
                }
                out.bits(step as u32, BITS);
            }
            from = to;
        }
    }
    Ok(out.bytes)
}

/// Reads a sample from its 88 bytes. Never part of its caller, whose stack what it works with would lie on for as long as
/// the sample is looked at.
///
/// # Errors
/// [`WireError`] for anything that [`encode`] does not give.
#[inline(never)]
pub fn decode(bytes: &[u8]) -> Result<Sample, WireError> {
    let length = || WireError::Length(u8::try_from(bytes.len()).unwrap_or(u8::MAX));
    let bytes: &[u8; PAYLOAD] = bytes.try_into().map_err(|_| length())?;
    let mut input = Reader::new(bytes);
    let header = input.bits(8) as u8;
    if header & VERSION == 0 {
        return Err(WireError::Version(header));
    }
    let time = input.bits(32);
    if header & THERE == 0 {
        return Ok(Sample::Nothing(time));
    }
    let [grab, pinch, confidence] = core::array::from_fn(|_| input.bits(8) as f32 / 255.0);
    let palm: [i32; 3] = core::array::from_fn(|_| input.signed(16));
    let velocity = core::array::from_fn(|_| input.signed(16) as f32);
    let normal = core::array::from_fn(|_| input.signed(8) as f32 / 127.0);
    let direction = core::array::from_fn(|_| input.signed(8) as f32 / 127.0);
    let mut fingers = [None; FINGERS];
    for (i, finger) in fingers.iter_mut().enumerate() {
        let mut at = palm;
        let [knuckle, middle, tip] = core::array::from_fn(|_| {
            at = at.map(|n| n.wrapping_add(input.signed(BITS)));
            at.map(|n| n as f32 / 10.0)
        });
        if header.wrapping_shr(i as u32) & 1 == 1 {
            *finger = Some(Finger {
                knuckle,
                middle,
                tip,
            });
        }
    }
    let frame = HandFrame {
        time,
        side: if header & RIGHT == 0 {
            Side::Left
        } else {
            Side::Right
        },
        confidence,
        grab,
        pinch,
        palm: palm.map(|n| n as f32 / 10.0),
        velocity,
        normal,
        direction,
        fingers,
    };
    frame.check().map_err(WireError::Frame)?;
    Ok(Sample::Hand(frame))
}

/// Tenths of a millimetre; a checked coordinate has at most 32,767 of them.
fn tenths(x: f32) -> i32 {
    round(x * 10.0)
}

/// The nearest whole number, halves away from 0; what does not fit saturates.
fn round(x: f32) -> i32 {
    (x + if x < 0.0 { -0.5 } else { 0.5 }) as i32
}

#[cfg(test)]
mod tests;
