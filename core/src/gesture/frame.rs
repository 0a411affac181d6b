//! What a hand sensor saw at one moment.
//!
//! Right-handed coordinates of the sensor in millimetres; those of a Leap Motion have x to the
//! right, y up and z towards the person. Joints are named after the hand, not after a sensor: a
//! finger's *knuckle* is where it leaves the palm (the metacarpophalangeal joint), its *middle* the
//! next joint (proximal interphalangeal; the thumb's interphalangeal joint), its *tip* the end. The
//! outermost joint of a finger bends with its middle one, so it tells nothing new and is left out.

use serde::{Deserialize, Serialize};

use super::vector::{Vector, dot};

/// Number of fingers, thumb first.
pub const FINGERS: usize = 5;

/// Furthest coordinate in millimetres, the reach of 16 bits at 0.1 mm.
pub const FURTHEST: f32 = 3276.7;

/// Highest speed along one axis in mm/s, the reach of 16 bits.
pub const FASTEST: f32 = 32_767.0;

/// Which hand it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Side {
    /// The left hand.
    Left,
    /// The right hand.
    #[default]
    Right,
}

/// One finger that the sensor follows; points in millimetres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Finger {
    /// Where it leaves the palm.
    pub knuckle: Vector,
    /// Its middle joint.
    pub middle: Vector,
    /// Its end.
    pub tip: Vector,
}

/// A hand at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HandFrame {
    /// The sensor's clock in microseconds. It wraps after 71 minutes.
    pub time: u32,
    /// Which hand.
    pub side: Side,
    /// How sure the sensor is that it fits the hand, 0..=1.
    pub confidence: f32,
    /// How closed the hand is, 0..=1, by the sensor's own account.
    pub grab: f32,
    /// How near thumb and index are to touching, 0..=1, by the sensor's own account.
    pub pinch: f32,
    /// Middle of the palm, mm.
    pub palm: Vector,
    /// Velocity of the palm, mm/s.
    pub velocity: Vector,
    /// Unit vector out of the palm.
    pub normal: Vector,
    /// Unit vector from the palm towards the fingers.
    pub direction: Vector,
    /// Thumb, index, middle, ring, little finger; `None` for one that is not followed.
    pub fingers: [Option<Finger>; FINGERS],
}

/// A part of a [`HandFrame`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// [`HandFrame::confidence`]
    Confidence,
    /// [`HandFrame::grab`]
    Grab,
    /// [`HandFrame::pinch`]
    Pinch,
    /// [`HandFrame::palm`]
    Palm,
    /// [`HandFrame::velocity`]
    Velocity,
    /// [`HandFrame::normal`]
    Normal,
    /// [`HandFrame::direction`]
    Direction,
    /// A finger, counted from the thumb's 0.
    Finger(u8),
}

/// Why a frame was refused. Each names the part; a source that runs into one has its units, its
/// axes or its order of bytes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// Not a number, or infinite.
    NotFinite(Part),
    /// Outside the range that the part's documentation gives.
    OutOfRange(Part),
    /// A direction whose length is not 1 (to within a tenth).
    NotUnit(Part),
}

impl HandFrame {
    /// Checks what may have come from anywhere.
    ///
    /// # Errors
    /// The first [`FrameError`] found.
    pub fn check(&self) -> Result<(), FrameError> {
        for (value, part) in [
            (self.confidence, Part::Confidence),
            (self.grab, Part::Grab),
            (self.pinch, Part::Pinch),
        ] {
            within(&[value], 0.0..=1.0, part)?;
        }
        within(&self.palm, -FURTHEST..=FURTHEST, Part::Palm)?;
        within(&self.velocity, -FASTEST..=FASTEST, Part::Velocity)?;
        for (direction, part) in [
            (self.normal, Part::Normal),
            (self.direction, Part::Direction),
        ] {
            within(&direction, -1.1..=1.1, part)?;
            if !(0.81..=1.21).contains(&dot(direction, direction)) {
                return Err(FrameError::NotUnit(part));
            }
        }
        for (finger, part) in self.fingers.iter().zip((0..).map(Part::Finger)) {
            for point in finger.iter().flat_map(|f| [f.knuckle, f.middle, f.tip]) {
                within(&point, -FURTHEST..=FURTHEST, part)?;
            }
        }
        Ok(())
    }

    /// All five fingers, when all are followed.
    #[must_use]
    pub fn whole(&self) -> Option<[Finger; FINGERS]> {
        let [thumb, index, middle, ring, little] = self.fingers;
        Some([thumb?, index?, middle?, ring?, little?])
    }
}

fn within(
    values: &[f32],
    range: core::ops::RangeInclusive<f32>,
    part: Part,
) -> Result<(), FrameError> {
    for value in values {
        if !value.is_finite() {
            return Err(FrameError::NotFinite(part));
        }
        if !range.contains(value) {
            return Err(FrameError::OutOfRange(part));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame() -> HandFrame {
        HandFrame {
            normal: [0.0, -1.0, 0.0],
            direction: [0.0, 0.0, -1.0],
            fingers: [Some(Finger::default()); FINGERS],
            ..HandFrame::default()
        }
    }

    #[test]
    fn a_sound_frame_passes_and_a_bad_part_is_named() {
        assert_eq!(frame().check(), Ok(()));
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut f = frame();
            f.grab = bad;
            assert_eq!(f.check(), Err(FrameError::NotFinite(Part::Grab)));
            let mut f = frame();
            f.fingers[3].as_mut().unwrap().tip[1] = bad;
            assert_eq!(f.check(), Err(FrameError::NotFinite(Part::Finger(3))));
        }
        let mut f = frame();
        f.confidence = 1.01;
        assert_eq!(f.check(), Err(FrameError::OutOfRange(Part::Confidence)));
        let mut f = frame();
        f.palm[2] = 4000.0;
        assert_eq!(f.check(), Err(FrameError::OutOfRange(Part::Palm)));
        let mut f = frame();
        f.velocity[0] = -40_000.0;
        assert_eq!(f.check(), Err(FrameError::OutOfRange(Part::Velocity)));
        let mut f = frame();
        f.normal = [0.0; 3];
        assert_eq!(f.check(), Err(FrameError::NotUnit(Part::Normal)));
    }

    #[test]
    fn a_hand_with_a_missing_finger_is_not_whole() {
        let mut f = frame();
        assert!(f.whole().is_some());
        f.fingers[4] = None;
        assert!(f.whole().is_none());
        assert_eq!(f.check(), Ok(()));
    }
}
