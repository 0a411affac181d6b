//! Where the arm's parts are when its joints stand so and so.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use nalgebra::{Isometry3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::{Joints, Pose};

/// Denavit-Hartenberg parameters in Craig's convention: `a` and `d` in metres, `alpha` in radians
/// (Franka Control Interface documentation; the FR3 has the same).
struct Link {
    a: f64,
    d: f64,
    alpha: f64,
}

const fn link(a: f64, d: f64, alpha: f64) -> Link {
    Link { a, d, alpha }
}

const LINKS: [Link; 7] = [
    link(0.0, 0.333, 0.0),
    link(0.0, 0.0, -FRAC_PI_2),
    link(0.0, 0.316, FRAC_PI_2),
    link(0.0825, 0.0, FRAC_PI_2),
    link(-0.0825, 0.384, -FRAC_PI_2),
    link(0.0, 0.0, FRAC_PI_2),
    link(0.088, 0.0, FRAC_PI_2),
];

/// From the last joint to the flange, in metres.
const FLANGE: f64 = 0.107;

/// From the flange to the middle between the finger tips, in metres (Franka Hand, data sheet).
const FINGERS: f64 = 0.1034;

/// The frames of an arm: base, seven joints, flange, and the middle between its finger tips.
#[derive(Clone, Debug)]
pub struct Skeleton {
    /// The frame of every joint; a joint turns about its frame's z.
    pub joints: [Pose; 7],
    /// Where the hand is mounted.
    pub flange: Pose,
    /// The middle between the finger tips: z is where the fingers point, y is along which they open.
    pub hand: Pose,
}

/// All frames for these angles.
#[must_use]
pub fn skeleton(angles: &Joints) -> Skeleton {
    let mut frame = Pose::identity();
    let mut joints = [frame; 7];
    for ((link, angle), joint) in LINKS.iter().zip(angles).zip(&mut joints) {
        frame *= Isometry3::rotation(Vector3::x() * link.alpha)
            * Translation3::new(link.a, 0.0, 0.0)
            * Isometry3::rotation(Vector3::z() * *angle)
            * Translation3::new(0.0, 0.0, link.d);
        *joint = frame;
    }
    let flange = frame * Translation3::new(0.0, 0.0, FLANGE);
    let turned = UnitQuaternion::from(Rotation3::from_axis_angle(&Vector3::z_axis(), -FRAC_PI_4));
    let hand = flange * turned * Translation3::new(0.0, 0.0, FINGERS);
    Skeleton {
        joints,
        flange,
        hand,
    }
}

/// The middle between the finger tips for these angles.
#[must_use]
pub fn hand(angles: &Joints) -> Pose {
    skeleton(angles).hand
}

impl Skeleton {
    /// The points a stick figure of the arm goes through, from its foot to its finger tips.
    #[must_use]
    pub fn line(&self) -> Vec<Point3<f64>> {
        let origin = Point3::origin();
        let [_, shoulder, upper, elbow, _, wrist, last] = &self.joints;
        vec![
            origin,
            shoulder * origin,
            upper * origin,
            elbow * origin,
            elbow * Point3::new(-0.0825, 0.0, 0.0),
            wrist * origin,
            last * origin,
            self.flange * origin,
            self.hand * origin,
        ]
    }

    /// How low the arm's foremost parts get, in metres above the table: the finger tips, the flange
    /// and the joints behind it, less how thick the arm is there.
    #[must_use]
    pub fn lowest(&self) -> f64 {
        let height = |frame: &Pose| frame.translation.z;
        let [.., elbow, wrist, last] = &self.joints;
        let thick = [elbow, wrist, last].map(|f| height(f) - 0.06);
        let thin = [height(&self.flange) - 0.04, height(&self.hand)];
        let all = thick.into_iter().chain(thin);
        all.fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::panda::READY;

    #[test]
    fn the_ready_posture_is_where_the_maker_says() {
        let pose = hand(&READY);
        let place = pose.translation.vector;
        assert!((place - Vector3::new(0.306_89, 0.0, 0.486_88)).norm() < 1e-4);
        let down = pose * Vector3::z();
        assert!((down + Vector3::z()).norm() < 1e-9, "{down}");
    }

    #[test]
    fn stretched_straight_up_the_flange_is_above_the_foot() {
        let joints = skeleton(&[0.0; 7]);
        let flange = joints.flange.translation.vector;
        let expected = Vector3::new(0.088, 0.0, 0.333 + 0.316 + 0.384 - 0.107);
        assert!((flange - expected).norm() < 1e-9, "{flange}");
    }

    #[test]
    fn the_stick_figure_starts_at_the_foot_and_ends_at_the_fingers() {
        let skeleton = skeleton(&READY);
        let line = skeleton.line();
        assert_eq!(line.first(), Some(&Point3::origin()));
        let tips = Point3::from(skeleton.hand.translation.vector);
        assert!((line.last().unwrap() - tips).norm() < 1e-9);
    }
}
