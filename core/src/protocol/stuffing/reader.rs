//! Bytes of a line, unstuffed and checked.

use heapless::Vec;

use super::{CRC, CRC_BYTES};

/// Why a frame was dropped before anybody looked into it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// The stuffing does not end where the frame does, or there is nothing besides a CRC.
    Malformed,
    /// The CRC does not match.
    Corrupt,
    /// Longer than the buffer.
    Oversized,
}

/// Takes bytes one at a time and unstuffs them into frames of at most `FRAME` bytes.
#[derive(Debug)]
pub struct FrameReader<const FRAME: usize> {
    bytes: Vec<u8, FRAME>,
    /// How many bytes the current block still has.
    left: u8,
    /// Whether a zero belongs between the current block and the next.
    zero_follows: bool,
    oversized: bool,
    /// Whether a frame that was finished is still in `bytes`.
    finished: bool,
}

impl<const FRAME: usize> Default for FrameReader<FRAME> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const FRAME: usize> FrameReader<FRAME> {
    /// At the beginning of a frame.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            bytes: Vec::new(),
            left: 0,
            zero_follows: false,
            oversized: false,
            finished: false,
        }
    }

    /// Takes one byte; when it ends a frame, gives the frame's contents without the CRC, which are
    /// valid until the next byte. Zeros between frames give nothing.
    pub fn push(&mut self, byte: u8) -> Option<Result<&[u8], FrameError>> {
        if self.finished {
            self.bytes.clear();
            self.finished = false;
        }
        if byte == 0 {
            return self.end();
        }
        if self.left == 0 {
            if self.zero_follows {
                self.keep(0);
            }
            self.left = byte.saturating_sub(1);
            self.zero_follows = byte != u8::MAX;
        } else {
            self.left = self.left.saturating_sub(1);
            self.keep(byte);
        }
        None
    }

    fn keep(&mut self, byte: u8) {
        if self.bytes.push(byte).is_err() {
            self.oversized = true;
        }
    }

    fn end(&mut self) -> Option<Result<&[u8], FrameError>> {
        let (left, oversized) = (self.left, self.oversized);
        let empty = self.bytes.is_empty() && !self.zero_follows && left == 0;
        self.left = 0;
        self.zero_follows = false;
        self.oversized = false;
        self.finished = true;
        if empty {
            return None;
        }
        if oversized {
            return Some(Err(FrameError::Oversized));
        }
        if left != 0 {
            return Some(Err(FrameError::Malformed));
        }
        // A frame without contents says nothing, and would be sound by chance: the CRC of nothing is 0, as are the four
        // bytes of the beginning of many a frame that was cut short.
        let Some((contents, crc)) = self
            .bytes
            .split_last_chunk::<CRC_BYTES>()
            .filter(|(contents, _)| !contents.is_empty())
        else {
            return Some(Err(FrameError::Malformed));
        };
        if CRC.checksum(contents) != u32::from_le_bytes(*crc) {
            return Some(Err(FrameError::Corrupt));
        }
        Some(Ok(contents))
    }
}
