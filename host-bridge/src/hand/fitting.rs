//! How distances from examples become probabilities, found on people whom the examples are not from.

use deictic_core::gesture::template::{PLAIN, Scale};
use rayon::prelude::*;

use super::examples::{ASSUMED, Examples};

/// Fewer strokes than this tell too little.
const ENOUGH: usize = 50;

/// Parts that the people are cut into, each of which is told by examples of the others.
const FOLDS: usize = 8;

/// The share of a gesture's strokes that its tolerance is to cover.
const COVERED: f64 = 0.95;

/// The widest tolerance in sixteenths: beyond it a gesture would swallow others.
const WIDEST: f32 = 3.0 * PLAIN as f32;

/// What a stroke that is no gesture weighs against one that is one. Every gesture is taken once for such a stroke, with
/// its own examples put away: they are nearer to others than most movements of a hand that gestures nothing.
const STRANGE: f64 = 0.04;

/// How distances become probabilities.
pub(super) struct Fitted {
    /// For all gestures.
    pub scale: Scale,
    /// Per gesture.
    pub tolerances: Vec<u8>,
}

/// A stroke's distance from the nearest example of every gesture, and which gesture it is.
struct Told {
    least: Vec<f32>,
    own: usize,
}

/// The tolerances at which all gestures' strokes lie equally far from their examples, and the scale at which
/// probabilities are right (least cross-entropy).
pub(super) fn fitted(examples: &Examples, each: usize) -> Fitted {
    let plain = vec![PLAIN; examples.count];
    let mut told = told(examples, each);
    if told.len() < ENOUGH {
        return Fitted {
            scale: ASSUMED,
            tolerances: plain,
        };
    }
    let usual = quantile(told.iter().map(|t| t.least[t.own]).collect(), COVERED);
    let tolerances: Vec<u8> = (0..examples.count)
        .map(|gesture| {
            let own = told.iter().filter(|t| t.own == gesture);
            let wide = quantile(own.map(|t| t.least[gesture]).collect(), COVERED) / usual;
            (wide * f32::from(PLAIN)).clamp(f32::from(PLAIN), WIDEST) as u8
        })
        .collect();
    for told in &mut told {
        for (least, tolerance) in told.least.iter_mut().zip(&tolerances) {
            *least *= f32::from(PLAIN) / f32::from(*tolerance);
        }
    }
    let shapes = (1..50).map(|n| (0.005 * 1.1_f64.powi(n)) as f32);
    let reaches = (0..24).map(|n| usual * (0.5 * 1.12_f64.powi(n)) as f32);
    let pairs: Vec<(f32, f32)> = shapes
        .flat_map(|shape| reaches.clone().map(move |reach| (shape, reach)))
        .collect();
    let best = pairs
        .par_iter()
        .map(|(shape, reach)| (loss(&told, *shape, *reach), *shape, *reach))
        .min_by(|a, b| a.0.total_cmp(&b.0));
    let (shape, reach) = best.map_or((ASSUMED.shape, ASSUMED.reach), |(_, s, r)| (s, r));
    Fitted {
        scale: Scale {
            shape,
            reach,
            ..ASSUMED
        },
        tolerances,
    }
}

/// Every stroke against examples of other people, chosen as those of the unit are.
fn told(examples: &Examples, each: usize) -> Vec<Told> {
    let told = |fold: usize| {
        let held = |i: &usize| examples.people[*i] % FOLDS == fold;
        let chosen: Vec<Vec<usize>> = (0..examples.count)
            .map(|gesture| {
                let mut kept = examples.of(gesture);
                kept.retain(|i| !held(i));
                examples.middles(&kept, each)
            })
            .collect();
        let least = |stroke: usize| {
            let to = |of: &Vec<usize>| {
                let far = of.iter().map(|i| examples.far(stroke, *i));
                far.fold(f32::INFINITY, f32::min)
            };
            Told {
                least: chosen.iter().map(to).collect(),
                own: examples.gestures[stroke],
            }
        };
        let strokes = (0..examples.strokes.len()).filter(held);
        strokes.map(least).collect::<Vec<Told>>()
    };
    let told: Vec<Told> = (0..FOLDS).into_par_iter().flat_map(told).collect();
    told.into_iter()
        .filter(|t| t.least[t.own].is_finite())
        .collect()
}

/// The cross-entropy of the strokes as what they are, and of the same strokes as none when their own gesture is not
/// among those known.
fn loss(told: &[Told], shape: f32, reach: f32) -> f64 {
    let term = |t: &Told| {
        let power = |far: f32| f64::from((t.least[t.own].min(reach) - far) / shape).exp();
        let others: f64 =
            t.least.iter().map(|far| power(*far)).sum::<f64>() - power(t.least[t.own]);
        let (own, none) = (power(t.least[t.own]), power(reach));
        let known = (1.0 + (others + none) / own.max(1e-30)).ln();
        known + STRANGE * (1.0 + others / none.max(1e-30)).ln()
    };
    told.iter().map(term).sum()
}

/// The value below which this share lies.
fn quantile(mut values: Vec<f32>, share: f64) -> f32 {
    values.sort_by(f32::total_cmp);
    let at = (values.len() as f64 * share) as usize;
    let last = values.len().saturating_sub(1);
    values.get(at.min(last)).copied().unwrap_or(f32::INFINITY)
}
