//! The adapter's end of the line.

use super::lines::{BELL, CR, Lines, frame};
use crate::can::Frame;

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
}
