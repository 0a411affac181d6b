//! The paper's noise levels (Considered noise levels), to draw from and to weigh evidence with.

use rand::{Rng, RngExt};
use rand_distr::{Distribution, Exp1, StandardNormal};

/// n1: half of the errors of real gesture recognition are this small, an exponential's mean ...
const SMALL: f64 = 0.005_827_560_175_383_218;
/// ... the others an exponentially modified Gaussian: K, location, scale; all with either sign.
const LARGE: [f64; 3] = [
    1.768_464_920_150_208,
    0.150_726_102_257_059_82,
    0.057_626_423_823_257_39,
];

/// Below this a density counts as this, so that one impossible element does not decide alone.
const FLOOR: f64 = 1e-12;

/// A noise level, in the paper's numbering.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Level {
    /// None.
    N0,
    /// As measured on real gestures.
    N1,
    /// Normal with standard deviation 0.2.
    N2,
    /// Normal with standard deviation 0.4.
    N3,
    /// Normal with standard deviation 0.6.
    N4,
}

impl Level {
    /// All, from none to extreme.
    pub const ALL: [Self; 5] = [Self::N0, Self::N1, Self::N2, Self::N3, Self::N4];

    /// Its number.
    #[must_use]
    pub fn number(self) -> usize {
        self as usize
    }
}

/// Noise of a level, possibly of a better or worse sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// The level.
    pub level: Level,
    /// By how much the errors are larger or smaller than the level's; above 0.
    pub scale: f64,
}

impl From<Level> for Noise {
    fn from(level: Level) -> Self {
        Self { level, scale: 1.0 }
    }
}

impl Noise {
    /// One error.
    pub fn draw(&self, rng: &mut impl Rng) -> f64 {
        self.scale
            * match self.level {
                Level::N0 => 0.0,
                Level::N1 => {
                    let size: f64 = if rng.random() {
                        let e: f64 = Exp1.sample(rng);
                        SMALL * e
                    } else {
                        let [k, location, scale] = LARGE;
                        let (g, e): (f64, f64) = (StandardNormal.sample(rng), Exp1.sample(rng));
                        location + scale * (g + k * e)
                    };
                    if rng.random() { size } else { -size }
                }
                normal => {
                    let g: f64 = StandardNormal.sample(rng);
                    deviation(normal) * g
                }
            }
    }

    /// What is observed of a likelihood: with an error, clipped to 0..=1.
    pub fn observe(&self, likelihood: f64, rng: &mut impl Rng) -> f64 {
        (likelihood + self.draw(rng)).clamp(0.0, 1.0)
    }

    /// The logarithm of the density of observing `x` when the likelihood is `mu`; at 0 and 1 that
    /// of the probability that clipping has gathered there.
    #[must_use]
    pub fn log_evidence(&self, x: f64, mu: f64) -> f64 {
        if self.level == Level::N0 {
            return if (x - mu).abs() < 1e-6 {
                0.0
            } else {
                FLOOR.ln()
            };
        }
        let evidence = if x <= 0.0 {
            self.beyond(mu)
        } else if x >= 1.0 {
            self.beyond(1.0 - mu)
        } else {
            self.density(x - mu)
        };
        (evidence + FLOOR).ln()
    }

    /// The density of an error.
    #[must_use]
    pub fn density(&self, error: f64) -> f64 {
        let r = error / self.scale;
        let density = match self.level {
            Level::N0 => 0.0,
            Level::N1 => {
                let r = r.abs();
                let small = (-r / SMALL).exp() / SMALL;
                0.25 * (small + large_density(r) + large_density(-r))
            }
            normal => {
                let s = deviation(normal);
                (-0.5 * (r / s).powi(2)).exp() / (s * (2.0 * std::f64::consts::PI).sqrt())
            }
        };
        density / self.scale
    }

    /// The probability of an error above `limit`, or below `-limit`: all levels are symmetrical.
    #[must_use]
    pub fn beyond(&self, limit: f64) -> f64 {
        let r = limit / self.scale;
        if r < 0.0 {
            return 1.0 - self.beyond(-limit);
        }
        match self.level {
            Level::N0 => 0.0,
            Level::N1 => {
                let small = (-r / SMALL).exp();
                0.25 * (small + 1.0 - large_below(r) + large_below(-r))
            }
            normal => 1.0 - below(r / deviation(normal)),
        }
    }
}

/// Standard deviation of the normal levels.
fn deviation(level: Level) -> f64 {
    match level {
        Level::N2 => 0.2,
        Level::N3 => 0.4,
        _ => 0.6,
    }
}

/// Standard normal distribution function.
fn below(z: f64) -> f64 {
    0.5 * libm::erfc(-z / std::f64::consts::SQRT_2)
}

/// Density of the exponentially modified Gaussian.
fn large_density(x: f64) -> f64 {
    let [k, location, scale] = LARGE;
    let z = (x - location) / scale;
    let tail = libm::erfc(-(z - 1.0 / k) / std::f64::consts::SQRT_2);
    (0.5 / (k * k) - z / k).exp() * tail / (2.0 * k * scale)
}

/// Distribution function of the exponentially modified Gaussian.
fn large_below(x: f64) -> f64 {
    let [k, location, scale] = LARGE;
    let z = (x - location) / scale;
    below(z) - (0.5 / (k * k) - z / k).exp() * below(z - 1.0 / k)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn densities_integrate_to_their_tails() {
        for level in &Level::ALL[1..] {
            for scale in [1.0, 0.7] {
                let noise = Noise {
                    level: *level,
                    scale,
                };
                let step = 1e-4;
                let above = |limit: f64| {
                    (0..60_000)
                        .map(|i| noise.density(limit + (f64::from(i) + 0.5) * step) * step)
                        .sum::<f64>()
                };
                for limit in [0.0, 0.05, 0.3, 0.8] {
                    let (sum, tail) = (above(limit), noise.beyond(limit));
                    assert!((sum - tail).abs() < 1e-3, "{level:?} {limit}: {sum} {tail}");
                }
                assert!((noise.beyond(0.0) - 0.5).abs() < 1e-9);
                assert!((noise.beyond(-0.2) + noise.beyond(0.2) - 1.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn draws_follow_the_density() {
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        for level in &Level::ALL[1..] {
            let noise = Noise::from(*level);
            let n = 40_000;
            let draws: Vec<f64> = (0..n).map(|_| noise.draw(&mut rng)).collect();
            for limit in [-0.3, -0.01, 0.02, 0.2, 0.5] {
                let share = draws.iter().filter(|&&x| x > limit).count() as f64 / f64::from(n);
                assert!(
                    (share - noise.beyond(limit)).abs() < 0.01,
                    "{level:?} {limit}"
                );
            }
        }
    }

    #[test]
    fn without_noise_only_the_likelihood_itself_is_seen() {
        let noise = Noise::from(Level::N0);
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        assert_eq!(noise.observe(0.22, &mut rng), 0.22);
        assert!(noise.log_evidence(0.22, 0.22) > noise.log_evidence(0.22, 0.5) + 20.0);
    }
}
