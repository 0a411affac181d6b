//! A path with a time for every point of it, within the limits of the joints and a cap on the hand.

use nalgebra::Vector3;

use super::{Joints, Limits, Path, hand};

/// How fast an arm is let go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Caps {
    /// The part of the joints' limits of speed and acceleration that is used, in 0..=1.
    pub part: f64,
    /// The hand's highest speed, in m/s.
    pub hand: f64,
}

impl Caps {
    /// Slow enough beside a person: 0.25 m/s, the reduced speed that ISO 10218-1 allows while a
    /// person is in the cell, and a fifth of what the joints can.
    pub const CAREFUL: Self = Self {
        part: 0.2,
        hand: 0.25,
    };
}

/// How many points of a piece of a path are looked at to find its fastest.
const LOOKS: usize = 12;

/// A motion that takes less than this, in seconds, is none.
const NOTHING: f64 = 1e-4;

/// A path that is followed from rest to rest with the least jerk.
#[derive(Clone, Debug)]
pub struct Trajectory {
    path: Path,
    duration: f64,
}

/// How far along a motion from rest to rest is at `t` of its time, and the first and second
/// derivatives: the polynomial of least jerk.
fn ease(t: f64) -> (f64, f64, f64) {
    let t = t.clamp(0.0, 1.0);
    (
        t * t * t * (10.0 - 15.0 * t + 6.0 * t * t),
        30.0 * t * t * (1.0 - t) * (1.0 - t),
        60.0 * t * (1.0 - t) * (1.0 - 2.0 * t),
    )
}

/// The largest of `values` as parts of their limits.
fn ratio(values: &Joints, limits: &Joints) -> f64 {
    let parts = values.iter().zip(limits).map(|(v, most)| v.abs() / most);
    parts.fold(0.0, f64::max)
}

impl Trajectory {
    /// Follows `path` as fast as `limits` and `caps` allow.
    #[must_use]
    pub fn along(path: Path, limits: &Limits, caps: &Caps) -> Self {
        let looks = LOOKS * path.pieces().max(1);
        let mut slowest = 0.0_f64;
        let mut before: Option<Joints> = None;
        let mut way = Vector3::zeros();
        for look in 0..=looks {
            let time = look as f64 / looks as f64;
            let (part, rate, change) = ease(time);
            let point = path.point(part);
            let mut speed = point.first;
            let mut acceleration = point.second;
            let rates = speed.iter_mut().zip(&mut acceleration);
            for (v, a) in rates {
                *a = *a * rate * rate + *v * change;
                *v *= rate;
            }
            // Speeds fall with the duration, accelerations with its square.
            slowest = slowest
                .max(ratio(&speed, &limits.speed) / caps.part)
                .max((ratio(&acceleration, &limits.acceleration) / caps.part).sqrt());
            let place = hand(&point.joints).translation.vector;
            if before.is_some() {
                let per_duration = (place - way).norm() * looks as f64;
                slowest = slowest.max(per_duration / caps.hand);
            }
            (before, way) = (Some(point.joints), place);
        }
        let duration = if slowest < NOTHING { 0.0 } else { slowest };
        Self { path, duration }
    }

    /// How long it takes, in seconds.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// The path it follows.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The part of the way that is behind the arm `seconds` after it began, in 0..=1.
    #[must_use]
    pub fn part(&self, seconds: f64) -> f64 {
        if self.duration <= 0.0 {
            return 1.0;
        }
        ease(seconds / self.duration).0
    }

    /// The angles `seconds` after it began; the last ones after its end.
    #[must_use]
    pub fn at(&self, seconds: f64) -> Joints {
        self.path.at(self.part(seconds))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::panda::{PANDA, READY, apart};

    fn through(ends: &[Joints]) -> Trajectory {
        let path = Path::through(ends.to_vec()).unwrap();
        Trajectory::along(path, &PANDA, &Caps::CAREFUL)
    }

    #[test]
    fn it_keeps_to_speeds_accelerations_and_the_cap_on_the_hand() {
        let there = [0.8, 0.3, -0.2, -1.9, 0.2, 2.1, 1.2];
        let back = [-0.9, 0.1, 0.4, -2.2, -0.4, 2.6, 0.1];
        let motion = through(&[READY, there, back]);
        let ms = 1e-3;
        let steps = (motion.duration() / ms) as usize + 2;
        let at: Vec<_> = (0..steps).map(|i| motion.at(i as f64 * ms)).collect();
        for three in at.windows(3) {
            let [a, b, c] = three else { continue };
            for joint in 0..7 {
                let speed = (b[joint] - a[joint]) / ms;
                let bend = (c[joint] - 2.0 * b[joint] + a[joint]) / (ms * ms);
                assert!(speed.abs() <= PANDA.speed[joint] * 0.21);
                assert!(bend.abs() <= PANDA.acceleration[joint] * 0.22);
            }
            let way = hand(b).translation.vector - hand(a).translation.vector;
            assert!(way.norm() / ms <= 0.26, "{}", way.norm() / ms);
        }
        assert!(apart(&motion.at(0.0), &READY) < 1e-12);
        assert!(apart(&motion.at(1e9), &back) < 1e-12);
    }

    #[test]
    fn a_motion_to_where_the_arm_is_takes_no_time() {
        let motion = through(&[READY, READY]);
        assert_eq!(motion.duration(), 0.0);
        assert!(apart(&motion.at(0.0), &READY) < 1e-12);
    }
}
