//! Frames out of the bytes of a wire.

use std::collections::VecDeque;
use std::io;
use std::time::{Duration, Instant};

use deictic_core::can::Frame;

use crate::link::Wire;

/// An end of a wire that makes frames of its bytes.
pub(super) trait Reads {
    /// The wire.
    fn wire(&mut self) -> &mut dyn Wire;

    /// Makes what it can of further bytes.
    fn take(&mut self, bytes: &[u8]) -> io::Result<()>;

    /// The frames that were made and not taken yet.
    fn arrived(&mut self) -> &mut VecDeque<Frame>;

    /// The next frame, waiting up to `patience` for it; `None` when none came.
    fn next(&mut self, patience: Duration) -> io::Result<Option<Frame>> {
        let until = Instant::now() + patience;
        let mut buffer = [0; 512];
        loop {
            if let Some(frame) = self.arrived().pop_front() {
                return Ok(Some(frame));
            }
            let left = until.saturating_duration_since(Instant::now());
            let read = self.wire().read(&mut buffer, left)?;
            self.take(buffer.get(..read).unwrap_or(&[]))?;
            if read == 0 && self.arrived().is_empty() && Instant::now() >= until {
                return Ok(None);
            }
        }
    }
}
