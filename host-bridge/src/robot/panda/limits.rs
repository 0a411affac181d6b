//! What the joints can do.

use super::Joints;

/// The limits of an arm's joints, from the base outwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Smallest angles, in radians.
    pub least: Joints,
    /// Largest angles, in radians.
    pub most: Joints,
    /// Speeds, in rad/s.
    pub speed: Joints,
    /// Accelerations, in rad/s².
    pub acceleration: Joints,
    /// Jerks, in rad/s³.
    pub jerk: Joints,
}

/// The Franka Emika Panda ("Robot and interface specifications", Franka Control Interface
/// documentation: joint space limits).
pub const PANDA: Limits = Limits {
    least: [
        -2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973,
    ],
    most: [2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973],
    speed: [2.1750, 2.1750, 2.1750, 2.1750, 2.6100, 2.6100, 2.6100],
    acceleration: [15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0],
    jerk: [7500.0, 3750.0, 5000.0, 6250.0, 7500.0, 10_000.0, 10_000.0],
};

/// The Franka Research 3 (the same documentation). Its speed limits fall towards the ends of every
/// joint; these are the ones in the middle, and planned motions stay far below them.
pub const FR3: Limits = Limits {
    least: [-2.7437, -1.7837, -2.9007, -3.0421, -2.8065, 0.5445, -3.0159],
    most: [2.7437, 1.7837, 2.9007, -0.1518, 2.8065, 4.5169, 3.0159],
    speed: [2.62, 2.62, 2.62, 2.62, 5.26, 4.18, 5.26],
    acceleration: [10.0; 7],
    jerk: [5000.0; 7],
};

impl Limits {
    /// Whether all angles are at least `margin` within the limits.
    #[must_use]
    pub fn hold(&self, joints: &Joints, margin: f64) -> bool {
        let ends = self.least.iter().zip(&self.most);
        let mut within = joints.iter().zip(ends);
        within.all(|(q, (least, most))| *q >= least + margin && *q <= most - margin)
    }

    /// What both arms can do, for plans that either is to follow.
    #[must_use]
    pub fn shared_with(&self, other: &Self) -> Self {
        let both = |a: &Joints, b: &Joints, pick: fn(f64, f64) -> f64| {
            let mut both = *a;
            for (a, b) in both.iter_mut().zip(b) {
                *a = pick(*a, *b);
            }
            both
        };
        Self {
            least: both(&self.least, &other.least, f64::max),
            most: both(&self.most, &other.most, f64::min),
            speed: both(&self.speed, &other.speed, f64::min),
            acceleration: both(&self.acceleration, &other.acceleration, f64::min),
            jerk: both(&self.jerk, &other.jerk, f64::min),
        }
    }
}
