//! Random numbers by integer arithmetic alone.

/// SplitMix64 (Steele, Lea, Flood 2014): one addition, three multiplications and shifts per number.
pub struct Random(u64);

impl Random {
    /// The numbers that follow from a seed.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    #[allow(clippy::should_implement_trait, reason = "it never ends")]
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In 0..n, biased by less than n / 2^32.
    pub fn below(&mut self, n: u32) -> u32 {
        let high = self.next() >> 32;
        (high.wrapping_mul(u64::from(n)) >> 32) as u32
    }

    /// Whether one of `n` came up.
    pub fn one_in(&mut self, n: u32) -> bool {
        self.below(n) == 0
    }

    /// A multiple of 2^-24 in 0..1, exact in 32 bits.
    pub fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / 16_777_216.0
    }
}
