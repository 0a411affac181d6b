//! Bytes as a stream of choices. It never ends: after the last byte come zeros, so that an input of any length is one
//! of the fixed length that a target reads.

use deictic_core::category::BitSet;

/// A stream of choices.
pub struct Source<'a> {
    bytes: &'a [u8],
}

impl<'a> Source<'a> {
    /// The choices that these bytes make.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    /// Whether all bytes have been used.
    pub fn is_over(&self) -> bool {
        self.bytes.is_empty()
    }

    /// The next byte, 0 after the last.
    pub fn byte(&mut self) -> u8 {
        match self.bytes.split_first() {
            Some((first, rest)) => {
                self.bytes = rest;
                *first
            }
            None => 0,
        }
    }

    /// Up to `n` of the bytes that are left.
    pub fn bytes(&mut self, n: usize) -> &'a [u8] {
        let (taken, rest) = self.bytes.split_at(n.min(self.bytes.len()));
        self.bytes = rest;
        taken
    }

    /// A number below `n`, which is at most 256 and not 0.
    pub fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }

    /// A small number below `n`.
    pub fn small(&mut self, n: u8) -> u8 {
        self.byte() % n.max(1)
    }

    /// Yes or no.
    pub fn flag(&mut self) -> bool {
        self.byte() & 1 != 0
    }

    /// One of these.
    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    /// 32 bits.
    pub fn word(&mut self) -> u32 {
        u32::from_le_bytes([self.byte(), self.byte(), self.byte(), self.byte()])
    }

    /// Any float at all.
    pub fn float(&mut self) -> f32 {
        f32::from_bits(self.word())
    }

    /// A likelihood: mostly a multiple of 1/250, sometimes something odd in 0..=1.
    pub fn unit(&mut self) -> f32 {
        match self.byte() {
            251 => 1e-3,
            252 => f32::MIN_POSITIVE,
            253 => f32::from_bits(1),
            254 => 1.0 - f32::EPSILON,
            255 => f32::from(self.byte()) / 255.0 * 1e-3,
            b => f32::from(b) / 250.0,
        }
    }

    /// Some of the numbers below `n`.
    pub fn set(&mut self, n: usize) -> BitSet {
        let bits = u32::from(self.byte()) | u32::from(self.byte()) << 8;
        BitSet(bits & ((1 << n.min(16)) - 1))
    }
}
