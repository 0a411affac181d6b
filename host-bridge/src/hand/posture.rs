//! How fingers are held for a shape, as different people hold them, and how they are held for none.

use deictic_core::gesture::frame::FINGERS;
use deictic_core::gesture::shape::Shape;
use rand::{Rng, RngExt};

use super::anatomy::{Anatomy, Bend, Point};

/// How the five fingers are held.
pub type Posture = [Bend; FINGERS];

/// Sideways angle of each finger at rest, how much it gives when the fingers spread, and how it
/// leans when they fold, so that the tips meet; radians.
const ASIDE: [(f64, f64, f64); FINGERS] = [
    (0.9, 0.0, 0.0),
    (0.02, 0.12, -0.15),
    (-0.09, 0.02, -0.02),
    (-0.2, -0.1, 0.1),
    (-0.4, -0.2, 0.2),
];

/// Thumb and index tip nearer than this touch (mm, between the bones' ends).
const TOUCHING: f64 = 22.0;

fn degrees(rng: &mut impl Rng, from: f64, to: f64) -> f64 {
    rng.random_range(from..to).to_radians()
}

/// How a finger is held.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Held {
    Straight,
    Folded,
    /// Neither, as in a hand at rest or between two shapes.
    Half,
}
use Held::{Folded, Half, Straight};

/// How bent the fingers of one hand are for each way of holding them: fingers that do the same do
/// it alike.
struct Habit {
    straight: (f64, f64),
    folded: (f64, f64),
    half: (f64, f64),
    spread: f64,
    converging: f64,
}

impl Habit {
    fn new(rng: &mut impl Rng) -> Self {
        Self {
            straight: (degrees(rng, -8.0, 24.0), degrees(rng, 4.0, 26.0)),
            // Fists are closed at the knuckles or, like a claw, at the middle joints.
            folded: (degrees(rng, 0.0, 92.0), degrees(rng, 62.0, 108.0)),
            half: (degrees(rng, 22.0, 48.0), degrees(rng, 40.0, 58.0)),
            spread: rng.random_range(-1.0..1.0),
            converging: rng.random_range(0.0..1.2),
        }
    }

    fn finger(&self, number: usize, held: Held, rng: &mut impl Rng) -> Bend {
        let (knuckle, middle) = match held {
            Straight => self.straight,
            Folded => self.folded,
            Half => self.half,
        };
        // Fingers of a fist differ more than straight ones, which their joints' ends keep alike.
        let apart = if held == Folded { 18.0 } else { 9.0 };
        let knuckle = knuckle + degrees(rng, -apart, apart);
        let middle = (middle + degrees(rng, -apart, apart)).max(0.0);
        let (aside, give, fold) = ASIDE[number];
        Bend {
            knuckle,
            middle,
            outer: middle * rng.random_range(0.5..0.8),
            aside: match held {
                Folded => fold * self.converging,
                _ => (aside + self.spread * give) * (1.0 - knuckle.clamp(0.0, 1.4) / 1.6),
            },
        }
    }
}

fn thumb(held: Held, rng: &mut impl Rng) -> Bend {
    match held {
        Straight => Bend {
            knuckle: degrees(rng, -12.0, 42.0),
            middle: degrees(rng, -12.0, 10.0),
            outer: degrees(rng, -12.0, 15.0),
            aside: degrees(rng, 33.0, 75.0),
        },
        Folded => Bend {
            knuckle: degrees(rng, 0.0, 45.0),
            middle: degrees(rng, 5.0, 35.0),
            outer: degrees(rng, 10.0, 50.0),
            aside: degrees(rng, -8.0, 22.0),
        },
        Half => Bend {
            knuckle: degrees(rng, 5.0, 45.0),
            middle: degrees(rng, 0.0, 20.0),
            outer: degrees(rng, 0.0, 25.0),
            aside: degrees(rng, 20.0, 36.0),
        },
    }
}

fn hand(held: [Held; FINGERS], rng: &mut impl Rng) -> Posture {
    let habit = Habit::new(rng);
    std::array::from_fn(|i| match i {
        0 => thumb(held[0], rng),
        _ => habit.finger(i, held[i], rng),
    })
}

fn gap(anatomy: &Anatomy, posture: &Posture) -> f64 {
    let tip = |i: usize| -> Point { anatomy.joints(i, posture[i])[3] };
    let squares = tip(0).into_iter().zip(tip(1)).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

/// Thumb and index touching, the others straight or a little bent.
fn pinch(anatomy: &Anatomy, rng: &mut impl Rng) -> Posture {
    let mut posture = hand([Straight; FINGERS], rng);
    let relaxed = degrees(rng, 0.0, 25.0);
    for bend in posture.iter_mut().skip(2) {
        bend.knuckle += relaxed * 0.6;
        bend.middle += relaxed;
    }
    // Some let thumb and folded index lie side by side instead of touching with their ends.
    let apart = if rng.random_bool(0.25) {
        2.0 * TOUCHING
    } else {
        TOUCHING
    };
    loop {
        let middle = degrees(rng, 25.0, 95.0);
        posture[1] = Bend {
            knuckle: degrees(rng, 15.0, 75.0),
            middle,
            outer: middle * rng.random_range(0.3..0.8),
            aside: degrees(rng, -4.0, 14.0),
        };
        posture[0] = Bend {
            knuckle: degrees(rng, 5.0, 60.0),
            middle: degrees(rng, 0.0, 30.0),
            outer: degrees(rng, -10.0, 40.0),
            aside: degrees(rng, 0.0, 35.0),
        };
        if gap(anatomy, &posture) < apart {
            return posture;
        }
    }
}

/// How fingers are held that are not meant: most people fold them, some let them hang.
fn loosely(rng: &mut impl Rng) -> Held {
    if rng.random_bool(0.25) { Half } else { Folded }
}

/// How one person may hold the hand for this shape.
pub fn of_shape(shape: Shape, anatomy: &Anatomy, rng: &mut impl Rng) -> Posture {
    let held = match shape {
        // A thumb beside the fist, or opposite the fingers as around a handle.
        Shape::Grab => [
            [Folded, Half][rng.random_range(0..2)],
            Folded,
            Folded,
            Folded,
            Folded,
        ],
        Shape::Pinch => return pinch(anatomy, rng),
        // People point with the thumb on the fist, beside it, or out like a gun's hammer.
        Shape::Point => {
            let thumb = [Folded, Half, Straight][rng.random_range(0..3)];
            let rest = loosely(rng);
            [thumb, Straight, rest, rest, rest]
        }
        Shape::Two => {
            let rest = loosely(rng);
            [Folded, Straight, Straight, rest, rest]
        }
        Shape::Three => {
            let rest = loosely(rng);
            [Straight, Straight, Straight, rest, rest]
        }
        Shape::Four => {
            let mut posture = hand([Folded, Straight, Straight, Straight, Straight], rng);
            // A thumb beside the index is that of a hand at rest, or of one that closes.
            posture[0] = Bend {
                knuckle: degrees(rng, 5.0, 45.0),
                middle: degrees(rng, 15.0, 45.0),
                outer: degrees(rng, 15.0, 65.0),
                aside: degrees(rng, -18.0, 10.0),
            };
            return posture;
        }
        // The thumb of a hand at rest hangs below the palm.
        Shape::Five => {
            let thumb = if rng.random_bool(0.2) { Half } else { Straight };
            [thumb, Straight, Straight, Straight, Straight]
        }
        Shape::ThumbsUp => {
            let mut posture = hand([Straight, Folded, Folded, Folded, Folded], rng);
            // A thumb that lies nearer belongs to a fist.
            posture[0].aside = degrees(rng, 45.0, 80.0);
            posture[0].knuckle = degrees(rng, -12.0, 22.0);
            return posture;
        }
        Shape::None => return of_none(anatomy, rng),
    };
    loop {
        let posture = hand(held, rng);
        // A thumb that rests on the index of a fist does not pinch; one that meets a straight index would.
        if held[1] == Folded || gap(anatomy, &posture) > 1.5 * TOUCHING {
            return posture;
        }
    }
}

/// How a person holds the hand for this shape who means to be understood: of many ways, the one most
/// like the others.
pub fn plain(shape: Shape, anatomy: &Anatomy, rng: &mut impl Rng) -> Posture {
    let ways: Vec<Posture> = (0..31).map(|_| of_shape(shape, anatomy, rng)).collect();
    let apart = |a: &Posture, b: &Posture| -> f64 {
        let angles = |p: &Posture| p.map(|b| [b.knuckle, b.middle, b.outer, b.aside]);
        let (a, b) = (angles(a), angles(b));
        let pairs = a.as_flattened().iter().zip(b.as_flattened());
        pairs.map(|(x, y)| (x - y).abs()).sum()
    };
    let strange = |way: &Posture| -> f64 { ways.iter().map(|other| apart(way, other)).sum() };
    let most_like = ways.iter().min_by(|a, b| strange(a).total_cmp(&strange(b)));
    most_like.copied().unwrap_or_default()
}

/// A hand that shows none of the shapes: fingers that no shape holds straight together, or fingers
/// on their way.
fn of_none(anatomy: &Anatomy, rng: &mut impl Rng) -> Posture {
    loop {
        let mut held = [Half; FINGERS];
        for h in &mut held {
            *h = [Straight, Folded, Half][rng.random_range(0..3)];
        }
        let halves = held.iter().skip(1).filter(|h| **h == Half).count();
        // The thumb alone half way belongs to one shape or the other.
        let shown = match held {
            [_, Straight, Folded | Half, Folded | Half, Folded | Half] => true,
            [_, Straight, Straight, Folded | Half, Folded | Half] => true,
            [_, Straight, Straight, Straight, Straight] => true,
            [_, Folded, Folded, Folded, Folded] => true,
            [Folded | Half, Folded | Half, Straight, Straight, Straight] => true,
            _ => false,
        };
        let posture = hand(held, rng);
        if !shown
            && (halves != 1 || rng.random_bool(0.5))
            && gap(anatomy, &posture) > 1.5 * TOUCHING
        {
            return posture;
        }
    }
}
