//! Movements of a palm as different people make them: the gestures the unit knows, and 26 letters
//! drawn in the air, with everything that makes real ones differ.

use rand::{Rng, RngExt};
use rand_distr::{Distribution, Normal};

use super::anatomy::Point;
use super::letters;

/// The dynamic gestures that a unit knows without being taught, in the order of its templates.
pub const GESTURES: [&str; 8] = [
    "swipe-up",
    "swipe-down",
    "swipe-left",
    "swipe-right",
    "swipe-forward",
    "swipe-backward",
    "circle",
    "wave",
];

/// A point of a movement: time in ms, place in mm.
pub type Sample = (f64, Point);

/// The way of a gesture or a letter `a`..=`z` through points, about 200 mm large; `None` for a name
/// that is neither. Sensor's axes: x right, y up, z towards the person.
#[must_use]
pub fn way(name: &str, rng: &mut impl Rng) -> Option<Vec<Point>> {
    let flat = |points: &[(f64, f64)]| points.iter().map(|(x, y)| [*x, *y, 0.0]).collect();
    let arc = |from: f64, to: f64| -> Vec<Point> {
        let along = (0..=24).map(|i| from + (to - from) * f64::from(i) / 24.0);
        along
            .map(|a| [80.0 * a.cos(), 80.0 * a.sin(), 0.0])
            .collect()
    };
    Some(match name {
        "swipe-up" => vec![[0.0, -110.0, 0.0], [0.0, 110.0, 0.0]],
        "swipe-down" => vec![[0.0, 110.0, 0.0], [0.0, -110.0, 0.0]],
        "swipe-left" => flat(&[(120.0, 0.0), (-120.0, 0.0)]),
        "swipe-right" => flat(&[(-120.0, 0.0), (120.0, 0.0)]),
        "swipe-forward" => vec![[0.0, 0.0, 100.0], [0.0, 0.0, -100.0]],
        "swipe-backward" => vec![[0.0, 0.0, -100.0], [0.0, 0.0, 100.0]],
        "circle" => {
            // Most begin at the top; both ways round; not all close it, some go on.
            let from = 1.57 + rng.random_range(-0.7..0.7);
            let sweep = rng.random_range(5.6..7.6);
            let turn = if rng.random_bool(0.5) { sweep } else { -sweep };
            arc(from, from + turn)
        }
        "wave" => {
            let first = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
            let turns = rng.random_range(4..7);
            let side = |i: i32| -> f64 { if i % 2 == 0 { first } else { -first } };
            // The hand turns about the elbow: its way sags in the middle.
            let rise = |i: i32| 4.0 * side(i);
            (0..turns).map(|i| [70.0 * side(i), rise(i), 0.0]).collect()
        }
        letter => flat(letters::way(letter)?),
    })
}

/// How one person moves.
#[derive(Clone, Debug)]
pub struct Manner {
    /// Rotations about y, x and z, rad: where the person sits, how the arm swings.
    turn: [f64; 3],
    size: f64,
    /// Width over height.
    aspect: f64,
    /// How far x follows y, as in slanted writing.
    slant: f64,
    /// mm/s on the straight.
    speed: f64,
    /// Share of corners that is cut.
    rounding: f64,
    /// mm, of the slow wander and of the tremor.
    wander: f64,
    /// How much a plane movement bends out of its plane.
    bend: f64,
}

fn normal(rng: &mut impl Rng, mean: f64, spread: f64) -> f64 {
    Normal::new(mean, spread).map_or(mean, |n| n.sample(rng))
}

impl Manner {
    /// Some person.
    pub fn person(rng: &mut impl Rng) -> Self {
        Self {
            turn: [
                normal(rng, 0.0, 0.2),
                normal(rng, 0.0, 0.12),
                normal(rng, 0.0, 0.1),
            ],
            size: normal(rng, 0.0, 0.25).exp(),
            aspect: normal(rng, 0.0, 0.15).exp(),
            slant: normal(rng, 0.05, 0.12),
            speed: 700.0 * normal(rng, 0.0, 0.25).exp(),
            rounding: rng.random_range(0.05..0.35),
            wander: rng.random_range(2.0..7.0),
            bend: normal(rng, 0.0, 0.25),
        }
    }

    /// The gesture once, at about `rate` frames/s, with jitter, lost frames and clock noise; `None`
    /// for a name that [`way`] does not know.
    pub fn perform(&self, name: &str, rate: f64, rng: &mut impl Rng) -> Option<Vec<Sample>> {
        let mut points = way(name, rng)?;
        let take_size = self.size * normal(rng, 0.0, 0.1).exp();
        let take_turn: Point = self.turn.map(|a| a + normal(rng, 0.0, 0.06));
        for p in &mut points {
            // Nobody hits the corners exactly.
            let miss: Point = std::array::from_fn(|_| normal(rng, 0.0, 7.0));
            let [x, y, z] = *p;
            let bent = z + self.bend * (x * x + y * y) / 300.0;
            let shaped = [
                self.aspect * x + self.slant * y + miss[0],
                y + miss[1],
                bent + miss[2],
            ];
            *p = rotate(shaped, take_turn).map(|x| x * take_size);
        }
        for _ in 0..3 {
            points = cut_corners(&points, self.rounding);
        }
        Some(self.walk(&points, rate, rng))
    }

    /// A hand that stays where it is, more or less, for so many ms.
    pub fn rest(&self, milliseconds: f64, rate: f64, rng: &mut impl Rng) -> Vec<Sample> {
        let phases: [f64; 6] = std::array::from_fn(|_| rng.random_range(0.0..6.3));
        let mut samples = Vec::new();
        let mut t = 0.0;
        while t <= milliseconds {
            samples.push((t, self.unsteady([0.0; 3], t, &phases, rng)));
            t += 1000.0 / rate;
        }
        samples
    }

    /// The palm that is meant to be at `place`: it wanders, trembles, and the sensor adds its own.
    fn unsteady(&self, place: Point, t: f64, phases: &[f64; 6], rng: &mut impl Rng) -> Point {
        std::array::from_fn(|i| {
            let slow = self.wander * (t * 0.006 + phases[i]).sin();
            let tremor = 0.12 * self.wander * (t * 0.055 + phases[i + 3]).sin();
            place[i] + slow + tremor + normal(rng, 0.0, 0.2)
        })
    }

    /// Along a polyline, slower where it turns (the two-thirds power law's effect), smoothly from
    /// rest to rest.
    fn walk(&self, points: &[Point], rate: f64, rng: &mut impl Rng) -> Vec<Sample> {
        let legs: Vec<f64> = points.windows(2).map(|w| distance(w[0], w[1])).collect();
        let length: f64 = legs.iter().sum();
        let mut times = vec![0.0];
        let speed = self.speed * normal(rng, 0.0, 0.12).exp();
        let mut gone = 0.0;
        for (i, leg) in legs.iter().enumerate() {
            let turn = if i + 2 < points.len() {
                sharpness(points[i], points[i + 1], points[i + 2])
            } else {
                0.0
            };
            let share = ((gone + leg / 2.0) / length.max(1.0)).clamp(0.02, 0.98);
            // Rises and falls at the ends, as reaching movements do.
            let ends = (4.0 * share * (1.0 - share)).sqrt().max(0.25);
            let pace = speed * ends / (1.0 + 1.5 * turn);
            times.push(times[i] + 1000.0 * leg / pace);
            gone += leg;
        }
        let phases: [f64; 6] = std::array::from_fn(|_| rng.random_range(0.0..6.3));
        let end = times[points.len() - 1];
        let mut samples = Vec::new();
        let mut t = 0.0;
        while t <= end {
            let at = times
                .partition_point(|x| *x <= t)
                .clamp(1, points.len() - 1);
            let span = (times[at] - times[at - 1]).max(1e-6);
            let share = (t - times[at - 1]) / span;
            let (from, to) = (points[at - 1], points[at]);
            let meant = std::array::from_fn(|i| from[i] + share * (to[i] - from[i]));
            let place = self.unsteady(meant, t, &phases, rng);
            // One frame in thirty is lost, and now and then a few in a row.
            if !rng.random_bool(0.033) {
                samples.push((t + normal(rng, 0.0, 0.3), place));
            }
            if rng.random_bool(0.004) {
                t += rng.random_range(30.0..90.0);
            }
            t += 1000.0 / rate;
        }
        samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        samples
    }
}

fn distance(a: Point, b: Point) -> f64 {
    let squares = a.into_iter().zip(b).map(|(x, y)| (x - y).powi(2));
    squares.sum::<f64>().sqrt()
}

/// 0 straight on, 1 back the way it came.
fn sharpness(a: Point, b: Point, c: Point) -> f64 {
    let (before, after) = (distance(a, b), distance(b, c));
    let dot: f64 = (0..3).map(|i| (b[i] - a[i]) * (c[i] - b[i])).sum();
    0.5 - 0.5 * dot / (before * after).max(1e-9)
}

/// Chaikin's corner cutting; the ends stay.
fn cut_corners(points: &[Point], share: f64) -> Vec<Point> {
    let between = |a: Point, b: Point, t: f64| std::array::from_fn(|i| a[i] + t * (b[i] - a[i]));
    let mut cut = Vec::with_capacity(2 * points.len());
    cut.extend(points.first());
    for pair in points.windows(2) {
        cut.push(between(pair[0], pair[1], share));
        cut.push(between(pair[0], pair[1], 1.0 - share));
    }
    cut.extend(points.last());
    cut
}

fn rotate([x, y, z]: Point, [yaw, pitch, roll]: Point) -> Point {
    let (x, z) = (x * yaw.cos() + z * yaw.sin(), z * yaw.cos() - x * yaw.sin());
    let (y, z) = (
        y * pitch.cos() - z * pitch.sin(),
        y * pitch.sin() + z * pitch.cos(),
    );
    [
        x * roll.cos() - y * roll.sin(),
        x * roll.sin() + y * roll.cos(),
        z,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn every_gesture_and_letter_is_performed_in_order_of_time() {
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let letters: Vec<String> = ('a'..='z').map(String::from).collect();
        for name in GESTURES
            .into_iter()
            .chain(letters.iter().map(String::as_str))
        {
            let person = Manner::person(&mut rng);
            let Some(samples) = person.perform(name, 110.0, &mut rng) else {
                panic!("{name} is unknown");
            };
            assert!(samples.len() > 15, "{name}: {}", samples.len());
            assert!(samples.windows(2).all(|w| w[0].0 <= w[1].0));
            let far = samples.iter().map(|s| distance(s.1, samples[0].1));
            let far = far.fold(0.0, f64::max);
            assert!((60.0..900.0).contains(&far), "{name}: {far}");
        }
        assert!(
            Manner::person(&mut rng)
                .perform("no gesture", 110.0, &mut rng)
                .is_none()
        );
    }

    #[test]
    fn a_resting_hand_stays() {
        let mut rng = ChaCha8Rng::seed_from_u64(4);
        let samples = Manner::person(&mut rng).rest(800.0, 110.0, &mut rng);
        assert!(samples.iter().all(|s| distance(s.1, [0.0; 3]) < 60.0));
    }
}
