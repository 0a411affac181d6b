//! What a pointing finger means: a probability for everything in the scene, and for nothing in it.
//!
//! The finger sends a ray, not a line: what lies behind the hand is not meant. A person who aims at
//! a thing misses it by an angle that is normally distributed in both directions, so a thing at the
//! angle a has the density exp(-a^2 / 2 s^2) / (2 pi s^2) per solid angle; whoever points at nothing
//! in the scene does so evenly over the half space in front. Two things near each other share the
//! probability, whichever is a hair nearer: the word stays flat when it is ambiguous. (The paper's
//! 1 / (1 + distance) is nearly flat always.)

use heapless::Vec;
use serde::{Deserialize, Serialize};

use super::frame::HandFrame;
use super::vector::{self, Vector};
use crate::math;

/// A half line; metres in the robot's base frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins.
    pub origin: Vector,
    /// A unit vector.
    pub direction: Vector,
}

/// Where the hand sensor stands in the robot's base frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mount {
    /// The sensor's x, y and z axis in the base frame, each a unit vector.
    pub axes: [Vector; 3],
    /// The sensor's origin in the base frame, m.
    pub origin: Vector,
}

/// Why a sensor cannot stand so.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum MountError {
    /// The axes are not three unit vectors, right-handed and at right angles.
    Axes,
    /// The origin is not within 100 m.
    Origin,
}

impl Mount {
    /// The sensor lies at the base frame's origin and faces up; the person sits across the table
    /// and looks at the robot: the sensor's x is the base's y, y is z, z is x.
    pub const DEFAULT: Self = Self {
        axes: [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        origin: [0.0; 3],
    };

    /// Checks what may have come from anywhere: axes of length 1 (to within a hundredth) that stand
    /// upright on each other and are right-handed, an origin within 100 m.
    ///
    /// # Errors
    /// The first [`MountError`] found.
    pub fn check(&self) -> Result<(), MountError> {
        let [x, y, z] = self.axes;
        let off = vector::distance(vector::cross(x, y), z);
        let units = self.axes.iter().all(|a| {
            let length = vector::length(*a);
            (0.99..=1.01).contains(&length)
        });
        // The comparison is false for NaN.
        if !(units && off < 0.03) {
            return Err(MountError::Axes);
        }
        if !self.origin.iter().all(|x| (-100.0..=100.0).contains(x)) {
            return Err(MountError::Origin);
        }
        Ok(())
    }

    /// A direction of the sensor in the base frame.
    #[must_use]
    pub fn turn(&self, [x, y, z]: Vector) -> Vector {
        let [ax, ay, az] = self.axes;
        vector::add(
            vector::add(vector::scale(ax, x), vector::scale(ay, y)),
            vector::scale(az, z),
        )
    }

    /// A point of the sensor, in mm, in the base frame, in m.
    #[must_use]
    pub fn place(&self, point: Vector) -> Vector {
        vector::add(self.origin, self.turn(vector::scale(point, 1e-3)))
    }
}

/// The ray of the index finger: from its tip, along the line from its knuckle. `None` without an
/// index finger.
#[must_use]
pub fn ray(frame: &HandFrame, mount: &Mount) -> Option<Ray> {
    let [_, index, ..] = frame.fingers;
    let index = index?;
    let direction = vector::unit(vector::sub(index.tip, index.knuckle))?;
    Some(Ray {
        origin: mount.place(index.tip),
        direction: mount.turn(direction),
    })
}

/// The angle by which a ray misses a point, 0..=pi; 0 within a millimetre of its origin.
#[must_use]
pub fn miss(ray: &Ray, point: Vector) -> f32 {
    let to = vector::sub(point, ray.origin);
    if vector::dot(to, to) < 1e-6 {
        return 0.0;
    }
    vector::angle(ray.direction, to)
}

/// How well one person aims.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Aim {
    /// Standard deviation of the miss in each of two directions, rad, 0.001..=1.
    pub sigma: f32,
    /// Probability that a pointing hand means nothing in the scene, 0..1.
    pub nothing: f32,
}

impl Aim {
    /// Checks what may have come from anywhere: both numbers in their ranges.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        (1e-3..=1.0).contains(&self.sigma) && (0.0..1.0).contains(&self.nothing)
    }

    /// Five degrees, as people reach who see no cursor, and one gesture in ten at nothing.
    pub const DEFAULT: Self = Self {
        sigma: 0.087,
        nothing: 0.1,
    };
}

/// Probabilities of what a ray means.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Meant<const E: usize> {
    /// One per point.
    pub points: Vec<f32, E>,
    /// None of them.
    pub nothing: f32,
}

/// What a ray means among `points`, of which those beyond the first `E` are left out. About 500
/// instructions per point.
#[must_use]
pub fn meant<const E: usize>(
    ray: &Ray,
    points: impl Iterator<Item = Vector>,
    aim: &Aim,
) -> Meant<E> {
    let variance = (aim.sigma * aim.sigma).clamp(1e-6, 1.0);
    let mut meant = Meant {
        points: Vec::new(),
        nothing: 1.0,
    };
    for point in points.take(E) {
        let angle = miss(ray, point);
        // Full: `take` has kept the rest away.
        let _ = meant
            .points
            .push(math::exp(-angle * angle / (2.0 * variance)));
    }
    let nothing = math::clamp_unit(aim.nothing).clamp(1e-3, 0.999);
    let count = meant.points.len().max(1) as f32;
    // Densities against that of the half space, 1 / 2 pi; the factor 2 pi cancels.
    let each = (1.0 - nothing) / (count * variance);
    let mut sum = nothing;
    for p in &mut meant.points {
        *p *= each;
        // A direction that is not finite points at nothing.
        *p = if *p > 0.0 { *p } else { 0.0 };
        sum += *p;
    }
    for p in &mut meant.points {
        *p /= sum;
    }
    meant.nothing = nothing / sum;
    meant
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FORWARD: Ray = Ray {
        origin: [0.0; 3],
        direction: [1.0, 0.0, 0.0],
    };

    fn at(degrees: f32) -> Vector {
        let radians = f64::from(degrees).to_radians();
        [radians.cos() as f32, radians.sin() as f32, 0.0]
    }

    fn among(points: &[Vector]) -> Meant<8> {
        meant(&FORWARD, points.iter().copied(), &Aim::DEFAULT)
    }

    #[test]
    fn the_aimed_at_thing_is_meant() {
        let m = among(&[at(0.0), at(30.0), at(-40.0)]);
        assert!(m.points[0] > 0.95, "{m:?}");
    }

    #[test]
    fn two_things_side_by_side_share() {
        let m = among(&[at(2.0), at(-2.2), at(60.0)]);
        assert!((m.points[0] - m.points[1]).abs() < 0.06, "{m:?}");
        assert!(m.points[0] < 0.55);
    }

    #[test]
    fn what_lies_behind_or_far_beside_is_not_meant() {
        let m = among(&[at(180.0), at(90.0), at(35.0)]);
        assert!(m.nothing > 0.99, "{m:?}");
    }

    #[test]
    fn a_mount_or_aim_that_cannot_be_is_refused() {
        assert_eq!(Mount::DEFAULT.check(), Ok(()));
        let mut left_handed = Mount::DEFAULT;
        left_handed.axes.swap(0, 1);
        assert_eq!(left_handed.check(), Err(MountError::Axes));
        let mut far = Mount::DEFAULT;
        for bad in [f32::NAN, f32::INFINITY, 101.0] {
            far.origin[2] = bad;
            assert_eq!(far.check(), Err(MountError::Origin));
        }
        assert!(Aim::DEFAULT.is_sound());
        for sigma in [f32::NAN, 0.0, -1.0, 1.5] {
            assert!(
                !Aim {
                    sigma,
                    ..Aim::DEFAULT
                }
                .is_sound()
            );
        }
    }

    #[test]
    fn the_ray_follows_the_index_finger_into_the_base_frame() {
        let mut frame = HandFrame::default();
        assert_eq!(ray(&frame, &Mount::DEFAULT), None);
        frame.fingers[1] = Some(crate::gesture::frame::Finger {
            knuckle: [0.0, 200.0, 0.0],
            middle: [0.0, 200.0, -40.0],
            tip: [0.0, 200.0, -80.0],
        });
        let ray = ray(&frame, &Mount::DEFAULT).unwrap();
        assert_eq!(ray.direction, [-1.0, 0.0, 0.0]);
        assert!(vector::distance(ray.origin, [-0.08, 0.0, 0.2]) < 1e-6);
    }

    proptest! {
        #[test]
        fn any_numbers_give_probabilities(
            points in prop::collection::vec(prop::array::uniform3(any::<f32>()), 0..12),
            origin in prop::array::uniform3(any::<f32>()),
            direction in prop::array::uniform3(any::<f32>()),
            sigma in any::<f32>(),
            nothing in any::<f32>(),
        ) {
            let m: Meant<8> = meant(&Ray { origin, direction }, points.into_iter(), &Aim { sigma, nothing });
            let sum: f32 = m.points.iter().sum::<f32>() + m.nothing;
            prop_assert!((sum - 1.0).abs() < 1e-4, "{:?}", m);
        }
    }
}
