//! Static gestures: which shape the fingers make.
//!
//! Features are the 15 distances among the five fingertips and the palm over the mean of the five
//! between palm and fingertips, so hands of all sizes, left and right, in any place and turn, give
//! the same ones (idea and data: the toolbox of the paper's authors). A small network turns them
//! into a probability per shape, one of which is *none of these*.

use super::frame::HandFrame;
use super::vector::distance;
use crate::math;

/// A shape of the hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Shape {
    /// A fist or a claw; separates words.
    Grab,
    /// Thumb and index touch, the others are straight.
    Pinch,
    /// The index alone is straight, the thumb is where it likes; opens a target word.
    Point,
    /// Index and middle finger.
    Two,
    /// Thumb, index and middle finger.
    Three,
    /// All but the thumb.
    Four,
    /// All.
    Five,
    /// The thumb alone.
    ThumbsUp,
    /// None of these.
    None,
}

/// How many shapes are told apart, *none of these* included.
pub const SHAPES: usize = 9;

/// How many features describe a shape.
pub const FEATURES: usize = 15;

impl Shape {
    /// All of them, in the order of probabilities.
    pub const ALL: [Self; SHAPES] = [
        Self::Grab,
        Self::Pinch,
        Self::Point,
        Self::Two,
        Self::Three,
        Self::Four,
        Self::Five,
        Self::ThumbsUp,
        Self::None,
    ];

    /// Its name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Grab => "grab",
            Self::Pinch => "pinch",
            Self::Point => "point",
            Self::Two => "two",
            Self::Three => "three",
            Self::Four => "four",
            Self::Five => "five",
            Self::ThumbsUp => "thumbsup",
            Self::None => "none",
        }
    }
}

/// Why a hand has no features.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeError {
    /// A finger is not followed, counted from the thumb's 0.
    MissingFinger(u8),
    /// All fingertips lie in the palm, or a coordinate is not finite.
    Degenerate,
}

/// Distances in the order thumb-index, thumb-middle, thumb-ring, thumb-little, thumb-palm,
/// index-middle, ..., little-palm, over the mean of those to the palm.
///
/// # Errors
/// [`ShapeError`]
pub fn features(frame: &HandFrame) -> Result<[f32; FEATURES], ShapeError> {
    let mut points = [frame.palm; 6];
    for ((point, finger), number) in points.iter_mut().zip(&frame.fingers).zip(0..) {
        *point = finger.ok_or(ShapeError::MissingFinger(number))?.tip;
    }
    let mut distances = [0.0; FEATURES];
    let mut places = distances.iter_mut();
    for (i, a) in points.iter().enumerate() {
        for b in points.iter().skip(i.saturating_add(1)) {
            if let Some(place) = places.next() {
                *place = distance(*a, *b);
            }
        }
    }
    of_distances(&distances)
}

/// Features of 15 distances in any one unit, ordered as [`features`] gives them.
///
/// # Errors
/// [`ShapeError::Degenerate`]
pub fn of_distances(distances: &[f32; FEATURES]) -> Result<[f32; FEATURES], ShapeError> {
    let &[
        _,
        _,
        _,
        _,
        thumb,
        _,
        _,
        _,
        index,
        _,
        _,
        middle,
        _,
        ring,
        little,
    ] = distances;
    let mean = (thumb + index + middle + ring + little) / 5.0;
    // The comparison is false for NaN.
    if mean > 1e-3 && distances.iter().all(|d| d.is_finite()) {
        Ok(distances.map(|d| d / mean))
    } else {
        Err(ShapeError::Degenerate)
    }
}

/// Units between features and shapes.
pub const HIDDEN: usize = 20;

/// A trained network: features, [`HIDDEN`] units with the activation x / (1 + |x|), a softmax over
/// shapes. Each row ends with its bias. With the features before it and the evidence after it it takes
/// 6,000 instructions on a Cortex-M4F.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    /// A row per hidden unit.
    pub hidden: [[f32; FEATURES + 1]; HIDDEN],
    /// A row per shape.
    pub output: [[f32; HIDDEN + 1]; SHAPES],
}

impl Network {
    /// The probability of every shape; they sum to 1. Total: features that are not finite give
    /// certainty of *none of these*.
    #[must_use]
    pub fn classify(&self, features: &[f32; FEATURES]) -> [f32; SHAPES] {
        let mut hidden = [0.0; HIDDEN];
        for (unit, row) in hidden.iter_mut().zip(&self.hidden) {
            let x = affine(row, features);
            *unit = x / (1.0 + x.abs());
        }
        let mut scores = [0.0; SHAPES];
        for (score, row) in scores.iter_mut().zip(&self.output) {
            *score = affine(row, &hidden);
        }
        softmax(scores)
    }
}

fn affine(row: &[f32], x: &[f32]) -> f32 {
    let bias = row.last().copied().unwrap_or_default();
    row.iter().zip(x).fold(bias, |sum, (w, x)| sum + w * x)
}

fn softmax(scores: [f32; SHAPES]) -> [f32; SHAPES] {
    let top = scores.into_iter().fold(f32::NEG_INFINITY, f32::max);
    let powers = scores.map(|s| math::exp(s - top));
    let sum: f32 = powers.iter().sum();
    if sum >= 1.0 && sum.is_finite() {
        powers.map(|p| p / sum)
    } else {
        let mut certain = [0.0; SHAPES];
        if let Some(none) = certain.last_mut() {
            *none = 1.0;
        }
        certain
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gesture::frame::Finger;
    use crate::gesture::shape_table::NETWORK;
    use proptest::prelude::*;

    /// Fingertips of a straight hand of middle size, palm at the origin.
    const FIVE: [[f32; 3]; 5] = [
        [5.0, 96.0, 3.0],
        [96.0, 25.0, 25.0],
        [104.0, -8.0, 25.0],
        [95.0, -40.0, 25.0],
        [60.0, -70.0, 28.0],
    ];

    fn hand(tips: [[f32; 3]; 5]) -> HandFrame {
        HandFrame {
            fingers: tips.map(|tip| {
                Some(Finger {
                    tip,
                    ..Finger::default()
                })
            }),
            ..HandFrame::default()
        }
    }

    #[test]
    fn an_open_hand_is_five_whatever_its_size() {
        for size in [0.6, 1.0, 1.3] {
            let features = features(&hand(FIVE.map(|tip| tip.map(|x| x * size)))).unwrap();
            let p = NETWORK.classify(&features);
            assert!(p[Shape::Five as usize] > 0.9, "{p:?}");
        }
    }

    #[test]
    fn a_hand_without_features_is_named() {
        let mut frame = hand(FIVE);
        frame.fingers[3] = None;
        assert_eq!(features(&frame), Err(ShapeError::MissingFinger(3)));
        assert_eq!(features(&hand([[0.0; 3]; 5])), Err(ShapeError::Degenerate));
        let mut tips = FIVE;
        tips[2][1] = f32::NAN;
        assert_eq!(features(&hand(tips)), Err(ShapeError::Degenerate));
    }

    #[test]
    fn shapes_are_numbered_in_the_order_of_their_probabilities() {
        for (i, shape) in Shape::ALL.into_iter().enumerate() {
            assert_eq!(shape as usize, i);
        }
    }

    proptest! {
        #[test]
        fn features_do_not_depend_on_place_turn_side_and_size(
            tips in prop::array::uniform5(prop::array::uniform3(-100.0_f32..100.0)),
            by in prop::array::uniform3(-300.0_f32..300.0),
            size in 0.5_f32..2.0,
        ) {
            prop_assume!(tips.iter().any(|t| t.iter().any(|x| x.abs() > 20.0)));
            let there = tips.map(|[x, y, z]| {
                // A quarter turn about y and a reflection, then a shift.
                [z * size + by[0], y * size + by[1], x * size + by[2]]
            });
            let mut moved = hand(there);
            moved.palm = by;
            let (a, b) = (features(&hand(tips)).unwrap(), features(&moved).unwrap());
            for (a, b) in a.iter().zip(b) {
                prop_assert!((a - b).abs() < 2e-3, "{} {}", a, b);
            }
        }

        #[test]
        fn any_numbers_give_probabilities(features in prop::array::uniform15(any::<f32>())) {
            let p = NETWORK.classify(&features);
            prop_assert!(p.iter().all(|p| (0.0..=1.0).contains(p)), "{:?}", p);
            prop_assert!((p.iter().sum::<f32>() - 1.0).abs() < 1e-5);
            if features.iter().any(|x| x.is_nan()) {
                prop_assert_eq!(p[Shape::None as usize], 1.0);
            }
        }
    }
}
