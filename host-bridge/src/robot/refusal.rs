//! Why a robot does not do as it is told, and what the person can do about it.

use thiserror::Error;

use super::Skill;

/// Why a robot does not begin a command.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Refusal {
    /// It is doing another one.
    #[error("the robot is still busy")]
    Busy,
    /// It has had this command, or a later one of the same run, before.
    #[error("this command was given before")]
    Repeated,
    /// The command was decided on another scene.
    #[error("it was decided on scene {decided_on}, and the table is at scene {present} now")]
    StaleScene {
        /// What it was decided on.
        decided_on: u32,
        /// What there is.
        present: u32,
    },
    /// It does not know such a motion.
    #[error("the robot does not know how to {0}")]
    UnknownMotion(String),
    /// A parameter that the motion needs is not given.
    #[error("no {0} is given, and it takes one")]
    Missing(&'static str),
    /// A thing is not in the scene.
    #[error("the {0} is not here")]
    NotHere(String),
    /// A thing is glued to the table.
    #[error("the {0} is glued")]
    Glued(String),
    /// A thing is not glued, so there is nothing to unglue.
    #[error("the {0} is not glued")]
    NotGlued(String),
    /// A thing, or the place it is to go to, is out of the arm's reach.
    #[error("the {0} is out of reach")]
    OutOfReach(String),
    /// Something stands on a thing.
    #[error("something is on the {0}")]
    Covered(String),
    /// A thing takes nothing more.
    #[error("the {0} is full")]
    Full(String),
    /// There is nothing in a thing that could be poured.
    #[error("there is nothing in the {0}")]
    Empty(String),
    /// A thing cannot have this done to it.
    #[error("the {thing} is not {wanted}")]
    Unfit {
        /// The thing.
        thing: String,
        /// What it would have to be.
        wanted: &'static str,
    },
    /// A thing is heavier than the arm may carry.
    #[error("the {0} is too heavy")]
    TooHeavy(String),
    /// The hand holds something else.
    #[error("the hand holds the {0}")]
    Holding(String),
    /// The hand holds nothing.
    #[error("the hand holds nothing")]
    NothingHeld,
    /// A thing would run into another.
    #[error("the {0} is in the way")]
    InTheWay(String),
    /// The arm itself cannot move.
    #[error("{why}")]
    Arm {
        /// Why not.
        why: String,
        /// What to do about it.
        remedy: &'static str,
    },
    /// A distance or angle that no motion has.
    #[error("the arm does not go {0} in one motion")]
    TooFar(String),
    /// It is held in the middle of another command.
    #[error("the robot is held")]
    Held,
    /// There is nothing that it could be held in.
    #[error("the robot is doing nothing")]
    Idle,
    /// It is not held, so there is nothing to go on with.
    #[error("the robot is not held")]
    NotHeld,
    /// Others have changed the table while it was held.
    #[error("the table has changed meanwhile")]
    Relaid,
    /// It has no way to pause and go on.
    #[error("this robot cannot pause and go on")]
    CannotHold,
    /// It has a fault that nobody has seen to.
    #[error("the robot has a fault")]
    Faulted,
    /// It is not heard.
    #[error("the robot does not answer")]
    Gone,
    /// It goes by another vocabulary.
    #[error("the robot goes by another vocabulary")]
    OtherVocabulary,
    /// For another reason, in the robot's words.
    #[error("{0}")]
    Other(String),
}

impl Refusal {
    /// What the person can do about it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Busy => "wait for it, or say \"stop\"".into(),
            Self::Repeated => "say it again if it is to be done again".into(),
            Self::StaleScene { .. } => "the table has changed in between: say it again".into(),
            Self::UnknownMotion(_) => format!(
                "give the action a `motion` in the vocabulary: {}",
                crate::diagnose::quoted(Skill::ALL.map(Skill::name))
            ),
            Self::Missing(what) => format!("say or show the {what} too"),
            Self::NotHere(_) => "put it on the table, or name another".into(),
            Self::Glued(thing) => format!("say \"unglue {thing}\" first"),
            Self::NotGlued(_) => "it can be picked as it is".into(),
            Self::OutOfReach(_) => "move it nearer, or name another".into(),
            Self::Covered(thing) => format!("take away what stands on the {thing} first"),
            Self::Full(thing) => format!("empty the {thing} first, or name another"),
            Self::Empty(_) => "name something that is full".into(),
            Self::Unfit { .. } => "name another".into(),
            Self::TooHeavy(_) => "the arm carries at most 3 kg: name another".into(),
            Self::Holding(thing) => format!("put the {thing} somewhere, or say \"release\""),
            Self::NothingHeld => "pick something first".into(),
            Self::InTheWay(thing) => format!("move the {thing} away first, or go another way"),
            Self::Arm { remedy, .. } => (*remedy).into(),
            Self::TooFar(_) => "say a figure above 0, and a long way in smaller steps".into(),
            Self::Held => "say \"resume\" or \"stop\" first".into(),
            Self::Idle => "say it while the robot moves".into(),
            Self::NotHeld => "say \"hold\" while the robot moves".into(),
            Self::Relaid => "say \"stop\", and give the command again".into(),
            Self::CannotHold => "say \"stop\", and give the command again".into(),
            Self::Faulted => "see to it, then say \"stop\", which clears it".into(),
            Self::Gone => "look at the robot's power and the cable".into(),
            Self::OtherVocabulary => "start robot and bridge with the same vocabulary".into(),
            Self::Other(_) => "look at the robot".into(),
        }
    }
}
