//! Somebody who stands beside the unit and understands all that it says, without a key.

use deictic_core::large::ToHost;
use deictic_core::protocol::seal::TAG;
use deictic_core::protocol::stuffing::FrameReader;

/// Reads frames, sealed or not.
#[derive(Debug)]
pub struct Ear(Box<FrameReader<4096>>);

impl Default for Ear {
    fn default() -> Self {
        Self(Box::new(FrameReader::new()))
    }
}

impl Ear {
    /// Takes one byte, and gives the message that it completes.
    pub fn hear(&mut self, byte: u8) -> Option<ToHost> {
        let contents = self.0.push(byte)?.ok()?;
        let ((_, message), rest) = postcard::take_from_bytes::<(u16, ToHost)>(contents).ok()?;
        matches!(rest.len(), 0 | TAG).then_some(message)
    }
}
