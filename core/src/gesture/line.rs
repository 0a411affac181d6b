//! The sensor's serial line: samples behind the framing that the host link has as well.

use postcard::ser_flavors::Flavor;

use super::wire::{PAYLOAD, Sample, WireError, decode, encode};
use crate::protocol::stuffing::{self, FrameReader, FrameWriter, Outbox};

/// Bytes of a frame with CRC, stuffing and end.
pub const FRAMED: usize = 94;

/// Bytes of the payload with its CRC, which a receiver must hold.
const HELD: usize = PAYLOAD + 4;

/// Puts a sample with its framing behind what waits in `out`.
///
/// # Errors
/// That of [`encode`], or [`stuffing::FrameError::Oversized`] when `out` is full; nothing is
/// written then.
pub fn send<const OUT: usize>(sample: &Sample, out: &mut Outbox<OUT>) -> Result<(), WireError> {
    let payload = encode(sample)?;
    let full = |_| WireError::Framing(stuffing::FrameError::Oversized);
    let mut writer = FrameWriter::new(out).map_err(full)?;
    writer.try_extend(&payload).map_err(full)?;
    writer.finalize().map_err(full)
}

/// The sensor's end of a serial line: bytes in any chunking become samples.
#[derive(Debug, Default)]
pub struct SensorLine {
    reader: FrameReader<HELD>,
}

impl SensorLine {
    /// At the beginning of a frame.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            reader: FrameReader::new(),
        }
    }

    /// Takes one byte, and gives what it completes.
    pub fn push(&mut self, byte: u8) -> Option<Result<Sample, WireError>> {
        Some(self.take(byte)?.and_then(decode))
    }

    /// Takes one byte, and gives the bytes of the sample that it completes, whatever they say.
    pub fn take(&mut self, byte: u8) -> Option<Result<&[u8], WireError>> {
        Some(self.reader.push(byte)?.map_err(WireError::Framing))
    }
}
