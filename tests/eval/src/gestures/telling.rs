//! What recordings of frames are taken for, frame by frame and over time.

use std::collections::BTreeMap;

use deictic_core::gesture::curl;
use deictic_core::gesture::evidence::{Change, Evidence, Settings};
use deictic_core::gesture::frame::HandFrame;
use deictic_core::gesture::shape::{self, Network, SHAPES, Shape};
use deictic_core::math;
use deictic_core::time::Micros;
use serde::Serialize;

/// What one recording of frames was taken for.
#[derive(Debug, Serialize)]
pub struct Told {
    /// How many frames it has.
    pub frames: usize,
    /// Frames whose hand gives no features.
    pub without_features: usize,
    /// Shapes in the order in which they were believed in, over time.
    pub order: Vec<&'static str>,
    /// Frames taken for each shape, one by one.
    pub taken_for: BTreeMap<&'static str, usize>,
    /// Of those, the ones with a probability over 0.9.
    pub sure: BTreeMap<&'static str, usize>,
}

/// Tells a recording frame by frame, and by evidence over time as the unit does.
#[must_use]
pub fn tell(network: &Network, frames: &[HandFrame]) -> Told {
    let mut told = Told {
        frames: frames.len(),
        without_features: 0,
        order: Vec::new(),
        taken_for: BTreeMap::new(),
        sure: BTreeMap::new(),
    };
    let mut evidence = Evidence::<SHAPES>::new();
    let first = frames.first().map_or(0, |f| f.time);
    let mut before = first;
    for frame in frames {
        let Ok(features) = shape::features(frame) else {
            told.without_features += 1;
            continue;
        };
        let mut probabilities = network.classify(&features);
        curl::rule_out(&mut probabilities, &curl::folds(frame));
        let now = Micros(u64::from(frame.time.wrapping_sub(first)));
        let seconds = frame.time.wrapping_sub(before) as f32 * 1e-6;
        before = frame.time;
        let change = evidence.update(now, seconds, &probabilities, &Settings::DEFAULT);
        if let Some(Change::Begun(shape)) = change {
            told.order.push(Shape::ALL[usize::from(shape)].name());
        }
        let best = math::argmax(&probabilities).unwrap_or(SHAPES - 1);
        let name = Shape::ALL[best].name();
        *told.taken_for.entry(name).or_default() += 1;
        if probabilities[best] > 0.9 {
            *told.sure.entry(name).or_default() += 1;
        }
    }
    told
}
