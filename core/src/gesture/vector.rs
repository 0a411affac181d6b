//! Vectors of three `f32`: points in millimetres or metres, and directions.

use crate::math;

/// A point or a direction.
pub type Vector = [f32; 3];

/// `a + b`.
#[must_use]
pub fn add([ax, ay, az]: Vector, [bx, by, bz]: Vector) -> Vector {
    [ax + bx, ay + by, az + bz]
}

/// `a - b`.
#[must_use]
pub fn sub([ax, ay, az]: Vector, [bx, by, bz]: Vector) -> Vector {
    [ax - bx, ay - by, az - bz]
}

/// `factor * a`.
#[must_use]
pub fn scale([x, y, z]: Vector, factor: f32) -> Vector {
    [x * factor, y * factor, z * factor]
}

/// The inner product.
#[must_use]
pub fn dot([ax, ay, az]: Vector, [bx, by, bz]: Vector) -> f32 {
    ax * bx + ay * by + az * bz
}

/// The outer product.
#[must_use]
pub fn cross([ax, ay, az]: Vector, [bx, by, bz]: Vector) -> Vector {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

/// The length.
#[must_use]
pub fn length(a: Vector) -> f32 {
    math::sqrt(dot(a, a))
}

/// The distance between two points.
#[must_use]
pub fn distance(a: Vector, b: Vector) -> f32 {
    length(sub(a, b))
}

/// `a` at length 1; `None` when it has no direction.
#[must_use]
pub fn unit(a: Vector) -> Option<Vector> {
    let length = length(a);
    (length > 1e-6 && length.is_finite()).then(|| scale(a, 1.0 / length))
}

/// The angle between two directions, 0..=pi; exact to 1e-6 also near 0, where the arc cosine is not.
#[must_use]
pub fn angle(a: Vector, b: Vector) -> f32 {
    math::atan2(length(cross(a, b)), dot(a, b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_right_where_the_arc_cosine_is_not() {
        assert!((angle([1.0, 0.0, 0.0], [1.0, 1e-3, 0.0]) - 1e-3).abs() < 1e-8);
        assert!((angle([1.0, 0.0, 0.0], [-2.0, 0.0, 0.0]) - core::f32::consts::PI).abs() < 1e-6);
        assert!(
            (angle([0.0, 3.0, 0.0], [0.0, 0.0, 5.0]) - core::f32::consts::FRAC_PI_2).abs() < 1e-6
        );
    }

    #[test]
    fn what_has_no_direction_gives_none() {
        for bad in [0.0, f32::NAN, f32::INFINITY, 1e-9] {
            assert_eq!(unit([bad, 0.0, 0.0]), None);
        }
        assert_eq!(unit([0.0, 0.0, 4.0]), Some([0.0, 0.0, 1.0]));
        assert_eq!(cross([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
    }
}
