//! Examples of dynamic gestures from recordings: which strokes stand for a gesture, and how distances
//! from them become probabilities.

use std::collections::{BTreeMap, BTreeSet};

use deictic_core::gesture::counters::SampleCounters;
use deictic_core::gesture::movement::Movement;
use deictic_core::gesture::path;
use deictic_core::gesture::stroke::{Scale, Template, distance};
use deictic_core::gesture::tracking::{Step, Tracking};
use deictic_core::gesture::wire::Sample;
use deictic_core::time::Micros;
use rayon::prelude::*;
use thiserror::Error;

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
    let names: BTreeSet<&str> = performances
        .iter()
        .filter(|p| p.stroke.is_some())
        .map(|p| p.gesture.as_str())
        .collect();
    let gestures: Vec<String> = names.into_iter().map(str::to_owned).collect();
    if gestures.is_empty() {
        return Err(LearningError::Nothing);
    }
    if gestures.len() > GESTURES_AT_MOST {
        return Err(LearningError::TooMany(gestures.len()));
    }
    let scale = fitted(performances);
    let mut templates = Vec::new();
    for (name, number) in gestures.iter().zip(0_u8..) {
        let strokes: Vec<path::Stroke> = performances
            .iter()
            .filter(|p| p.gesture == *name)
            .filter_map(|p| p.stroke)
            .collect();
        let chosen = middles(&strokes, each, &scale);
        templates.extend(
            chosen
                .into_iter()
                .map(|i| Template::new(number, &strokes[i])),
        );
    }
    Ok(Learned {
        gestures,
        templates,
        scale,
    })
}

/// What is assumed of people whose strokes are too few to tell.
const ASSUMED: Scale = Scale {
    shape: 0.05,
    length: 0.02,
    seconds: 0.02,
    reach: 0.6,
};

/// The scale at which the probabilities of strokes, told by those of other people, are right (least
/// cross-entropy), and the reach beyond which only one stroke in a hundred lies.
fn fitted(performances: &[&Performance]) -> Scale {
    let strokes: Vec<(&Performance, path::Stroke)> = performances
        .iter()
        .filter_map(|p| Some((*p, p.stroke?)))
        .collect();
    // Per stroke, the distance to the nearest one of the same gesture and of every other.
    let nearest = |(performance, stroke): &(&Performance, path::Stroke)| {
        let mut least: BTreeMap<&str, f32> = BTreeMap::new();
        for (other, of_other) in &strokes {
            if other.subject != performance.subject {
                let template = Template::new(0, of_other);
                let far = distance(stroke, &template, &ASSUMED, f32::INFINITY);
                let entry = least.entry(&other.gesture).or_insert(f32::INFINITY);
                *entry = entry.min(far);
            }
        }
        let own = least.remove(performance.gesture.as_str())?;
        Some((own, least.into_values().collect::<Vec<f32>>()))
    };
    let mut known: Vec<(f32, Vec<f32>)> = strokes.par_iter().filter_map(nearest).collect();
    if known.len() < 50 {
        return ASSUMED;
    }
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    let reach = known[known.len() * 99 / 100].0;
    let loss = |shape: f32| -> f64 {
        let terms = known.iter().map(|(own, others)| {
            let power = |far: f32| f64::from((own - far) / shape).exp();
            let rest: f64 = others.iter().map(|far| power(*far)).sum();
            (1.0 + rest + power(reach)).ln()
        });
        terms.sum()
    };
    let shape = (1..60)
        .map(|n| (0.005 * 1.08_f64.powi(n)) as f32)
        .min_by(|a, b| loss(*a).total_cmp(&loss(*b)))
        .unwrap_or(ASSUMED.shape);
    Scale {
        shape,
        reach,
        ..ASSUMED
    }
}

/// Indices of `count` strokes such that every stroke has a near one among them (k-medoids, greedy).
fn middles(strokes: &[path::Stroke], count: usize, scale: &Scale) -> Vec<usize> {
    if strokes.len() <= count {
        return (0..strokes.len()).collect();
    }
    let table: Vec<Vec<f32>> = strokes
        .iter()
        .map(|a| {
            let to = |b| distance(a, &Template::new(0, b), scale, f32::INFINITY);
            strokes.iter().map(to).collect()
        })
        .collect();
    let mut near = vec![f32::INFINITY; strokes.len()];
    let mut chosen = Vec::new();
    for _ in 0..count {
        let cost = |c: &usize| -> f32 {
            let left = near.iter().zip(&table);
            left.map(|(n, row)| n.min(row[*c]).min(10.0)).sum()
        };
        let next = (0..strokes.len())
            .filter(|i| !chosen.contains(i))
            .min_by(|a, b| cost(a).total_cmp(&cost(b)));
        let Some(next) = next else { break };
        chosen.push(next);
        for (n, row) in near.iter_mut().zip(&table) {
            *n = n.min(row[next]);
        }
    }
    chosen
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
