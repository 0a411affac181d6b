//! Numbers of any width packed into the bytes of a frame, lowest bit first.

/// Appends numbers of any width, lowest bit first.
pub(super) struct Writer<const N: usize> {
    pub(super) bytes: [u8; N],
    at: usize,
}

impl<const N: usize> Writer<N> {
    pub(super) const fn new() -> Self {
        Self {
            bytes: [0; N],
            at: 0,
        }
    }

    pub(super) fn bits(&mut self, value: u32, width: u32) {
        for i in 0..width {
            let bit = value.wrapping_shr(i) as u8 & 1;
            if let Some(byte) = self.bytes.get_mut(self.at / 8) {
                *byte |= bit.wrapping_shl((self.at % 8) as u32);
            }
            self.at = self.at.wrapping_add(1);
        }
    }
}

/// Takes numbers of any width, lowest bit first; zeros beyond the end.
pub(super) struct Reader<'a, const N: usize> {
    bytes: &'a [u8; N],
    at: usize,
}

impl<'a, const N: usize> Reader<'a, N> {
    pub(super) const fn new(bytes: &'a [u8; N]) -> Self {
        Self { bytes, at: 0 }
    }

    /// `width` of at most 32 bits. Eight bytes around the place hold any such number.
    pub(super) fn bits(&mut self, width: u32) -> u32 {
        let mut window = 0_u64;
        let bytes = self.bytes.iter().skip(self.at / 8).take(5);
        for (byte, place) in bytes.zip((0_u32..).step_by(8)) {
            window |= u64::from(*byte).wrapping_shl(place);
        }
        let value = window.wrapping_shr((self.at % 8) as u32) as u32;
        self.at = self.at.wrapping_add(width as usize);
        value & u32::MAX.wrapping_shr(32_u32.wrapping_sub(width))
    }

    pub(super) fn signed(&mut self, width: u32) -> i32 {
        let unused = 32_u32.wrapping_sub(width);
        (self.bits(width).wrapping_shl(unused) as i32).wrapping_shr(unused)
    }
}
