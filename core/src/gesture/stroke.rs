//! Dynamic gestures: which movement a palm has made.
//!
//! A stroke is compared with templates by dynamic time warping in a band of three points, and by its
//! length and duration; the distances become probabilities of gestures and of *none of these*.

use super::path::{POINTS, Stroke};
use super::stroke_table::{SCALE, TEMPLATES};
use super::template::{PLAIN, STEPS, Scale, Template};
use super::vector::Vector;
use crate::math;

/// Points by which two strokes may run ahead of each other.
const BAND: usize = 3;

/// What a difference in directness weighs, squared, against the shape. Warping brings a wave whose
/// middle legs are short near to a swipe; their ends tell.
const DIRECT: f32 = 0.5;

/// The examples that a stroke is compared with.
#[derive(Clone, Copy, Debug)]
pub struct Templates<'a> {
    /// Of gestures that a unit knows without being taught.
    pub known: &'a [Template],
    /// Of gestures that it was taught.
    pub learned: &'a [Template],
    /// How distances from any of them become probabilities.
    pub scale: &'a Scale,
}

impl Templates<'static> {
    /// What a unit knows without being taught.
    pub const KNOWN: Self = Self {
        known: &TEMPLATES,
        learned: &[],
        scale: &SCALE,
    };
}

impl Templates<'_> {
    /// How many examples there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.known.len().saturating_add(self.learned.len())
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// The distance of a stroke from a template: squared, per point, warped, with the differences in
/// length, duration and directness, over the template's tolerance. Gives up, with something at least as large, when
/// it exceeds `worst`. About
/// 4,000 instructions; far fewer when it gives up.
#[must_use]
pub fn distance(stroke: &Stroke, template: &Template, scale: &Scale, worst: f32) -> f32 {
    let length = stroke.ln_length - template.ln_length;
    let seconds = stroke.ln_seconds - template.ln_seconds;
    let direct = stroke.direct - f32::from(template.direct) * (1.0 / 255.0);
    let aside = scale.length * length * length
        + scale.seconds * seconds * seconds
        + DIRECT * direct * direct;
    let tolerance = f32::from(template.tolerance.max(1)) * (1.0 / PLAIN as f32);
    let limit = (worst * tolerance - aside) * POINTS as f32;
    (aside + warp(&stroke.points, &template.points, limit) / POINTS as f32) / tolerance
}

/// One row of the table of dynamic time warping at a time. Entry `k` of a row stands for the
/// template's point `row + k - BAND`; those before the first and after the last are infinitely far.
fn warp(stroke: &[Vector; POINTS], template: &[[i8; 3]; POINTS], limit: f32) -> f32 {
    const WIDTH: usize = 2 * BAND + 1;
    let mut there = [[f32::INFINITY; 3]; POINTS + 2 * BAND];
    for (place, point) in there.iter_mut().skip(BAND).zip(template) {
        *place = point.map(|n| f32::from(n) * (1.0 / STEPS));
    }
    // One entry more on the right, which is never reached.
    let mut row = [f32::INFINITY; WIDTH + 1];
    if let Some(start) = row.get_mut(BAND) {
        *start = 0.0;
    }
    for ([x, y, z], near) in stroke.iter().zip(there.windows(WIDTH)) {
        let mut next = [f32::INFINITY; WIDTH + 1];
        let mut left = f32::INFINITY;
        let mut least = f32::INFINITY;
        let before = row.iter().zip(row.iter().skip(1));
        for ((place, (diagonal, above)), [a, b, c]) in next.iter_mut().zip(before).zip(near) {
            let [dx, dy, dz] = [x - a, y - b, z - c];
            left = smaller(smaller(*diagonal, *above), left) + dx * dx + dy * dy + dz * dz;
            least = smaller(least, left);
            *place = left;
        }
        if least > limit {
            return least;
        }
        row = next;
    }
    row.get(BAND).copied().unwrap_or(f32::INFINITY)
}

/// The smaller of two numbers that are not NaN; one comparison, where `f32::min` takes a call.
fn smaller(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

/// Compares one stroke with templates, a few at a time, so that no frame takes long.
#[derive(Clone, Debug)]
pub struct Comparison<const G: usize> {
    stroke: Stroke,
    least: [f32; G],
    next: usize,
}

/// Probabilities of the gestures that a stroke may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Likely<const G: usize> {
    /// One per gesture.
    pub gestures: [f32; G],
    /// None of them.
    pub none: f32,
}

impl<const G: usize> Comparison<G> {
    /// Nothing compared yet.
    #[must_use]
    pub const fn new(stroke: Stroke) -> Self {
        Self {
            stroke,
            least: [f32::INFINITY; G],
            next: 0,
        }
    }

    /// Compares with the next `count` templates. Gives the probabilities when all are done;
    /// templates of gestures beyond `G` are left out.
    pub fn step(&mut self, templates: &Templates<'_>, count: usize) -> Option<Likely<G>> {
        let scale = templates.scale;
        let all = templates.known.iter().chain(templates.learned);
        for template in all.skip(self.next).take(count) {
            if let Some(least) = self.least.get_mut(usize::from(template.gesture)) {
                *least = least.min(distance(&self.stroke, template, scale, *least));
            }
        }
        self.next = self.next.saturating_add(count);
        (self.next >= templates.len()).then(|| self.likely(scale))
    }

    fn likely(&self, scale: &Scale) -> Likely<G> {
        let best = self.least.iter().copied().fold(scale.reach, f32::min);
        let power = |distance: f32| math::exp((best - distance) / scale.shape);
        let none = power(scale.reach);
        let gestures = self.least.map(power);
        let sum: f32 = gestures.iter().sum::<f32>() + none;
        Likely {
            gestures: gestures.map(|p| p / sum),
            none: none / sum,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SCALE: Scale = Scale {
        shape: 0.03,
        length: 0.02,
        seconds: 0.01,
        reach: 0.3,
    };

    fn among(learned: &[Template]) -> Templates<'_> {
        Templates {
            known: &[],
            learned,
            scale: &SCALE,
        }
    }

    fn stroke(to: impl Fn(f64) -> [f64; 3]) -> Stroke {
        let way = (0..50).map(|i| to(f64::from(i) / 49.0).map(|x| x as f32));
        Stroke::new(way, 0.6).unwrap()
    }

    fn arc(bend: f64) -> Stroke {
        stroke(|t| [300.0 * t, bend * (t * 3.1).sin(), 0.0])
    }

    /// The whole table, without band or giving up.
    fn plain(stroke: &Stroke, template: &Template, band: usize) -> f32 {
        let mut table = [[f32::INFINITY; POINTS + 1]; POINTS + 1];
        table[0][0] = 0.0;
        for i in 0..POINTS {
            for j in 0..POINTS {
                if i.abs_diff(j) > band {
                    continue;
                }
                let off: f32 = (0..3)
                    .map(|c| stroke.points[i][c] - f32::from(template.points[j][c]) / STEPS)
                    .map(|d| d * d)
                    .sum();
                table[i + 1][j + 1] = off + table[i][j].min(table[i + 1][j]).min(table[i][j + 1]);
            }
        }
        table[POINTS][POINTS]
    }

    #[test]
    fn a_stroke_is_what_it_resembles_and_its_opposite_is_not() {
        let templates = [
            Template::new(0, &arc(10.0)),
            Template::new(1, &stroke(|t| [-300.0 * t, 0.0, 0.0])),
            Template::new(2, &stroke(|t| [0.0, 300.0 * t, 0.0])),
        ];
        let mut comparison = Comparison::<3>::new(arc(-20.0));
        assert_eq!(comparison.step(&among(&templates), 2), None);
        let likely = comparison.step(&among(&templates), 2).unwrap();
        assert!(likely.gestures[0] > 0.95, "{likely:?}");
    }

    #[test]
    fn what_resembles_nothing_is_none() {
        let templates = [Template::new(0, &arc(0.0))];
        let mut comparison = Comparison::<1>::new(stroke(|t| {
            let angle = t * 6.0;
            [100.0 * angle.cos(), 100.0 * angle.sin(), 0.0]
        }));
        let likely = comparison.step(&among(&templates), 9).unwrap();
        assert!(likely.none > 0.9, "{likely:?}");
    }

    proptest! {
        #[test]
        fn the_banded_row_agrees_with_the_whole_table(
            a in prop::collection::vec(prop::array::uniform3(-100.0_f32..100.0), 3..40),
            b in prop::collection::vec(prop::array::uniform3(-100.0_f32..100.0), 3..40),
        ) {
            let (Some(a), Some(b)) = (Stroke::new(a.into_iter(), 1.0), Stroke::new(b.into_iter(), 1.0))
            else { return Ok(()) };
            let template = Template::new(0, &b);
            let expected = plain(&a, &template, BAND);
            let got = warp(&a.points, &template.points, f32::INFINITY);
            prop_assert!((got - expected).abs() <= 1e-4 * expected, "{} {}", got, expected);
            // Giving up never makes a stroke nearer than it is allowed to be.
            let limited = warp(&a.points, &template.points, expected / 2.0);
            prop_assert!(limited > expected / 2.0);
        }
    }
}
