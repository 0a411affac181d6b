//! How the joints have to stand for the hand to be somewhere: damped least squares from several
//! postures, with what is left of the seventh joint's freedom spent on staying near the middle of
//! the joints' ranges.
//!
//! Not the crate `k`: it brings a second `nalgebra` of 2022 and an URDF reader with it, and does not
//! keep to joint limits.

use nalgebra::{Matrix6, SMatrix, SVector, Vector3, Vector6};

use super::forward::skeleton;
use super::{Joints, Limits, Pose, READY};

/// How near the hand must come: metres.
const NEAR: f64 = 1e-7;

/// How near the hand's direction must come: radians.
const ALIGNED: f64 = 1e-6;

/// How often a posture is improved at most; from a neighbouring posture about 6 times are enough.
const ROUNDS: usize = 120;

/// The largest change of a joint in one round, in radians: beyond that the linear model is worthless.
const STRIDE: f64 = 0.3;

/// How far from its end every joint stays, in radians.
pub(super) const MARGIN: f64 = 0.02;

/// The angles for which the hand is at `target`, near `from` if there are several; `None` when the
/// arm does not get there within its limits.
#[must_use]
pub fn solve(target: &Pose, from: &Joints, limits: &Limits) -> Option<Joints> {
    if !target.translation.vector.iter().all(|x| x.is_finite()) {
        return None;
    }
    let place = target.translation.vector;
    let facing = place.y.atan2(place.x);
    let turned = |first: f64, third: f64, last: f64| {
        let mut posture = READY;
        let [q1, _, q3, .., q7] = &mut posture;
        (*q1, *q3, *q7) = (facing + first, third, last);
        posture
    };
    let [.., q7] = READY;
    let starts = [
        *from,
        turned(0.0, 0.0, q7),
        turned(0.0, 0.0, q7 - 1.57),
        turned(0.0, 0.0, q7 + 1.57),
        turned(0.6, -0.8, q7),
        turned(-0.6, 0.8, q7),
        turned(0.0, 0.0, -2.2),
        turned(1.0, -1.4, 0.0),
        turned(-1.0, 1.4, 0.0),
    ];
    starts
        .iter()
        .find_map(|start| descend(target, start, limits))
}

fn clamped(joints: &mut Joints, limits: &Limits) {
    let ends = limits.least.iter().zip(&limits.most);
    for (q, (least, most)) in joints.iter_mut().zip(ends) {
        *q = q.clamp(least + MARGIN, most - MARGIN);
    }
}

/// Where the hand is off, in metres and radians, in the base frame.
fn error(target: &Pose, hand: &Pose) -> Vector6<f64> {
    let place = target.translation.vector - hand.translation.vector;
    let turn = (target.rotation * hand.rotation.inverse()).scaled_axis();
    Vector6::new(place.x, place.y, place.z, turn.x, turn.y, turn.z)
}

fn descend(target: &Pose, start: &Joints, limits: &Limits) -> Option<Joints> {
    let mut joints = *start;
    clamped(&mut joints, limits);
    for _ in 0..ROUNDS {
        let arm = skeleton(&joints);
        let error = error(target, &arm.hand);
        let (place, turn) = (
            error.fixed_rows::<3>(0).norm(),
            error.fixed_rows::<3>(3).norm(),
        );
        if place < NEAR && turn < ALIGNED {
            return Some(joints);
        }
        let mut jacobian = SMatrix::<f64, 6, 7>::zeros();
        for (mut column, frame) in jacobian.column_iter_mut().zip(&arm.joints) {
            let axis = frame * Vector3::z();
            let lever = arm.hand.translation.vector - frame.translation.vector;
            column.fixed_rows_mut::<3>(0).copy_from(&axis.cross(&lever));
            column.fixed_rows_mut::<3>(3).copy_from(&axis);
        }
        // Far away the damping keeps the arm from thrashing near singular postures; near the target it
        // vanishes, so that the last rounds converge quadratically.
        let damping = (0.05 * error.norm()).min(0.05) + 1e-9;
        let square = jacobian * jacobian.transpose() + Matrix6::identity() * damping;
        let inverse = jacobian.transpose() * square.try_inverse()?;
        let mut comfort = SVector::<f64, 7>::zeros();
        let ends = limits.least.iter().zip(&limits.most);
        for ((c, q), (least, most)) in comfort.iter_mut().zip(&joints).zip(ends) {
            *c = 0.05 * ((least + most) / 2.0 - q);
        }
        // Only while the hand is far: in the end the null space must not move the hand any more.
        let spare = comfort * (place + turn).min(1.0);
        let step = inverse * error + spare - inverse * (jacobian * spare);
        let largest = step.amax();
        if !largest.is_finite() {
            return None;
        }
        let shorten = (STRIDE / largest).min(1.0);
        for (q, s) in joints.iter_mut().zip(step.iter()) {
            *q += shorten * s;
        }
        clamped(&mut joints, limits);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::panda::{FR3, PANDA, hand};
    use nalgebra::{Translation3, UnitQuaternion};
    use rand::{RngExt, SeedableRng};

    fn off(target: &Pose, joints: &Joints) -> (f64, f64) {
        let error = error(target, &hand(joints));
        (
            error.fixed_rows::<3>(0).norm(),
            error.fixed_rows::<3>(3).norm(),
        )
    }

    fn downwards(x: f64, y: f64, z: f64, yaw: f64) -> Pose {
        let down = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), core::f64::consts::PI);
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw);
        Pose::from_parts(Translation3::new(x, y, z), turn * down)
    }

    #[test]
    fn the_hand_gets_everywhere_over_the_table() {
        let (mut asked, mut worst) = (0, 0.0_f64);
        for limits in [PANDA, FR3, PANDA.shared_with(&FR3)] {
            for i in 0..8 {
                for j in 0..9 {
                    for z in [0.02, 0.1, 0.2, 0.3] {
                        let (x, y) = (0.32 + 0.04 * f64::from(i), -0.4 + 0.1 * f64::from(j));
                        if x.hypot(y) > 0.66 {
                            continue;
                        }
                        let target = downwards(x, y, z, 0.0);
                        let joints = solve(&target, &READY, &limits)
                            .unwrap_or_else(|| panic!("({x}, {y}, {z})"));
                        assert!(limits.hold(&joints, 0.01));
                        worst = worst.max(off(&target, &joints).0);
                        asked += 1;
                    }
                }
            }
        }
        assert!(asked > 500 && worst < 1e-3, "{asked} poses, {worst} m");
    }

    #[test]
    fn where_an_arm_is_it_can_get_to() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(4);
        let (mut solved, all) = (0, 300);
        for _ in 0..all {
            let mut joints = READY;
            let ends = PANDA.least.iter().zip(&PANDA.most);
            for (q, (least, most)) in joints.iter_mut().zip(ends) {
                let part = 0.1 + 0.8 * random.random::<f64>();
                *q = least + part * (most - least);
            }
            let target = hand(&joints);
            if let Some(found) = solve(&target, &READY, &PANDA) {
                let (place, turn) = off(&target, &found);
                assert!(place < 1e-3 && turn < 1e-3 && PANDA.hold(&found, 0.01));
                solved += 1;
            }
        }
        assert!(solved * 10 > all * 9, "{solved} of {all}");
    }

    #[test]
    fn where_it_cannot_get_there_is_no_answer() {
        for (x, y, z) in [
            (1.2, 0.0, 0.1),
            (0.0, 0.0, 2.0),
            (0.84, 0.42, 0.12),
            (f64::NAN, 0.0, 0.1),
        ] {
            assert_eq!(solve(&downwards(x, y, z, 0.0), &READY, &PANDA), None);
        }
    }
}
