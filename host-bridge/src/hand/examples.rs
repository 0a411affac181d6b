//! Strokes that people have performed, how far they lie from each other, and which lie in the middle.

use std::collections::BTreeMap;

use deictic_core::gesture::path::Stroke;
use deictic_core::gesture::stroke::distance;
use deictic_core::gesture::template::{Scale, Template};
use rayon::prelude::*;

use super::performance::Performance;

/// What is assumed of people whose strokes are too few to tell.
pub(super) const ASSUMED: Scale = Scale {
    shape: 0.05,
    length: 0.02,
    seconds: 0.02,
    reach: 0.6,
};

/// A distance that counts for no more when middles are sought: one stranger among the strokes is not worth an example.
const FAR: f32 = 10.0;

/// Strokes with what they are and whose.
#[derive(Debug)]
pub(super) struct Examples {
    /// The strokes.
    pub strokes: Vec<Stroke>,
    /// Which gesture each is.
    pub gestures: Vec<usize>,
    /// Who performed each, numbered in the order of appearance.
    pub people: Vec<usize>,
    /// How many gestures there are.
    pub count: usize,
    /// Distances: of the first stroke from the second as a template.
    table: Vec<Vec<f32>>,
}

impl Examples {
    /// All performances that have a stroke; `names` has the gesture of each.
    pub fn new(performances: &[&Performance], names: &[String]) -> Self {
        let (mut strokes, mut gestures, mut people) = (Vec::new(), Vec::new(), Vec::new());
        let mut numbers = BTreeMap::new();
        for performance in performances {
            let gesture = names.iter().position(|name| *name == performance.gesture);
            if let (Some(stroke), Some(gesture)) = (performance.stroke, gesture) {
                let next = numbers.len();
                people.push(*numbers.entry(performance.subject.as_str()).or_insert(next));
                strokes.push(stroke);
                gestures.push(gesture);
            }
        }
        let templates: Vec<Template> = strokes.iter().map(|s| Template::new(0, s)).collect();
        let row = |stroke: &Stroke| -> Vec<f32> {
            let far = |t| distance(stroke, t, &ASSUMED, f32::INFINITY);
            templates.iter().map(far).collect()
        };
        Self {
            table: strokes.par_iter().map(row).collect(),
            strokes,
            gestures,
            people,
            count: names.len(),
        }
    }

    /// How far the first stroke lies from the second.
    pub fn far(&self, from: usize, to: usize) -> f32 {
        self.table[from][to]
    }

    /// The strokes of a gesture.
    pub fn of(&self, gesture: usize) -> Vec<usize> {
        (0..self.strokes.len())
            .filter(|i| self.gestures[*i] == gesture)
            .collect()
    }

    /// `count` of these strokes such that every one has a near one among them (k-medoids, greedy).
    pub fn middles(&self, among: &[usize], count: usize) -> Vec<usize> {
        if among.len() <= count {
            return among.to_vec();
        }
        let mut near = vec![f32::INFINITY; among.len()];
        let mut chosen = Vec::new();
        for _ in 0..count {
            let cost = |candidate: &usize| -> f32 {
                let left = near.iter().zip(among);
                left.map(|(n, i)| n.min(self.far(*i, *candidate)).min(FAR))
                    .sum()
            };
            let next = among
                .iter()
                .filter(|i| !chosen.contains(*i))
                .min_by(|a, b| cost(a).total_cmp(&cost(b)));
            let Some(next) = next.copied() else { break };
            chosen.push(next);
            for (n, i) in near.iter_mut().zip(among) {
                *n = n.min(self.far(*i, next));
            }
        }
        chosen
    }
}
