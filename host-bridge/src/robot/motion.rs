//! Steps as motions of a Panda's joints, and whether it can make them.

use nalgebra::{Translation3, UnitQuaternion, Vector3};

use super::panda::{
    self, Caps, Joints, Limits, OPEN, Path, Pose, READY, Trajectory, apart, hand, skeleton,
};
use super::task::{Act, Effect, Grip, Place, Step};
use super::{Posture, Refusal};

/// How long the fingers take to open or close, in seconds.
const FINGERS: f64 = 0.4;

/// How far apart the postures are that keep the hand on a straight line, in metres.
const SPACING: f64 = 0.04;

/// How far apart they are when the hand turns, in radians.
const TURNING: f64 = 0.25;

/// How far a joint may go between two such postures, in radians: more is another way of standing.
const JUMP: f64 = 0.6;

/// The ways a hand leans over, as angles from straight away from the robot.
const WAYS: [f64; 3] = [
    0.0,
    core::f64::consts::FRAC_PI_2,
    -core::f64::consts::FRAC_PI_2,
];

/// What the arm does in a motion.
#[derive(Clone, Debug)]
pub enum Kind {
    /// It moves.
    Travel(Trajectory),
    /// It stands so, and the fingers go from so far apart to so far apart, in metres.
    Fingers {
        /// The arm's posture.
        at: Joints,
        /// How far apart they are at first.
        from: f64,
        /// How far apart they are at last.
        to: f64,
    },
}

/// A step that was found possible.
#[derive(Clone, Debug)]
pub struct Motion {
    /// What the arm does, in words.
    pub name: String,
    /// What the arm does.
    pub kind: Kind,
    /// What is different at its end.
    pub effect: Effect,
}

impl Motion {
    /// How long it takes, in seconds.
    pub fn duration(&self) -> f64 {
        match &self.kind {
            Kind::Travel(trajectory) => trajectory.duration(),
            Kind::Fingers { .. } => FINGERS,
        }
    }

    /// The joints' angles `seconds` after it began.
    pub fn joints(&self, seconds: f64) -> Joints {
        match &self.kind {
            Kind::Travel(trajectory) => trajectory.at(seconds),
            Kind::Fingers { at, .. } => *at,
        }
    }

    /// How far apart the fingers are `seconds` after it began; `None` when it leaves them as they are.
    pub fn opening(&self, seconds: f64) -> Option<f64> {
        match &self.kind {
            Kind::Travel(_) => None,
            Kind::Fingers { from, to, .. } => {
                Some(from + (to - from) * (seconds / FINGERS).clamp(0.0, 1.0))
            }
        }
    }
}

/// Where the hand is for these angles, in the scene's numbers.
pub fn place(joints: &Joints) -> Place {
    let at = hand(joints).translation;
    [at.x as f32, at.y as f32, at.z as f32]
}

/// How an arm stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// The angles of its joints, counted from the base, in radians.
    pub joints: Joints,
    /// How far the fingers are apart, in metres.
    pub opening: f64,
}

impl Stance {
    /// The ready posture with open fingers.
    pub const READY: Self = Self {
        joints: READY,
        opening: OPEN,
    };
}

impl From<Stance> for Posture {
    fn from(stance: Stance) -> Self {
        Self {
            joints: stance.joints.map(|q| q as f32),
            width: stance.opening as f32,
        }
    }
}

/// The way back to the ready posture.
///
/// # Errors
/// [`Refusal::OutOfReach`] when the straight way in the joints' angles leads through the table.
pub fn homewards(from: &Stance, limits: &Limits, caps: &Caps) -> Result<Vec<Motion>, Refusal> {
    let way = swing(&from.joints, &READY);
    let path = way.and_then(|further| {
        let postures = core::iter::once(from.joints).chain(further);
        Path::through(postures.collect())
    });
    let path = path.ok_or_else(|| Refusal::OutOfReach("ready posture".into()))?;
    Ok(vec![Motion {
        name: "go home".into(),
        kind: Kind::Travel(Trajectory::along(path, limits, caps)),
        effect: Effect::None,
    }])
}

/// Straight in the joints' angles; `None` when that leads through the table.
fn swing(from: &Joints, end: &Joints) -> Option<Vec<Joints>> {
    let count = (apart(end, from) / JUMP).ceil().max(2.0) as usize;
    let postures = (1..=count).map(|i| {
        let part = i as f64 / count as f64;
        let mut posture = *from;
        for (q, to) in posture.iter_mut().zip(end) {
            *q += part * (to - *q);
        }
        (skeleton(&posture).lowest() > 0.0).then_some(posture)
    });
    postures.collect()
}

/// The steps as motions of an arm that stands so.
///
/// # Errors
/// [`Refusal::OutOfReach`] for the first step that it cannot make within its limits.
pub fn rehearse(
    steps: &[Step],
    from: &Stance,
    limits: &Limits,
    caps: &Caps,
) -> Result<Vec<Motion>, Refusal> {
    let mut refused = None;
    for way in WAYS {
        let mut stage = Stage {
            at: from.joints,
            opening: from.opening,
            way,
            limits,
            caps,
        };
        let motions: Result<Vec<_>, _> = steps.iter().map(|step| stage.motion(step)).collect();
        match motions {
            Ok(motions) => return Ok(motions),
            Err(refusal) => _ = refused.get_or_insert(refusal),
        }
    }
    Err(refused.unwrap_or(Refusal::Busy))
}

/// An arm in the middle of a rehearsal.
struct Stage<'a> {
    at: Joints,
    opening: f64,
    way: f64,
    limits: &'a Limits,
    caps: &'a Caps,
}

impl Stage<'_> {
    fn motion(&mut self, step: &Step) -> Result<Motion, Refusal> {
        let kind = match &step.act {
            Act::Fingers(apart) => {
                let (from, to) = (self.opening, apart.min(OPEN));
                self.opening = to;
                Kind::Fingers {
                    at: self.at,
                    from,
                    to,
                }
            }
            Act::Go(grips) => {
                let path = self.path(grips);
                let path = path.ok_or_else(|| Refusal::OutOfReach(step.about.clone()))?;
                self.at = path.end();
                Kind::Travel(Trajectory::along(path, self.limits, self.caps))
            }
        };
        Ok(Motion {
            name: step.name.clone(),
            kind,
            effect: step.effect.clone(),
        })
    }

    fn path(&self, grips: &[Grip]) -> Option<Path> {
        let mut postures = vec![self.at];
        for grip in grips {
            let last = *postures.last()?;
            let target = self.pose(grip);
            match self.straight(&target, &last) {
                Some(further) => postures.extend(further),
                // A straight line of the hand leads through a posture that the arm cannot take.
                None => {
                    let end = panda::solve(&target, &last, self.limits)?;
                    postures.extend(swing(&last, &end)?);
                }
            }
        }
        Path::through(postures)
    }

    fn pose(&self, grip: &Grip) -> Pose {
        let [x, y, z] = grip.at.map(f64::from);
        let towards = y.atan2(x) + self.way;
        let (sin, cos) = towards.sin_cos();
        let axis = nalgebra::Unit::new_normalize(Vector3::new(sin, -cos, 0.0));
        let about = |axis, angle: f64| UnitQuaternion::from_axis_angle(&axis, angle);
        let down = about(Vector3::x_axis(), core::f64::consts::PI);
        let turn = about(Vector3::z_axis(), f64::from(grip.turn));
        let lean = about(axis, f64::from(grip.lean));
        Pose::from_parts(Translation3::new(x, y, z), lean * turn * down)
    }

    /// Along a straight line of the hand.
    fn straight(&self, target: &Pose, from: &Joints) -> Option<Vec<Joints>> {
        let start = hand(from);
        let far = (target.translation.vector - start.translation.vector).norm();
        let turn = start.rotation.angle_to(&target.rotation);
        let pieces = (far / SPACING).max(turn / TURNING).ceil().max(1.0);
        let mut last = *from;
        let count = pieces as usize;
        let postures = (1..=count).map(|i| {
            let part = i as f64 / pieces;
            let pose = start.try_lerp_slerp(target, part, 1e-9)?;
            let next = panda::solve(&pose, &last, self.limits)?;
            let near = apart(&next, &last) < JUMP && skeleton(&next).lowest() > 0.0;
            last = next;
            near.then_some(next)
        });
        postures.collect()
    }
}
