//! From a cost back to a probability.

use super::tables::POWERS;

/// 2 to the power of -`cost` / 32, exact to 24 bits; 0 below 2^-100, which counts nowhere.
#[must_use]
#[inline(always)]
pub fn weight(cost: u32) -> f32 {
    let octaves = cost.wrapping_shr(5);
    if octaves > 100 {
        return 0.0;
    }
    let part = POWERS.get((cost & 31) as usize);
    let bits = part.copied().unwrap_or(0);
    f32::from_bits(bits.wrapping_sub(octaves.wrapping_shl(23)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_powers_of_two() {
        assert_eq!(weight(0), 1.0);
        assert_eq!(weight(32), 0.5);
        assert_eq!(weight(320), 1.0 / 1024.0);
        assert_eq!(weight(32 * 101), 0.0);
        for cost in 0..500 {
            let exact = (-f64::from(cost) / 32.0).exp2();
            assert!(
                (f64::from(weight(cost)) / exact - 1.0).abs() < 1e-7,
                "{cost}"
            );
        }
    }
}
