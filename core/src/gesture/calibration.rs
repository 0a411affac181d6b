//! How well one person aims, found from misses of known targets.

use super::pointing::Aim;
use crate::math;

/// Learns how well a person aims from misses of known targets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Calibration {
    squares: f32,
    count: f32,
}

impl Calibration {
    /// How many misses the assumption of [`Aim::DEFAULT`] outweighs.
    const PRIOR: f32 = 3.0;

    /// No target shown yet.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            squares: 0.0,
            count: 0.0,
        }
    }

    /// The ray missed the target by this angle, rad. Angles beyond 90 degrees mean that another
    /// target was aimed at, and are left out.
    pub fn missed_by(&mut self, angle: f32) {
        if angle < core::f32::consts::FRAC_PI_2 && self.count < 1e4 {
            self.squares += angle * angle;
            self.count += 1.0;
        }
    }

    /// The aim to reckon with. The squared miss of two directions is on average twice the variance.
    #[must_use]
    pub fn aim(&self) -> Aim {
        let prior = Aim::DEFAULT;
        let variance = (Self::PRIOR * prior.sigma * prior.sigma + self.squares / 2.0)
            / (Self::PRIOR + self.count);
        Aim {
            sigma: math::sqrt(variance),
            ..prior
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calibration_finds_the_persons_sigma() {
        let mut calibration = Calibration::new();
        assert!((calibration.aim().sigma - Aim::DEFAULT.sigma).abs() < 1e-6);
        // Misses of equally probable sizes for a sigma of 0.03 (Rayleigh quantiles).
        for i in 0..200 {
            let u = (f64::from(i) + 0.5) / 200.0;
            calibration.missed_by((0.03 * (-2.0 * (1.0 - u).ln()).sqrt()) as f32);
        }
        calibration.missed_by(3.0);
        calibration.missed_by(f32::NAN);
        assert!(
            (calibration.aim().sigma - 0.03).abs() < 0.003,
            "{calibration:?}"
        );
    }
}
