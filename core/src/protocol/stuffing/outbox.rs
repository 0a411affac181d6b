//! What waits to be written.

use heapless::Vec;

/// Frames waiting to be written, at most `OUT` bytes of them.
#[derive(Debug)]
pub struct Outbox<const OUT: usize> {
    pub(super) bytes: Vec<u8, OUT>,
    written: usize,
}

impl<const OUT: usize> Default for Outbox<OUT> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const OUT: usize> Outbox<OUT> {
    /// Nothing to be written.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            bytes: Vec::new(),
            written: 0,
        }
    }

    /// What is still to be written.
    #[must_use]
    pub fn waiting(&self) -> &[u8] {
        self.bytes.get(self.written..).unwrap_or(&[])
    }

    /// The first `n` waiting bytes have been written.
    pub fn written(&mut self, n: usize) {
        self.written = self.written.saturating_add(n);
        if self.written >= self.bytes.len() {
            self.clear();
        }
    }

    /// Forgets what is waiting.
    pub fn clear(&mut self) {
        self.bytes.clear();
        self.written = 0;
    }

    /// Forgets what is waiting. When that may cut a frame short, a zero ends it, so that the next one is not taken for
    /// its rest.
    pub fn abandon(&mut self) {
        let cut = !self.waiting().is_empty();
        self.clear();
        if cut {
            // There is room in an empty outbox.
            let _ = self.bytes.push(0);
        }
    }

    pub(super) fn compact(&mut self) {
        if self.written > 0 {
            let length = self.bytes.len();
            // Byte by byte: the slices' own ways to move can panic, if only in a build that does not see that they do not.
            for from in self.written..length {
                let byte = self.bytes.get(from).copied().unwrap_or(0);
                if let Some(to) = self.bytes.get_mut(from.saturating_sub(self.written)) {
                    *to = byte;
                }
            }
            self.bytes.truncate(length.saturating_sub(self.written));
            self.written = 0;
        }
    }
}
