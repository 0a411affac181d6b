//! The way a palm has gone, thinned as it comes in so that it fits a fixed room, and from there to
//! 16 points that no longer tell how large, where or how fast it was.

use heapless::Vec;

use super::vector::{self, Vector};
use crate::math;
use crate::time::Micros;

/// Points of a [`Stroke`].
pub const POINTS: usize = 16;

/// Points that a [`Path`] holds.
pub const ROOM: usize = 96;

/// A palm that is nearer than this to the last point kept has not moved, mm. Above the jitter of
/// sensors, well below the size of a gesture.
const STEP: f32 = 4.0;

/// Where a palm went, at most [`ROOM`] points: 4 mm apart, or 8, 16, ... when it went far.
#[derive(Clone, Debug)]
pub struct Path {
    /// In 0.1 mm.
    points: Vec<[i16; 3], ROOM>,
    step: f32,
    begun: Micros,
    moved: Micros,
}

impl Default for Path {
    fn default() -> Self {
        Self::new()
    }
}

impl Path {
    /// No way at all.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            points: Vec::new(),
            step: STEP,
            begun: Micros(0),
            moved: Micros(0),
        }
    }

    /// Forgets the way.
    pub fn clear(&mut self) {
        self.points.clear();
        self.step = STEP;
    }

    /// Whether nothing has been pushed.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// When the first point came.
    #[must_use]
    pub fn begun(&self) -> Micros {
        self.begun
    }

    /// The palm is here now, in mm. What is beyond 3.2 m counts as there.
    pub fn push(&mut self, now: Micros, point: Vector) {
        match self.points.last() {
            None => self.begun = now,
            Some(last) if vector::distance(point, millimetres(*last)) < self.step => return,
            Some(_) => {}
        }
        if self.points.is_full() {
            self.thin();
        }
        // A whole number saturates where it does not fit, and `thin` has made room.
        let _ = self.points.push(point.map(|x| (x * 10.0) as i16));
        self.moved = now;
    }

    /// Every other point goes, and from now on points are twice as far apart.
    fn thin(&mut self) {
        let mut keep = false;
        self.points.retain(|_| {
            keep = !keep;
            keep
        });
        self.step *= 2.0;
    }

    /// The way as a stroke; `None` when it is no longer than a few steps.
    #[must_use]
    pub fn stroke(&self) -> Option<Stroke> {
        let seconds = self.moved.since(self.begun).0 as f32 * 1e-6;
        Stroke::new(self.points.iter().map(|p| millimetres(*p)), seconds)
    }
}

fn millimetres(point: [i16; 3]) -> Vector {
    point.map(|n| f32::from(n) / 10.0)
}

/// A way at its own scale: 16 points at equal distances along it, their mean at the origin, their
/// mean square distance from it 1. Size and duration are kept apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// The points.
    pub points: [Vector; POINTS],
    /// How far the end is from the beginning over the way's length, 0..=1: 1 straight on, 0 back again.
    pub direct: f32,
    /// Logarithm of the way's length, mm.
    pub ln_length: f32,
    /// Logarithm of the duration, s.
    pub ln_seconds: f32,
}

impl Stroke {
    /// The stroke along these points, in mm. `None` for a way that is shorter than 20 mm or not
    /// finite. About 15,000 instructions for 96 points.
    #[must_use]
    pub fn new(way: impl Iterator<Item = Vector> + Clone, seconds: f32) -> Option<Self> {
        let mut length = 0.0;
        for (a, b) in way.clone().zip(way.clone().skip(1)) {
            length += vector::distance(a, b);
        }
        if !(20.0..1e6).contains(&length) {
            return None;
        }
        let mut points = resample(way, length)?;
        let count = POINTS as f32;
        let sum = points.iter().fold([0.0; 3], |sum, p| vector::add(sum, *p));
        let middle = vector::scale(sum, 1.0 / count);
        let mut square = 0.0;
        for p in &mut points {
            *p = vector::sub(*p, middle);
            square += vector::dot(*p, *p);
        }
        let size = math::sqrt(square / count);
        if size < 1.0 {
            return None;
        }
        for p in &mut points {
            *p = vector::scale(*p, 1.0 / size);
        }
        let ends = [points.first(), points.last()].map(|p| p.copied().unwrap_or_default());
        let [begin, end] = ends;
        Some(Self {
            points,
            direct: math::clamp_unit(vector::distance(begin, end) * size / length),
            ln_length: math::ln(length),
            ln_seconds: math::ln(seconds.clamp(0.01, 100.0)),
        })
    }
}

/// 16 points at equal distances along a way of this length.
fn resample(mut way: impl Iterator<Item = Vector>, length: f32) -> Option<[Vector; POINTS]> {
    let first = way.next()?;
    let mut points = [first; POINTS];
    let spacing = length / (POINTS.saturating_sub(1)) as f32;
    let mut wanted = spacing;
    let mut walked = 0.0;
    let mut at = first;
    let mut places = points.iter_mut().skip(1);
    let mut place = places.next();
    for next in way {
        let leg = vector::distance(at, next);
        while let Some(point) = place.as_deref_mut() {
            if walked + leg < wanted {
                break;
            }
            let share = if leg > 0.0 {
                (wanted - walked) / leg
            } else {
                0.0
            };
            *point = vector::add(at, vector::scale(vector::sub(next, at), share));
            wanted += spacing;
            place = places.next();
        }
        walked += leg;
        at = next;
    }
    // Rounding may leave the last one over.
    while let Some(point) = place {
        *point = at;
        place = places.next();
    }
    Some(points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn walk(points: &[Vector]) -> Path {
        let mut path = Path::new();
        for (p, t) in points.iter().zip((0..).step_by(9_000)) {
            path.push(Micros(t), *p);
        }
        path
    }

    #[test]
    fn a_straight_way_gives_points_at_equal_distances() {
        let way: std::vec::Vec<Vector> = (0..100).map(|i| [i as f32 * 3.0, 0.0, 0.0]).collect();
        let stroke = walk(&way).stroke().unwrap();
        for pair in stroke.points.windows(2) {
            let leg = pair[1][0] - pair[0][0];
            assert!((leg - 2.0 * 1.627 / 15.0).abs() < 2e-3, "{leg}");
        }
        assert!((stroke.ln_length - math::ln(297.0)).abs() < 0.02);
        assert!((stroke.ln_seconds - math::ln(0.891)).abs() < 0.03);
    }

    #[test]
    fn a_hand_that_trembles_has_no_stroke() {
        let way: std::vec::Vec<Vector> = (0..500)
            .map(|i| [(i % 3) as f32, (i % 2) as f32, 0.5])
            .collect();
        assert_eq!(walk(&way).stroke(), None);
    }

    proptest! {
        #[test]
        fn a_long_way_is_thinned_not_cut(
            turns in prop::collection::vec((-1.0_f32..1.0, -1.0_f32..1.0), 20..150),
        ) {
            let mut at = [0.0; 3];
            let mut way = std::vec::Vec::new();
            for (x, y) in turns {
                at = vector::add(at, [20.0 + x, 9.0 * y, 0.0]);
                way.push(at);
            }
            let path = walk(&way);
            let stroke = path.stroke().unwrap();
            prop_assert!(stroke.points[15][0] > stroke.points[0][0]);
            let whole = Stroke::new(way.iter().copied(), 1.0).unwrap();
            for (a, b) in stroke.points.iter().zip(whole.points) {
                prop_assert!(vector::distance(*a, b) < 0.25, "{:?} {:?}", a, b);
            }
        }

        #[test]
        fn size_place_and_speed_leave_the_points_alone(
            size in 0.3_f32..3.0,
            by in prop::array::uniform3(-500.0_f32..500.0),
        ) {
            let way = |size: f32, by: Vector| (0..60).map(move |i| {
                let angle = f64::from(i) / 10.0;
                [size * 100.0 * angle.cos() as f32 + by[0], size * 60.0 * angle.sin() as f32 + by[1], by[2]]
            });
            let a = Stroke::new(way(1.0, [0.0; 3]), 1.0).unwrap();
            let b = Stroke::new(way(size, by), 3.0).unwrap();
            for (p, q) in a.points.iter().zip(b.points) {
                prop_assert!(vector::distance(*p, q) < 1e-2);
            }
        }

        #[test]
        fn any_way_is_survived(points in prop::collection::vec(prop::array::uniform3(any::<f32>()), 0..300)) {
            if let Some(stroke) = walk(&points).stroke() {
                prop_assert!(stroke.points.iter().flatten().all(|x| x.is_finite()), "{:?}", stroke);
            }
        }
    }
}
