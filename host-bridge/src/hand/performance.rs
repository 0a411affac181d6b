//! Performances of dynamic gestures: the strokes that the unit would see.

use deictic_core::gesture::counters::SampleCounters;
use deictic_core::gesture::movement::Movement;
use deictic_core::gesture::path;
use deictic_core::gesture::tracking::{Step, Tracking};
use deictic_core::gesture::wire::Sample;
use deictic_core::time::Micros;

/// One performance of a gesture.
#[derive(Clone, Debug)]
pub struct Performance {
    /// Who performed it.
    pub subject: String,
    /// Which gesture it is.
    pub gesture: String,
    /// Its stroke as the unit sees it; `None` when the palm hardly moved.
    pub stroke: Option<path::Stroke>,
}

/// The stroke that the unit makes of points (ms, mm), by the very steps of the unit.
pub fn stroke(points: impl Iterator<Item = (f64, [f64; 3])>) -> Option<path::Stroke> {
    let mut path = path::Path::new();
    let mut first = None;
    for (t, point) in points {
        let since = t - *first.get_or_insert(t);
        path.push(
            Micros((since.max(0.0) * 1e3) as u64),
            point.map(|x| x as f32),
        );
    }
    path.stroke()
}

/// The strokes of a recording, found as the unit finds them.
#[must_use]
pub fn strokes(samples: &[Sample]) -> Vec<path::Stroke> {
    let mut tracking = Tracking::new();
    let mut counters = SampleCounters::ZERO;
    let mut movement = Movement::new();
    let mut strokes = Vec::new();
    for sample in samples {
        match (tracking.take(Micros(0), sample, &mut counters), sample) {
            (Step::There(_), Sample::Hand(frame)) => {
                strokes.extend(movement.ended(tracking.clock(), frame, true));
            }
            (Step::Left, _) => movement.clear(),
            _ => {}
        }
    }
    strokes
}
