//! Whole gesture sessions of made-up people: a hand comes, points, closes, shows shapes, moves, and
//! leaves, frame by frame as a sensor would send it.

use std::collections::HashMap;

use deictic_core::gesture::frame::{FINGERS, HandFrame, Side};
use deictic_core::gesture::pointing::Mount;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::wire::Sample;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

use super::anatomy::{Anatomy, Bend, Place, Point, cross, dot, unit};
use super::movement::Manner;
use super::posture::{self, Posture};

/// Where a resting hand is in the sensor's axes, mm.
const HOME: Point = [0.0, 220.0, 0.0];

/// Ms that a hand takes from one posture to the next.
const CHANGE: f64 = 180.0;

/// What a person does with the hand.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// Points at this place, in metres of the robot's base frame.
    Point([f32; 3]),
    /// Shows a shape; [`Shape::Grab`] separates words.
    Show(Shape),
    /// Moves the open hand: a name that [`super::movement::way`] knows.
    Move(String),
}

/// The samples of a made-up person who comes, does all that, and leaves; another person for every
/// seed. The sensor stands at `mount`, the person misses by `aim` (rad) in two directions.
#[must_use]
pub fn made_up(seed: u64, mount: Mount, aim: f64, acts: &[Act], rate: f64) -> Vec<Sample> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    Session::new(mount, aim, &mut rng).perform(acts, rate)
}

/// Frames as they come into being.
#[derive(Debug)]
pub struct Session<'a, R> {
    rng: &'a mut R,
    anatomy: Anatomy,
    manner: Manner,
    side: Side,
    mount: Mount,
    /// Standard deviation of the miss in two directions, rad.
    aim: f64,
    /// What the person always misses by, to the right and upwards, rad.
    bias: [f64; 2],
    /// One way of holding the hand per shape.
    postures: HashMap<Shape, Posture>,
    milliseconds: f64,
    palm: Point,
    direction: Point,
    held: Posture,
    samples: Vec<Sample>,
}

impl<'a, R: Rng> Session<'a, R> {
    /// A person who sits at a sensor that stands at `mount` and aims this well (rad).
    pub fn new(mount: Mount, aim: f64, rng: &'a mut R) -> Self {
        let anatomy = Anatomy::person(rng);
        let manner = Manner::person(rng);
        let side = if rng.random_bool(0.8) {
            Side::Right
        } else {
            Side::Left
        };
        let held = posture::plain(Shape::Five, &anatomy, rng);
        Self {
            anatomy,
            manner,
            side,
            mount,
            aim,
            bias: [0.0; 2],
            postures: HashMap::from([(Shape::Five, held)]),
            milliseconds: 0.0,
            palm: [HOME[0], HOME[1] - 40.0, HOME[2] + 260.0],
            direction: [0.0, 0.1, -1.0],
            held,
            samples: Vec::new(),
            rng,
        }
    }

    /// The same person, who always misses by that much to the right and upwards, rad.
    #[must_use]
    pub fn biased(mut self, bias: [f64; 2]) -> Self {
        self.bias = bias;
        self
    }

    /// Comes, does all that, and leaves. The last samples say that there is no hand.
    #[must_use]
    pub fn perform(mut self, acts: &[Act], rate: f64) -> Vec<Sample> {
        self.nothing(200.0, rate);
        self.travel(HOME, 500.0, rate);
        for act in acts {
            self.act(act, rate);
        }
        self.travel([HOME[0], HOME[1] - 60.0, HOME[2] + 300.0], 350.0, rate);
        self.nothing(600.0, rate);
        self.samples
    }

    fn act(&mut self, act: &Act, rate: f64) {
        match act {
            Act::Point(target) => {
                let target = self.of_sensor(target.map(f64::from));
                let miss = self.miss();
                let aimed = self.aimed(target, miss);
                self.change(Shape::Point, aimed, rate);
                self.rest(900.0, rate);
            }
            Act::Show(shape) => {
                self.change(*shape, [0.0, 0.1, -1.0], rate);
                self.rest(700.0, rate);
            }
            Act::Move(name) => {
                self.change(Shape::Five, [0.0, 0.1, -1.0], rate);
                self.rest(300.0, rate);
                let way = self
                    .manner
                    .perform(name, rate, self.rng)
                    .unwrap_or_default();
                self.follow(&way);
                self.rest(400.0, rate);
            }
        }
    }

    /// A place of the base frame, in m, in the sensor's axes, in mm.
    fn of_sensor(&self, place: Point) -> Point {
        let origin = self.mount.origin.map(f64::from);
        let from_mount: Point = std::array::from_fn(|i| 1e3 * (place[i] - origin[i]));
        let axes = self.mount.axes.map(|axis| axis.map(f64::from));
        axes.map(|axis| dot(axis, from_mount))
    }

    /// By how much the person misses this time: tangents to the side and upwards.
    fn miss(&mut self) -> [f64; 2] {
        let miss = Normal::new(0.0, self.aim);
        self.bias
            .map(|bias| (bias + miss.map_or(0.0, |n| n.sample(self.rng))).tan())
    }

    /// The direction of the hand whose index finger, not its palm, points at a place, but for the miss.
    fn aimed(&mut self, target: Point, [aside, upwards]: [f64; 2]) -> Point {
        let posture = self.posture(Shape::Point);
        let mut direction = unit(std::array::from_fn(|i| target[i] - self.palm[i]));
        for _ in 0..12 {
            let (tip, index) = self.index(&posture, direction);
            let exact = unit(std::array::from_fn(|i| target[i] - tip[i]));
            let side = unit(cross(exact, [0.0, 1.0, 0.0]));
            let up = cross(side, exact);
            let meant: Point = unit(std::array::from_fn(|i| {
                exact[i] + aside * side[i] + upwards * up[i]
            }));
            direction = unit(std::array::from_fn(|i| {
                direction[i] + 0.8 * (meant[i] - index[i])
            }));
        }
        direction
    }

    fn posture(&mut self, shape: Shape) -> Posture {
        let (anatomy, rng) = (&self.anatomy, &mut *self.rng);
        *self
            .postures
            .entry(shape)
            .or_insert_with(|| posture::plain(shape, anatomy, rng))
    }

    /// Goes over to another posture and direction.
    fn change(&mut self, shape: Shape, direction: Point, rate: f64) {
        let (from, to) = (self.held, self.posture(shape));
        let (turn_from, turn_to) = (self.direction, direction);
        let steps = (CHANGE * rate / 1e3).ceil().max(1.0);
        for step in 1..=steps as u32 {
            let share = f64::from(step) / steps;
            let between = |a: f64, b: f64| a + share * (b - a);
            self.held = std::array::from_fn(|i| Bend {
                knuckle: between(from[i].knuckle, to[i].knuckle),
                middle: between(from[i].middle, to[i].middle),
                outer: between(from[i].outer, to[i].outer),
                aside: between(from[i].aside, to[i].aside),
            });
            self.direction = unit(std::array::from_fn(|i| between(turn_from[i], turn_to[i])));
            self.advance(self.palm, rate);
        }
    }

    /// Where the index of a hand in this posture ends, and where it points.
    fn index(&self, posture: &Posture, direction: Point) -> (Point, Point) {
        let frame = self
            .anatomy
            .frame(posture, &self.place(self.palm, direction));
        frame.fingers[1].map_or((self.palm, direction), |index| {
            let (tip, knuckle) = (index.tip.map(f64::from), index.knuckle.map(f64::from));
            (tip, unit(std::array::from_fn(|i| tip[i] - knuckle[i])))
        })
    }

    fn place(&self, palm: Point, direction: Point) -> Place {
        Place {
            side: self.side,
            palm,
            direction,
            normal: [0.0, -1.0, 0.0],
        }
    }

    fn rest(&mut self, milliseconds: f64, rate: f64) {
        let way = self.manner.rest(milliseconds, rate, self.rng);
        self.follow(&way);
    }

    fn travel(&mut self, to: Point, milliseconds: f64, rate: f64) {
        let from = self.palm;
        let steps = (milliseconds * rate / 1e3).ceil().max(1.0);
        for step in 1..=steps as u32 {
            let share = f64::from(step) / steps;
            let smooth = share * share * (3.0 - 2.0 * share);
            let palm = std::array::from_fn(|i| from[i] + smooth * (to[i] - from[i]));
            self.advance(palm, rate);
        }
    }

    /// Follows samples of a movement from where the palm is.
    fn follow(&mut self, way: &[(f64, Point)]) {
        let Some((_, first)) = way.first().copied() else {
            return;
        };
        let (start, from) = (self.milliseconds, self.palm);
        let mut before = 0.0;
        for (time, at) in way {
            let step = (time - before).max(1.0);
            before = *time;
            let palm = std::array::from_fn(|i| from[i] + at[i] - first[i]);
            self.advance(palm, 1e3 / step);
        }
        self.milliseconds = self.milliseconds.max(start);
    }

    /// One frame later the palm is there.
    fn advance(&mut self, palm: Point, rate: f64) {
        let before = self.palm;
        self.palm = palm;
        self.milliseconds += 1e3 / rate;
        let mut frame = self
            .anatomy
            .frame(&self.held, &self.place(palm, self.direction));
        self.blur(&mut frame);
        frame.time = (self.milliseconds * 1e3) as u64 as u32;
        frame.velocity = std::array::from_fn(|i| ((palm[i] - before[i]) * rate) as f32);
        frame.confidence = 0.9;
        self.samples.push(Sample::Hand(frame));
    }

    /// Fingertips as a sensor sees them: a few tenths of a millimetre off.
    fn blur(&mut self, frame: &mut HandFrame) {
        let noise = Normal::new(0.0_f32, 0.4);
        for finger in frame.fingers.iter_mut().take(FINGERS).flatten() {
            for x in finger.tip.iter_mut().chain(&mut finger.middle) {
                *x += noise.map_or(0.0, |n| n.sample(self.rng));
            }
        }
    }

    fn nothing(&mut self, milliseconds: f64, rate: f64) {
        for _ in 0..(milliseconds * rate / 1e3) as u32 {
            self.milliseconds += 1e3 / rate;
            let time = (self.milliseconds * 1e3) as u64 as u32;
            self.samples.push(Sample::Nothing(time));
        }
    }
}
