//! Frames as lines of text, and what a client reads of them.

use heapless::Vec;

use crate::can::Frame;

/// Characters of the longest line: an extended frame of eight bytes with a time stamp.
const LINE: usize = 30;

/// A line's end, and an adapter's yes.
pub const CR: u8 = b'\r';

/// An adapter's no.
pub const BELL: u8 = 7;

/// Bytes of a frame's line at most: `tIIIL`, two for every byte, CR.
pub const FRAME_LINE: usize = 22;

/// A frame's line.
#[must_use]
pub fn line(frame: &Frame) -> Vec<u8, FRAME_LINE> {
    let mut line = Vec::new();
    let [high, low] = frame.id().to_be_bytes();
    let length = frame.data().len() as u8;
    let digits = [high & 0xf, low >> 4, low & 0xf, length];
    let data = frame.data().iter().flat_map(|byte| [byte >> 4, byte & 0xf]);
    // The longest frame fits exactly.
    let _ = line.push(b't');
    for digit in digits.into_iter().chain(data) {
        let _ = line.push(HEX.get(usize::from(digit)).copied().unwrap_or(b'0'));
    }
    let _ = line.push(CR);
    line
}

const HEX: &[u8; 16] = b"0123456789ABCDEF";

/// What a client of an adapter hears.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Heard {
    /// A frame from the bus.
    Frame(Frame),
    /// A line that carries a frame that is none of ours, or an answer.
    Other,
    /// The adapter did not do what was asked.
    Refused,
    /// A line that makes no sense: characters were lost or damaged.
    Damaged,
}

/// Collects characters into lines.
#[derive(Debug, Default)]
pub struct Lines {
    line: Vec<u8, LINE>,
    /// Whether the line is longer than any there is.
    overlong: bool,
}

impl Lines {
    /// At the beginning of a line.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            line: Vec::new(),
            overlong: false,
        }
    }

    /// Takes a character of what an adapter writes.
    pub fn hear(&mut self, character: u8) -> Option<Heard> {
        match character {
            BELL => {
                self.line.clear();
                self.overlong = false;
                Some(Heard::Refused)
            }
            CR => Some(
                self.end(|line| match line {
                    [b't', rest @ ..] => frame(rest).map_or(Heard::Damaged, Heard::Frame),
                    []
                    | [
                        b'z' | b'Z' | b'V' | b'v' | b'N' | b'F' | b'r' | b'T' | b'R',
                        ..,
                    ] => Heard::Other,
                    _ => Heard::Damaged,
                })
                .unwrap_or(Heard::Damaged),
            ),
            _ => {
                self.collect(character);
                None
            }
        }
    }

    pub(super) fn collect(&mut self, character: u8) {
        // A line feed behind a CR is some terminals' habit.
        if character != b'\n' && self.line.push(character).is_err() {
            self.overlong = true;
        }
    }

    /// Ends the line; `None` when it was too long.
    pub(super) fn end<T>(&mut self, read: impl FnOnce(&[u8]) -> T) -> Option<T> {
        let whole = !core::mem::take(&mut self.overlong);
        let read = whole.then(|| read(&self.line));
        self.line.clear();
        read
    }
}

fn digit(character: u8) -> Option<u8> {
    let digit = char::from(character).to_digit(16)?;
    u8::try_from(digit).ok()
}

/// Reads `IIIL`, the data, and a time stamp of four digits or none.
pub(super) fn frame(line: &[u8]) -> Option<Frame> {
    let ([a, b, c, length], rest) = line.split_first_chunk()?;
    let [a, b, c] = [digit(*a)?, digit(*b)?, digit(*c)?].map(u16::from);
    let length = usize::from(digit(*length)?);
    let mut data: Vec<u8, 8> = Vec::new();
    let (digits, stamp) = rest.split_at_checked(length.checked_mul(2)?)?;
    for pair in digits.chunks(2) {
        let [high, low] = pair else { return None };
        data.push(digit(*high)? << 4 | digit(*low)?).ok()?;
    }
    if !matches!(stamp.len(), 0 | 4) || stamp.iter().any(|c| digit(*c).is_none()) {
        return None;
    }
    Frame::new(a << 8 | b << 4 | c, &data)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec as List;

    #[test]
    fn a_client_hears_what_an_adapter_writes() {
        let mut lines = Lines::new();
        let mut heard =
            |text: &[u8]| -> List<Heard> { text.iter().filter_map(|c| lines.hear(*c)).collect() };
        for length in 0..=8 {
            let frame = Frame::new(0x7ff, &[0x5a; 8][..length]).unwrap();
            let line = line(&frame);
            assert_eq!(line.len(), 6 + 2 * length);
            assert_eq!(heard(&line), [Heard::Frame(frame)]);
        }
        let stamped = Frame::new(0x100, &[1]).unwrap();
        assert_eq!(heard(b"t1001010F3A\r"), [Heard::Frame(stamped)]);
        assert_eq!(
            heard(b"z\r\x07T000001000\rt1x\r\rgarbage\r"),
            [
                Heard::Other,
                Heard::Refused,
                Heard::Other,
                Heard::Damaged,
                Heard::Other,
                Heard::Damaged
            ]
        );
        // A line without an end does not take the next one with it.
        assert_eq!(heard(&[b't'; 100]), []);
        assert_eq!(heard(b"\rt1000\r").len(), 2);
    }
}
