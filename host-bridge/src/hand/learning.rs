//! Examples of dynamic gestures from recordings: which strokes stand for a gesture.

use std::collections::BTreeSet;

use deictic_core::gesture::counters::SampleCounters;
use deictic_core::gesture::movement::Movement;
use deictic_core::gesture::path;
use deictic_core::gesture::template::{Scale, Template};
use deictic_core::gesture::tracking::{Step, Tracking};
use deictic_core::gesture::wire::Sample;
use deictic_core::time::Micros;
use thiserror::Error;

use super::examples::Examples;
use super::fitting::{Fitted, fitted};

/// As many gestures as one comparison tells apart here.
pub const GESTURES_AT_MOST: usize = 64;

/// Why nothing can be learned.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum LearningError {
    /// There is no stroke.
    #[error("no movement to learn from")]
    Nothing,
    /// More gestures than are told apart.
    #[error("{0} gestures; at most {GESTURES_AT_MOST} are told apart")]
    TooMany(usize),
}

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

/// What the unit needs to recognise gestures.
#[derive(Clone, Debug)]
pub struct Learned {
    /// Names, by the templates' numbers.
    pub gestures: Vec<String>,
    /// Examples of each.
    pub templates: Vec<Template>,
    /// How distances become probabilities.
    pub scale: Scale,
}

/// Learns templates: every performance is one, or, where there are more than `each` of a gesture,
/// the ones that lie in the middle of the others.
///
/// # Errors
/// When there is nothing to learn, or too much for the unit.
pub fn learn(performances: &[&Performance], each: usize) -> Result<Learned, LearningError> {
    let seen: Vec<&Performance> = performances
        .iter()
        .filter(|p| p.stroke.is_some())
        .copied()
        .collect();
    let names: BTreeSet<&str> = seen.iter().map(|p| p.gesture.as_str()).collect();
    let gestures: Vec<String> = names.into_iter().map(str::to_owned).collect();
    if gestures.is_empty() {
        return Err(LearningError::Nothing);
    }
    if gestures.len() > GESTURES_AT_MOST {
        return Err(LearningError::TooMany(gestures.len()));
    }
    let examples = Examples::new(&seen, &gestures);
    let Fitted { scale, tolerances } = fitted(&examples, each);
    let mut templates = Vec::new();
    for ((gesture, tolerance), number) in tolerances.iter().enumerate().zip(0_u8..) {
        let chosen = examples.middles(&examples.of(gesture), each);
        let strokes = chosen.iter().map(|i| &examples.strokes[*i]);
        templates.extend(strokes.map(|stroke| Template {
            tolerance: *tolerance,
            ..Template::new(number, stroke)
        }));
    }
    Ok(Learned {
        gestures,
        templates,
        scale,
    })
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
