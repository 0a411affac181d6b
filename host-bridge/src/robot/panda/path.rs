//! A smooth way through joint space.

use super::Joints;

/// A way through several postures, twice continuously differentiable: a natural cubic spline over
/// equal pieces.
#[derive(Clone, Debug)]
pub struct Path {
    postures: Vec<Joints>,
    /// Second derivatives at the postures, with respect to their number.
    bends: Vec<Joints>,
}

/// A point of a path with its derivatives by the path's parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub joints: Joints,
    pub first: Joints,
    pub second: Joints,
}

impl Path {
    /// A path from posture to posture; `None` of none at all.
    #[must_use]
    pub fn through(postures: Vec<Joints>) -> Option<Self> {
        postures.first()?;
        let mut bends = vec![[0.0; 7]; postures.len()];
        for joint in 0..7 {
            let at = |p: &Joints| p.get(joint).copied().unwrap_or(0.0);
            let values: Vec<f64> = postures.iter().map(at).collect();
            for (bend, value) in bends.iter_mut().zip(bends_of(&values)) {
                if let Some(b) = bend.get_mut(joint) {
                    *b = value;
                }
            }
        }
        Some(Self { postures, bends })
    }

    /// Where the path begins.
    #[must_use]
    pub fn start(&self) -> Joints {
        self.postures.first().copied().unwrap_or(super::READY)
    }

    /// Where it ends.
    #[must_use]
    pub fn end(&self) -> Joints {
        self.postures.last().copied().unwrap_or(super::READY)
    }

    /// How many pieces it has.
    pub(super) fn pieces(&self) -> usize {
        self.postures.len().saturating_sub(1)
    }

    /// The posture at `part` of the way, in 0..=1.
    #[must_use]
    pub fn at(&self, part: f64) -> Joints {
        self.point(part).joints
    }

    /// The posture at `part` of the way and how it changes with `part`.
    pub(super) fn point(&self, part: f64) -> Point {
        let count = self.pieces() as f64;
        let along = part.clamp(0.0, 1.0) * count;
        let piece = (along as usize).min(self.pieces().saturating_sub(1));
        let (b, a) = (along - piece as f64, 1.0 - (along - piece as f64));
        let start = self.start();
        let get = |of: &[Joints], at: usize| of.get(at).copied().unwrap_or(start);
        let (p, q) = (get(&self.postures, piece), get(&self.postures, piece + 1));
        let flat = [0.0; 7];
        let bend = |at: usize| self.bends.get(at).copied().unwrap_or(flat);
        let (m, n) = (bend(piece), bend(piece + 1));
        let mut point = Point {
            joints: p,
            first: flat,
            second: flat,
        };
        if self.pieces() == 0 {
            return point;
        }
        let out = point.joints.iter_mut().zip(&mut point.first);
        let out = out.zip(&mut point.second);
        let ends = p.iter().zip(&q).zip(m.iter().zip(&n));
        for (((x, v), w), ((p, q), (m, n))) in out.zip(ends) {
            *x = a * p + b * q + ((a * a * a - a) * m + (b * b * b - b) * n) / 6.0;
            *v = count * (q - p + ((3.0 * b * b - 1.0) * n - (3.0 * a * a - 1.0) * m) / 6.0);
            *w = count * count * (a * m + b * n);
        }
        point
    }
}

/// Second derivatives of the natural cubic spline through `values` at 0, 1, 2, ... (Thomas'
/// algorithm for the tridiagonal system m[i-1] + 4 m[i] + m[i+1] = 6 (y[i-1] - 2 y[i] + y[i+1])).
fn bends_of(values: &[f64]) -> Vec<f64> {
    let mut eliminated = vec![(0.0, 0.0)];
    let mut last = (0.0, 0.0);
    for window in values.windows(3) {
        if let [before, here, after] = window {
            let pivot = 4.0 - last.0;
            let right = 6.0 * (before - 2.0 * here + after);
            last = (1.0 / pivot, (right - last.1) / pivot);
            eliminated.push(last);
        }
    }
    let mut bends = vec![0.0];
    let mut next = 0.0;
    for (upper, right) in eliminated.iter().rev() {
        next = right - upper * next;
        bends.push(next);
    }
    bends.reverse();
    bends.truncate(values.len());
    bends
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_goes_through_every_posture_and_its_derivatives_are_its_own() {
        let postures: Vec<Joints> = (0..6)
            .map(|i| {
                let t = f64::from(i);
                [t, t * t, (0.7 * t).sin(), 1.0, -t, 0.3 * t * t * t, 2.0 - t]
            })
            .collect();
        let path = Path::through(postures.clone()).unwrap();
        for (i, posture) in postures.iter().enumerate() {
            let at = path.at(i as f64 / 5.0);
            assert!(super::super::apart(&at, posture) < 1e-9, "{i}");
        }
        let h = 1e-5;
        for i in 1..200 {
            let s = f64::from(i) / 200.0;
            let (a, b, c) = (path.point(s - h), path.point(s), path.point(s + h));
            for joint in 0..7 {
                let first = (c.joints[joint] - a.joints[joint]) / (2.0 * h);
                let second = (c.first[joint] - a.first[joint]) / (2.0 * h);
                assert!((first - b.first[joint]).abs() < 1e-4 * first.abs().max(1.0));
                assert!((second - b.second[joint]).abs() < 2e-2 * second.abs().max(1.0));
            }
        }
    }

    #[test]
    fn one_posture_is_a_path_that_stays() {
        let path = Path::through(vec![[1.0; 7]]).unwrap();
        assert_eq!(path.at(0.5), [1.0; 7]);
        assert!(Path::through(Vec::new()).is_none());
    }
}
