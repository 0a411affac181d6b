//! From a palm that moves to strokes: where a movement begins and ends, and what it may be.

use super::frame::HandFrame;
use super::mapping::STROKES;
use super::path::{Path, Stroke};
use super::stroke::{Comparison, Likely, Templates};
use super::vector::{self, Vector};
use crate::time::Micros;

/// A palm slower than this, mm/s, rests.
const RESTING: f32 = 100.0;

/// A movement that never gets faster than this, mm/s, is no gesture but a hand being moved.
const GESTURING: f32 = 300.0;

/// What a palm's speed is averaged over, s: the jitter of a sensor that tells velocities from frame to frame is not
/// the hand's, nor is its tremor of some 9 Hz.
const STEADY: f32 = 0.04;

/// A palm that rests for this long has ended its movement; shorter rests are turning points.
const PAUSE: Micros = Micros::from_millis(90);

/// A movement that begins so soon after the hand has come is its coming.
const ARRIVAL: Micros = Micros::from_millis(250);

/// Movements longer than this are no gestures.
const LONGEST: Micros = Micros::from_millis(4_000);

/// Templates compared per frame: at most 4,000 instructions each.
const PER_FRAME: usize = 8;

/// Follows a palm.
#[derive(Debug)]
pub struct Movement {
    path: Path,
    /// Whether it has been fast enough for a gesture.
    fast: bool,
    /// Since when it rests.
    resting: Option<Micros>,
    /// Its velocity, averaged, mm/s, and when that was.
    velocity: Vector,
    at: Micros,
    /// When the hand came.
    came: Option<Micros>,
    comparison: Option<Comparison<STROKES>>,
}

impl Default for Movement {
    fn default() -> Self {
        Self::new()
    }
}

impl Movement {
    /// A palm that has not moved.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            path: Path::new(),
            fast: false,
            resting: None,
            velocity: [0.0; 3],
            at: Micros(0),
            came: None,
            comparison: None,
        }
    }

    /// The hand has left, in the middle of whatever it did.
    pub fn clear(&mut self) {
        self.restart();
        self.came = None;
        self.comparison = None;
    }

    /// Takes one frame. Movements of a hand that may not gesture now (`free` is false), as it points
    /// or is closed, are left out. Gives what a movement may have been some frames after its end.
    pub fn follow(
        &mut self,
        clock: Micros,
        frame: &HandFrame,
        free: bool,
        templates: &Templates<'_>,
    ) -> Option<Likely<STROKES>> {
        if let Some(stroke) = self.ended(clock, frame, free) {
            self.comparison = Some(Comparison::new(stroke));
            return None;
        }
        let likely = self.comparison.as_mut()?.step(templates, PER_FRAME)?;
        self.comparison = None;
        Some(likely)
    }

    /// Takes one frame, and gives the stroke of a movement that may be a gesture when it has ended.
    pub fn ended(&mut self, clock: Micros, frame: &HandFrame, free: bool) -> Option<Stroke> {
        let came = *self.came.get_or_insert(clock);
        let speed = self.speed(clock, frame.velocity);
        if !free {
            self.restart();
        } else if speed > RESTING {
            self.resting = None;
            self.fast |= speed > GESTURING;
            self.path.push(clock, frame.palm);
        } else if !self.path.is_empty() {
            let since = *self.resting.get_or_insert(clock);
            if clock.since(since) >= PAUSE {
                return self.end(came);
            }
        }
        None
    }

    /// How fast the palm is, tremor and jitter apart.
    fn speed(&mut self, clock: Micros, velocity: Vector) -> f32 {
        let seconds = clock.since(self.at).0 as f32 * 1e-6;
        self.at = clock;
        let share = seconds / (STEADY + seconds);
        let change = vector::sub(velocity, self.velocity);
        self.velocity = vector::add(self.velocity, vector::scale(change, share));
        vector::length(self.velocity)
    }

    fn restart(&mut self) {
        self.path.clear();
        self.fast = false;
        self.resting = None;
    }

    fn end(&mut self, came: Micros) -> Option<Stroke> {
        let begun = self.path.begun();
        let rested = self.resting.unwrap_or(begun);
        let gesture = self.fast && begun.since(came) >= ARRIVAL && rested.since(begun) <= LONGEST;
        let stroke = if gesture { self.path.stroke() } else { None };
        self.restart();
        stroke
    }
}
