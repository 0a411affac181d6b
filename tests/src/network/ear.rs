//! Somebody who stands beside a line and understands all that a unit says on it, without a key.

use deictic_core::large::ToHost;
use deictic_core::protocol::link::Opening;
use deictic_core::protocol::seal::TAG;
use deictic_core::protocol::stuffing::FrameReader;

/// Reads frames, sealed or not, and takes each once, as whoever they are for does.
#[derive(Debug)]
pub struct Ear {
    reader: Box<FrameReader<4096>>,
    expected: u16,
}

impl Default for Ear {
    fn default() -> Self {
        Self {
            reader: Box::new(FrameReader::new()),
            expected: 0,
        }
    }
}

impl Ear {
    /// Takes one byte, and gives the message that it completes; none that was there before, or is older.
    pub fn hear(&mut self, byte: u8) -> Option<ToHost> {
        let contents = self.reader.push(byte)?.ok()?;
        let read = postcard::take_from_bytes::<(u16, ToHost)>(contents);
        let ((number, message), rest) = read.ok()?;
        let new = message.opens() || number.wrapping_sub(self.expected) <= u16::MAX / 2;
        if !new || !matches!(rest.len(), 0 | TAG) {
            return None;
        }
        self.expected = number.wrapping_add(1);
        Some(message)
    }
}
