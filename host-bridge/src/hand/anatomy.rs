//! The bones of a hand and where its joints come to lie.
//!
//! Everything is computed in the *palm's axes*: along the fingers, towards the thumb, out of the
//! palm. So left and right hands are alike, and [`Place`] puts them where they belong.

use deictic_core::gesture::frame::{FINGERS, Finger, HandFrame, Side};
use rand::Rng;
use rand_distr::{Distribution, Normal};

/// A point or direction in millimetres, in the palm's axes or the sensor's.
pub type Point = [f64; 3];

/// Lengths of one person's hand, in millimetres.
#[derive(Clone, Debug)]
pub struct Anatomy {
    /// Where each finger leaves the palm, from the middle of the palm.
    knuckles: [Point; FINGERS],
    /// Lengths of each finger's three bones, from the knuckle outwards.
    bones: [[f64; 3]; FINGERS],
}

/// How one finger is held; angles in radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bend {
    /// At the knuckle, towards the palm. For the thumb: how far it rises out of the palm's plane.
    pub knuckle: f64,
    /// At the middle joint.
    pub middle: f64,
    /// At the outer joint.
    pub outer: f64,
    /// Sideways, towards the thumb. For the thumb: the angle between it and the fingers.
    pub aside: f64,
}

/// Where the hand is and how it is turned.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Which hand.
    pub side: Side,
    /// Middle of the palm, mm.
    pub palm: Point,
    /// From the palm towards the fingers.
    pub direction: Point,
    /// Out of the palm; made perpendicular to the direction.
    pub normal: Point,
}

impl Anatomy {
    /// A hand of middle size: joints of the rigid model that the recordings of leapjs-playback
    /// (Apache-2.0) show, at the scale at which the middle finger's first bone has 45 mm.
    pub const MEAN: Self = Self {
        knuckles: [
            [-52.0, 25.0, 1.0],
            [14.7, 25.4, -2.0],
            [20.0, 1.3, -2.9],
            [16.6, -19.5, -3.3],
            [8.2, -37.3, 3.0],
        ],
        bones: [
            [40.0, 31.6, 20.0],
            [41.5, 25.6, 17.3],
            [44.6, 26.3, 17.4],
            [41.4, 25.7, 17.3],
            [32.0, 18.1, 16.0],
        ],
    };

    /// A person: hand sizes from a child's to a large man's, fingers of individual length, palms of
    /// individual width.
    pub fn person(rng: &mut impl Rng) -> Self {
        let draw = |spread: f64, rng: &mut _| -> f64 {
            Normal::new(1.0, spread).map_or(1.0, |n| n.sample(rng).clamp(0.7, 1.3))
        };
        let size = draw(0.1, rng);
        let width = draw(0.05, rng);
        let mut hand = Self::MEAN;
        for (knuckle, bones) in hand.knuckles.iter_mut().zip(&mut hand.bones) {
            let finger = draw(0.04, rng);
            let [along, towards_thumb, out] = knuckle;
            *along *= size * draw(0.05, rng);
            *towards_thumb *= size * width;
            *out *= size;
            for bone in bones {
                *bone *= size * finger * draw(0.03, rng);
            }
        }
        hand
    }

    /// The finger's joints from the knuckle to the tip, in the palm's axes.
    #[must_use]
    pub fn joints(&self, finger: usize, bend: Bend) -> [Point; 4] {
        let mut at = self.knuckles[finger];
        let mut joints = [at; 4];
        let mut turned = [0.0, bend.middle, bend.middle + bend.outer];
        if finger > 0 {
            turned = turned.map(|t| t + bend.knuckle);
        }
        for ((joint, turn), bone) in joints
            .iter_mut()
            .skip(1)
            .zip(turned)
            .zip(self.bones[finger])
        {
            let direction = if finger == 0 {
                // The thumb's outer joints bend in the palm's plane, across the palm.
                let aside = bend.aside - turn;
                [
                    bend.knuckle.cos() * aside.cos(),
                    bend.knuckle.cos() * aside.sin(),
                    bend.knuckle.sin(),
                ]
            } else {
                [
                    bend.aside.cos() * turn.cos(),
                    bend.aside.sin(),
                    bend.aside.cos() * turn.sin(),
                ]
            };
            for (x, d) in at.iter_mut().zip(direction) {
                *x += bone * d;
            }
            *joint = at;
        }
        joints
    }

    /// The frame of a hand in this posture at this place. Time, velocity and the sensor's own grab
    /// and pinch stay 0, its confidence 1.
    #[must_use]
    pub fn frame(&self, posture: &[Bend; FINGERS], place: &Place) -> HandFrame {
        let direction = unit(place.direction);
        let off = dot(place.normal, direction);
        let normal = unit(std::array::from_fn(|i| {
            place.normal[i] - off * direction[i]
        }));
        let mut thumbwards = cross(direction, normal);
        if place.side == Side::Left {
            thumbwards = thumbwards.map(|x| -x);
        }
        let put = |[along, towards_thumb, out]: Point| -> [f32; 3] {
            std::array::from_fn(|i| {
                (place.palm[i]
                    + along * direction[i]
                    + towards_thumb * thumbwards[i]
                    + out * normal[i]) as f32
            })
        };
        HandFrame {
            side: place.side,
            confidence: 1.0,
            palm: place.palm.map(|x| x as f32),
            normal: normal.map(|x| x as f32),
            direction: direction.map(|x| x as f32),
            fingers: std::array::from_fn(|finger| {
                let [knuckle, middle, _, tip] = self.joints(finger, posture[finger]);
                Some(Finger {
                    knuckle: put(knuckle),
                    middle: put(middle),
                    tip: put(tip),
                })
            }),
            ..HandFrame::default()
        }
    }
}

/// The inner product.
#[must_use]
pub fn dot(a: Point, b: Point) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The outer product.
#[must_use]
pub fn cross([ax, ay, az]: Point, [bx, by, bz]: Point) -> Point {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

/// `a` at length 1.
#[must_use]
pub fn unit(a: Point) -> Point {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use deictic_core::gesture::vector::distance;

    const HERE: Place = Place {
        side: Side::Right,
        palm: [10.0, 200.0, -30.0],
        direction: [0.0, 0.1, -1.0],
        normal: [0.0, -1.0, 0.0],
    };

    #[test]
    fn left_and_right_hands_mirror_each_other() {
        let straight = [Bend::default(); FINGERS];
        let right = Anatomy::MEAN.frame(&straight, &HERE);
        let left = Anatomy::MEAN.frame(
            &straight,
            &Place {
                side: Side::Left,
                ..HERE
            },
        );
        for (r, l) in right
            .fingers
            .iter()
            .flatten()
            .zip(left.fingers.iter().flatten())
        {
            assert!((r.tip[0] - 10.0 + l.tip[0] - 10.0).abs() < 1e-3);
            assert!((r.tip[1] - l.tip[1]).abs() < 1e-3);
        }
        let thumb = right.fingers[0].map(|f| f.knuckle[0]);
        assert!(
            thumb.is_some_and(|x| x < 10.0),
            "a right thumb is to the left of a palm turned down"
        );
        assert_eq!(right.check(), Ok(()));
    }

    #[test]
    fn a_bent_finger_comes_nearer_to_the_palm() {
        let reach = |bend: f64| {
            let posture = [Bend {
                knuckle: bend,
                middle: bend,
                outer: bend,
                aside: 0.0,
            }; FINGERS];
            let frame = Anatomy::MEAN.frame(&posture, &HERE);
            frame.fingers[2].map(|f| distance(f.tip, frame.palm))
        };
        assert!(reach(0.0) > reach(0.7) && reach(0.7) > reach(1.4));
    }
}
