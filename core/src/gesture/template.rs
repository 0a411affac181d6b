//! Examples of dynamic gestures, small enough to be sent and flashed, and how far from them a stroke may be.

use serde::{Deserialize, Serialize};

use super::path::{POINTS, Stroke};

/// Steps of a template's numbers per unit; 127 steps reach 2.6, further than points of strokes get
/// that are not needles.
pub const STEPS: f32 = 48.0;

/// The tolerance of a gesture that people perform alike.
pub const PLAIN: u8 = 16;

/// One example of a gesture, 60 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Template {
    /// Which gesture it is an example of.
    pub gesture: u8,
    /// How much further than others strokes of this gesture may lie from it, in sixteenths: people
    /// perform some gestures less alike than others.
    pub tolerance: u8,
    /// A stroke's directness in steps of 1/255.
    pub direct: u8,
    /// A stroke's points in steps of 1/48.
    pub points: [[i8; 3]; POINTS],
    /// Logarithm of its length, mm.
    pub ln_length: f32,
    /// Logarithm of its duration, s.
    pub ln_seconds: f32,
}

impl Template {
    /// The template that this stroke is.
    #[must_use]
    pub fn new(gesture: u8, stroke: &Stroke) -> Self {
        Self {
            gesture,
            tolerance: PLAIN,
            direct: (stroke.direct * 255.0) as u8,
            points: stroke.points.map(|p| p.map(|x| (x * STEPS) as i8)),
            ln_length: stroke.ln_length,
            ln_seconds: stroke.ln_seconds,
        }
    }
}

/// How distances become probabilities; found in training.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scale {
    /// A warped distance (squared, per point) that makes a gesture e times less probable.
    pub shape: f32,
    /// What a factor of e in length weighs against the shape.
    pub length: f32,
    /// What a factor of e in duration weighs against the shape.
    pub seconds: f32,
    /// The distance at which *none of these* is as probable as the gesture.
    pub reach: f32,
}
