//! The Panda's kinematics: where its parts are when its joints stand so and so, how its joints have to
//! stand for the hand to be somewhere, and how they get there within the arm's limits.
//!
//! Lengths in metres, angles in radians, times in seconds; the base frame is the robot's own: x away
//! from it, y to its left, z up from the table it stands on.

mod forward;
mod inverse;
mod limits;
mod path;
mod trajectory;

pub use forward::{Skeleton, hand, skeleton};
pub use inverse::solve;
pub use limits::{FR3, Limits, PANDA};
pub use path::Path;
pub use trajectory::{Caps, Trajectory};

/// The angle of every joint, from the base outwards.
pub type Joints = [f64; 7];

/// Where the hand is and how it is turned.
pub type Pose = nalgebra::Isometry3<f64>;

/// The posture the arm begins in (libfranka's `q_goal` in its examples).
pub const READY: Joints = [
    0.0,
    -core::f64::consts::FRAC_PI_4,
    0.0,
    -3.0 * core::f64::consts::FRAC_PI_4,
    0.0,
    core::f64::consts::FRAC_PI_2,
    core::f64::consts::FRAC_PI_4,
];

/// How far the gripper opens, between the fingers (Franka Hand, data sheet).
pub const OPEN: f64 = 0.08;

/// The farthest that two sets of angles are apart in any joint.
#[must_use]
pub fn apart(a: &Joints, b: &Joints) -> f64 {
    let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    apart.fold(0.0, f64::max)
}
