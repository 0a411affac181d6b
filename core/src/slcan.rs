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

    fn collect(&mut self, character: u8) {
        // A line feed behind a CR is some terminals' habit.
        if character != b'\n' && self.line.push(character).is_err() {
            self.overlong = true;
        }
    }

    /// Ends the line; `None` when it was too long.
    fn end<T>(&mut self, read: impl FnOnce(&[u8]) -> T) -> Option<T> {
        let whole = !core::mem::take(&mut self.overlong);
        let read = whole.then(|| read(&self.line));
        self.line.clear();
        read
    }
}

/// What a client wants of an adapter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Nothing but the answer.
    Nothing,
    /// This frame is to be sent; the answer is true only if it is.
    Send(Frame),
}

/// The adapter's end: takes what a client writes, and says what to answer and what to send.
#[derive(Debug, Default)]
pub struct Adapter {
    lines: Lines,
    open: bool,
    listening: bool,
}

impl Adapter {
    /// A closed adapter.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            lines: Lines::new(),
            open: false,
            listening: false,
        }
    }

    /// Whether a client has opened it, so that frames from the bus are to be told.
    #[must_use]
    pub const fn is_open(&self) -> bool {
        self.open
    }

    /// Takes a character and gives, at a line's end, what is wanted and what is to be answered.
    pub fn take(&mut self, character: u8) -> Option<(Wanted, &'static [u8])> {
        if character != CR {
            self.lines.collect(character);
            return None;
        }
        let (open, sends) = (self.open, self.open && !self.listening);
        let answer = |well: bool| -> (Wanted, &'static [u8]) {
            (Wanted::Nothing, if well { &[CR] } else { &[BELL] })
        };
        let mut state = (self.open, self.listening);
        let done = self.lines.end(|line| match line {
            // An empty line is how clients clear whatever stood before.
            [] => answer(true),
            [b'S', b'0'..=b'8'] => answer(!open),
            [b's' | b'M' | b'm' | b'Z' | b'U' | b'Q' | b'X' | b'W', ..] => answer(true),
            [b'O'] => {
                state = (true, false);
                answer(true)
            }
            [b'L'] => {
                state = (true, true);
                answer(true)
            }
            [b'C'] => {
                state = (false, false);
                answer(true)
            }
            [b'V'] | [b'v'] => (Wanted::Nothing, &b"V1013\r"[..]),
            [b'N'] => (Wanted::Nothing, &b"NDEIC\r"[..]),
            [b'F'] => (Wanted::Nothing, &b"F00\r"[..]),
            [b't', rest @ ..] if sends => match frame(rest) {
                Some(frame) => (Wanted::Send(frame), &b"z\r"[..]),
                None => answer(false),
            },
            _ => answer(false),
        });
        (self.open, self.listening) = state;
        Some(done.unwrap_or_else(|| answer(false)))
    }
}

fn digit(character: u8) -> Option<u8> {
    let digit = char::from(character).to_digit(16)?;
    u8::try_from(digit).ok()
}

/// Reads `IIIL`, the data, and a time stamp of four digits or none.
fn frame(line: &[u8]) -> Option<Frame> {
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

    fn said(adapter: &mut Adapter, text: &str) -> List<(Wanted, &'static [u8])> {
        text.bytes().filter_map(|c| adapter.take(c)).collect()
    }

    #[test]
    fn what_python_can_says_is_understood() {
        let mut adapter = Adapter::new();
        let yes = || (Wanted::Nothing, &b"\r"[..]);
        assert_eq!(
            said(&mut adapter, "C\rS8\rO\rO\r"),
            [yes(), yes(), yes(), yes()]
        );
        assert!(adapter.is_open());
        let frame = Frame::new(0x12f, &[0xab, 0x01]).unwrap();
        assert_eq!(
            said(&mut adapter, "t12F2aB01\r"),
            [(Wanted::Send(frame), &b"z\r"[..])]
        );
        assert_eq!(said(&mut adapter, "V\r")[0].1, b"V1013\r");
        said(&mut adapter, "C\r");
        assert!(!adapter.is_open());
    }

    #[test]
    fn what_cannot_be_sent_is_refused() {
        let mut adapter = Adapter::new();
        let no = [(Wanted::Nothing, &[BELL][..])];
        assert_eq!(said(&mut adapter, "t1230\r"), no, "it is closed");
        said(&mut adapter, "O\r");
        for line in [
            "t8000\r",
            "t1239\r",
            "t12321\r",
            "t1232112g\r",
            "t123\r",
            "T0000000101\r",
            "r1230\r",
            "?\r",
            "t12381122334455667788990011223344556677\r",
            "t12\u{e9}011\r",
        ] {
            assert_eq!(said(&mut adapter, line), no, "{line:?}");
        }
        assert_eq!(said(&mut adapter, "S5\r"), no, "it is open");
        said(&mut adapter, "L\r");
        assert_eq!(said(&mut adapter, "t1230\r"), no, "it only listens");
    }

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
