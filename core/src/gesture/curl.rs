//! Which fingers are folded, by their joints, and what that leaves of the shapes.
//!
//! The tips alone ([`super::shape`]) tell a fist with a thumb here or there badly from a pinch or a
//! thumb up. The joints tell folded from straight fingers: between the bone next to the knuckle and
//! the line from the middle joint to the tip, straight fingers of recorded hands have at most 28
//! degrees, those of a pinch 68 (index) and 45 (ring, little), folded ones 60 to 118 (leapjs-playback's
//! grab, gun, pinch, claps). The thumb bends less; what tells is how far its tip is from the palm, in
//! units of the index knuckle's distance from it: 1.7 to 2.1 in recorded fists, 2.8 to 3.7 where it is
//! stretched out.

use super::frame::{FINGERS, Finger, HandFrame};
use super::shape::SHAPES;
use super::vector;
use crate::math;

/// Up to this cosine a finger is surely folded (75 degrees).
const FOLDED: f32 = 0.26;

/// From this cosine on a finger is surely straight (40 degrees).
const STRAIGHT: f32 = 0.77;

/// Up to this ratio a thumb is surely folded.
const THUMB_FOLDED: f32 = 2.2;

/// From this ratio on a thumb is surely stretched out.
const THUMB_STRAIGHT: f32 = 2.9;

/// What a shape is left with that the fingers rule out: a sensor errs about joints that it does not
/// see.
const DOUBT: f32 = 0.02;

/// How a shape holds a finger.
#[derive(Clone, Copy, PartialEq)]
enum Held {
    Folded,
    Straight,
    Any,
}
use Held::{Any, Folded as F, Straight as S};

/// The fingers of each shape, thumb first, in the order of probabilities. A pinch's middle finger
/// follows its index; the thumb of a hand at rest hangs.
const HELD: [[Held; FINGERS]; SHAPES - 1] = [
    [F, F, F, F, F],
    [Any, Any, Any, S, S],
    [Any, S, F, F, F],
    [F, S, S, F, F],
    [S, S, S, F, F],
    [F, S, S, S, S],
    [Any, S, S, S, S],
    [S, F, F, F, F],
];

/// How far a finger is folded, 0..=1, by its joints; `None` when they lie in one place, as those of a
/// sensor that follows tips only.
#[must_use]
pub fn folded(finger: &Finger) -> Option<f32> {
    let inner = vector::sub(finger.middle, finger.knuckle);
    let outer = vector::sub(finger.tip, finger.middle);
    let lengths = vector::dot(inner, inner) * vector::dot(outer, outer);
    // The comparison is false for NaN.
    (lengths > 1.0).then(|| folded_by(vector::dot(inner, outer) / math::sqrt(lengths)))
}

/// How far a finger is folded, 0..=1, by the cosine of the angle between the bone next to the knuckle
/// and the line from the middle joint to the tip.
#[must_use]
pub fn folded_by(cosine: f32) -> f32 {
    smooth((STRAIGHT - cosine) / (STRAIGHT - FOLDED))
}

/// How far the thumb is folded, 0..=1; `None` without thumb or index.
#[must_use]
pub fn thumb_folded(frame: &HandFrame) -> Option<f32> {
    let [thumb, index, ..] = frame.fingers;
    let reach = vector::distance(thumb?.tip, frame.palm);
    let size = vector::distance(index?.knuckle, frame.palm);
    // The comparison is false for NaN.
    (size > 1.0).then(|| smooth((THUMB_STRAIGHT - reach / size) / (THUMB_STRAIGHT - THUMB_FOLDED)))
}

/// From 0 to 1 without corners.
fn smooth(x: f32) -> f32 {
    let x = math::clamp_unit(x);
    x * x * (3.0 - 2.0 * x)
}

/// How far each finger is folded, thumb first.
#[must_use]
pub fn folds(frame: &HandFrame) -> [Option<f32>; FINGERS] {
    let [_, others @ ..] = &frame.fingers;
    let mut folds = [None; FINGERS];
    let [thumb, rest @ ..] = &mut folds;
    *thumb = thumb_folded(frame);
    for (fold, finger) in rest.iter_mut().zip(others) {
        *fold = finger.as_ref().and_then(folded);
    }
    folds
}

/// Makes shapes less probable that the fingers, folded so, rule out; and none of them, when the fingers
/// are held as for one. With [`folds`] about 1,200 instructions.
pub fn rule_out(probabilities: &mut [f32; SHAPES], fold: &[Option<f32>; FINGERS]) {
    let [shapes @ .., none] = probabilities;
    let (mut best, mut sum) = (0.0, 0.0);
    for (p, held) in shapes.iter_mut().zip(&HELD) {
        let fit = fit(fold, held);
        // A pinch is what its tips make of it.
        if is_known(fold, held) && !held.starts_with(&[Any, Any]) && fit > best {
            best = fit;
        }
        *p *= left(fit);
        sum += *p;
    }
    *none *= left(1.0 - best);
    sum += *none;
    if sum > 0.0 {
        for p in probabilities {
            *p /= sum;
        }
    }
}

/// What a shape is left with that fits this well.
fn left(fit: f32) -> f32 {
    DOUBT + (1.0 - DOUBT) * fit
}

/// Whether all fingers that matter for a shape are known.
fn is_known(fold: &[Option<f32>; FINGERS], shape: &[Held; FINGERS]) -> bool {
    let fingers = fold.iter().zip(shape);
    fingers.fold(true, |known, (fold, held)| {
        known && (fold.is_some() || *held == Any)
    })
}

/// How well fingers that are folded so fit a shape, 0..=1. Those that are not known fit any.
fn fit(fold: &[Option<f32>; FINGERS], shape: &[Held; FINGERS]) -> f32 {
    let mut fit = 1.0;
    for (fold, held) in fold.iter().zip(shape) {
        fit *= match (fold, held) {
            (None, _) | (_, Any) => 1.0,
            (Some(fold), F) => *fold,
            (Some(fold), S) => 1.0 - fold,
        };
    }
    fit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gesture::shape::Shape;
    use proptest::prelude::*;

    /// A hand whose index has 30 mm from the palm to its knuckle, and whose fingers are folded or not.
    fn hand(folds: [bool; FINGERS]) -> HandFrame {
        let mut frame = HandFrame::default();
        for (i, (finger, fold)) in frame.fingers.iter_mut().zip(folds).enumerate() {
            let y = 20.0 - 13.0 * i as f32;
            let tip = match (i, fold) {
                (0, true) => [30.0, 40.0, 0.0],
                (0, false) => [30.0, 90.0, 0.0],
                (_, true) => [55.0, y, 30.0],
                (_, false) => [100.0, y, 5.0],
            };
            *finger = Some(Finger {
                knuckle: [29.0, y, 0.0],
                middle: [65.0, y, 5.0],
                tip,
            });
        }
        frame
    }

    fn ruled(folds: [bool; FINGERS]) -> [f32; SHAPES] {
        let mut p = [1.0 / SHAPES as f32; SHAPES];
        rule_out(&mut p, &super::folds(&hand(folds)));
        p
    }

    #[test]
    fn the_joints_leave_the_shapes_that_the_fingers_make() {
        let (o, f) = (false, true);
        for (folds, shape) in [
            ([f, f, f, f, f], Shape::Grab),
            ([o, f, f, f, f], Shape::ThumbsUp),
            ([o, o, f, f, f], Shape::Point),
            ([f, o, f, f, f], Shape::Point),
            ([f, o, o, f, f], Shape::Two),
            ([o, o, o, f, f], Shape::Three),
        ] {
            let p = ruled(folds);
            assert!(p[shape as usize] > 0.8, "{shape:?} {p:?}");
        }
        // What is no shape stays none; what may be several stays open.
        assert!(ruled([o, f, f, f, o])[Shape::None as usize] > 0.8);
        let flat = ruled([o, o, o, o, o]);
        assert!((flat[Shape::Five as usize] - flat[Shape::Pinch as usize]).abs() < 1e-6);
    }

    #[test]
    fn without_joints_nothing_is_ruled_out() {
        let frame = HandFrame {
            fingers: [Some(Finger::default()); FINGERS],
            ..HandFrame::default()
        };
        let mut p = [1.0 / SHAPES as f32; SHAPES];
        rule_out(&mut p, &folds(&frame));
        assert!(
            p.iter().all(|p| (p - 1.0 / SHAPES as f32).abs() < 1e-6),
            "{p:?}"
        );
    }

    proptest! {
        #[test]
        fn any_joints_leave_probabilities(
            points in prop::array::uniform5(prop::array::uniform3(prop::array::uniform3(any::<f32>()))),
        ) {
            let finger = |[knuckle, middle, tip]: [_; 3]| Some(Finger { knuckle, middle, tip });
            let frame = HandFrame {
                fingers: points.map(finger),
                ..HandFrame::default()
            };
            let mut p = [1.0 / SHAPES as f32; SHAPES];
            rule_out(&mut p, &folds(&frame));
            let sum: f32 = p.iter().sum();
            prop_assert!((sum - 1.0).abs() < 1e-4, "{:?}", p);
        }
    }
}
