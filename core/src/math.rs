//! The only door to transcendental functions, so that host and board give the same bits.
//!
//! `libm` is pure Rust over IEEE-754 additions and multiplications, which round alike everywhere;
//! `std`'s methods call the platform's own library and do not. On a Cortex-M4F `ln` takes 49
//! instructions and errs by at most 5e-7 relative; micromath's `ln` takes 40 and errs by 0.12,
//! which is why nothing that becomes a probability may use it.

/// Natural logarithm. `ln(0)` is minus infinity, a negative argument gives NaN.
#[must_use]
pub fn ln(x: f32) -> f32 {
    libm::logf(x)
}

/// The exponential function; overflows to infinity above 88.7 and to 0 below -103.
#[must_use]
pub fn exp(x: f32) -> f32 {
    libm::expf(x)
}

/// The square root, rounded as IEEE 754 asks; a negative argument gives NaN.
#[must_use]
pub fn sqrt(x: f32) -> f32 {
    libm::sqrtf(x)
}

/// The nearest whole number, halves away from zero.
#[must_use]
pub fn round(x: f32) -> f32 {
    libm::roundf(x)
}

/// The angle of the point (`x`, `y`) from the x axis, -pi..=pi.
#[must_use]
pub fn atan2(y: f32, x: f32) -> f32 {
    libm::atan2f(y, x)
}

/// `x` if it lies in 0..=1; NaN and everything below 0 give 0, everything above gives 1.
#[must_use]
pub fn clamp_unit(x: f32) -> f32 {
    if x >= 1.0 {
        1.0
    } else if x > 0.0 {
        x
    } else {
        0.0
    }
}

/// The larger of two numbers, neither of them NaN: a comparison and a move, where `f32::max` takes
/// care of NaN with half a dozen instructions more.
#[must_use]
pub fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// The smaller of two numbers, neither of them NaN.
#[must_use]
pub fn smaller(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

/// Index of the largest value, the first among equals; `None` for an empty slice or NaN alone.
#[must_use]
#[inline(never)]
pub fn argmax(values: &[f32]) -> Option<usize> {
    let mut best = None;
    let mut top = f32::NEG_INFINITY;
    for (i, &v) in values.iter().enumerate() {
        if v > top {
            top = v;
            best = Some(i);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ln_keeps_the_bits_that_every_target_must_give() {
        for (x, bits) in [
            (0.5_f32, 0xbf31_7218_u32),
            (0.2, 0xbfce_0210),
            (9.0, 0x400c_9f54),
            (1e-9, 0xc1a5_c940),
        ] {
            assert_eq!(ln(x).to_bits(), bits, "ln({x}) = {:#x}", ln(x).to_bits());
        }
    }

    #[test]
    fn clamp_unit_is_total() {
        assert_eq!(clamp_unit(f32::NAN), 0.0);
        assert_eq!(clamp_unit(f32::NEG_INFINITY), 0.0);
        assert_eq!(clamp_unit(f32::INFINITY), 1.0);
        assert_eq!(clamp_unit(-0.0).to_bits(), 0);
    }

    #[test]
    fn argmax_takes_the_first_of_equals_and_skips_nan() {
        assert_eq!(argmax(&[]), None);
        assert_eq!(argmax(&[f32::NAN]), None);
        assert_eq!(argmax(&[0.1, f32::NAN, 0.4, 0.4]), Some(2));
    }
}
