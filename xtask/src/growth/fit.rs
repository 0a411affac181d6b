//! Straight lines and parabolas through measured points, by least squares.

use std::collections::BTreeMap;

/// How well a straight line describes a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Instructions per further one.
    pub slope: f64,
    /// Instructions of none.
    pub start: f64,
    /// The share of the variance that the line explains.
    pub r_squared: f64,
    /// The largest distance of a point from the line, as a share of the largest value.
    pub off: f64,
    /// How far the best parabola bends away from its own chord in the middle of the range, as a share of the largest
    /// value. Positive for growth that gets steeper.
    pub bend: f64,
}

impl Fit {
    /// Of a curve with at least three points.
    #[must_use]
    pub fn of(curve: &BTreeMap<u32, u64>) -> Self {
        let points: Vec<(f64, f64)> = curve
            .iter()
            .map(|(x, y)| (f64::from(*x), *y as f64))
            .collect();
        let n = points.len() as f64;
        let mean =
            |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|(x, y)| of(*x, *y)).sum::<f64>() / n;
        let (x0, y0) = (mean(&|x, _| x), mean(&|_, y| y));
        let (sxx, sxy) = (
            mean(&|x, _| (x - x0) * (x - x0)),
            mean(&|x, y| (x - x0) * (y - y0)),
        );
        let syy = mean(&|_, y| (y - y0) * (y - y0));
        let slope = sxy / sxx;
        let start = y0 - slope * x0;
        let left = mean(&|x, y| (y - start - slope * x).powi(2));
        // The part of x^2 that no line explains, and what it explains of the rest.
        let (cube, fourth) = (
            mean(&|x, _| (x - x0).powi(3)),
            mean(&|x, _| (x - x0).powi(4)),
        );
        let square = |x: f64| (x - x0) * (x - x0) - sxx - cube / sxx * (x - x0);
        let size = fourth - sxx * sxx - cube * cube / sxx;
        let curvature = mean(&|x, y| square(x) * (y - y0)) / size;
        let half = points
            .iter()
            .map(|(x, _)| (x - x0).abs())
            .fold(0.0, f64::max);
        let largest = points.iter().map(|(_, y)| *y).fold(0.0, f64::max);
        let away = points.iter().map(|(x, y)| (y - start - slope * x).abs());
        let off = away.fold(0.0, f64::max);
        Self {
            slope,
            start,
            r_squared: 1.0 - left / syy,
            off: off / largest,
            bend: curvature * half * half / largest,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_a_line_and_a_parabola_bends() {
        let line = Fit::of(&(1..=8).map(|x| (x, u64::from(100 + 7 * x))).collect());
        assert!((line.slope - 7.0).abs() < 1e-9 && (line.start - 100.0).abs() < 1e-9);
        assert!(line.r_squared > 0.999_999 && line.bend.abs() < 1e-9);
        assert!(line.off < 1e-9);
        let parabola = Fit::of(&(0..=10).map(|x| (x, u64::from(x * x))).collect());
        assert!((parabola.bend - 0.25).abs() < 1e-9, "{parabola:?}");
        assert!(parabola.r_squared < 0.94);
    }
}
