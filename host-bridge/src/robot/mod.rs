//! What does the deciding's bidding: a robot takes one command at a time, says how it fares, and can
//! be stopped at any moment.

pub mod address;
mod check;
pub mod end;
pub mod fci;
mod given;
mod hold;
mod motion;
pub mod panda;
mod plan;
pub mod remote;
pub mod sim;
mod skill;
pub mod way;

pub use deictic_core::command::code::Fault;
use deictic_core::large::Intent;
use deictic_core::time::Micros;
use thiserror::Error;

use crate::scene::{Change, Tabletop};
use crate::vocabulary::Lexicon;
pub use skill::Skill;

/// Names a command for good, so that one that arrives twice is not done twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CommandId {
    /// The run of the bridge that gave it.
    pub run: u32,
    /// Its number in that run, counted from 1 upwards.
    pub number: u32,
}

/// Something to be done.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// Its name.
    pub id: CommandId,
    /// What is to be done.
    pub intent: Intent,
    /// The version of the scene that it was decided on.
    pub scene: u32,
}

impl Command {
    /// Whether it was decided on the present scene.
    ///
    /// # Errors
    /// [`Refusal::StaleScene`] when not.
    pub fn check_scene(&self, world: World<'_>) -> Result<(), Refusal> {
        let (decided_on, present) = (self.scene, world.table.version());
        if decided_on == present {
            Ok(())
        } else {
            Err(Refusal::StaleScene {
                decided_on,
                present,
            })
        }
    }
}

/// What a robot sees of the world.
#[derive(Clone, Copy)]
pub struct World<'a> {
    /// The table as it is now.
    pub table: &'a Tabletop,
    /// The names of things, and which motion an action stands for.
    pub lexicon: &'a Lexicon,
}

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
    #[error("{0} is beyond what the arm does in one motion")]
    TooFar(String),
    /// It is held in the middle of another command.
    #[error("the robot is held")]
    Held,
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
            Self::Holding(thing) => format!("put the {thing} somewhere, or say \"release\""),
            Self::NothingHeld => "pick something first".into(),
            Self::InTheWay(thing) => format!("move the {thing} away first, or go another way"),
            Self::Arm { remedy, .. } => (*remedy).into(),
            Self::TooFar(_) => "say it in smaller steps".into(),
            Self::Held => "say \"stop\" first".into(),
            Self::Faulted => "see to it, then say \"stop\", which clears it".into(),
            Self::Gone => "look at the robot's power and the cable".into(),
            Self::OtherVocabulary => "start robot and bridge with the same vocabulary".into(),
            Self::Other(_) => "look at the robot".into(),
        }
    }
}

/// How a robot has taken a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// It is being done.
    Begun,
    /// It is on its way to a robot that has not answered yet: [`Event::Accepted`],
    /// [`Event::Refused`] or [`Event::Failed`] follows.
    Sent,
}

/// How an arm stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Posture {
    /// The angles of its joints, counted from the base, in radians.
    pub joints: [f32; 7],
    /// How far the fingers are apart, in metres.
    pub width: f32,
}

/// How far a command is.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A command that was [`Taken::Sent`] is being done.
    Accepted(CommandId),
    /// A command that was [`Taken::Sent`] is not begun; nothing has moved.
    Refused {
        /// Which command.
        id: CommandId,
        /// Why.
        refusal: Refusal,
    },
    /// A motion begins.
    Begun {
        /// Of which command.
        id: CommandId,
        /// What the arm does now, for example "lower to the can".
        step: String,
        /// Its number, from 1.
        number: usize,
        /// How many the command has.
        of: usize,
    },
    /// A motion has ended, and this has become different.
    Changed {
        /// Of which command.
        id: CommandId,
        /// What.
        changes: Vec<Change>,
    },
    /// The command is done.
    Done(CommandId),
    /// It was stopped on the way.
    Stopped {
        /// Which command.
        id: CommandId,
        /// During which motion.
        step: String,
    },
    /// It failed on the way.
    Failed {
        /// Which command.
        id: CommandId,
        /// What went wrong.
        fault: Fault,
        /// In words.
        why: String,
    },
}

/// An arm with a gripper.
pub trait Robot: Send {
    /// Begins a command, or says why not; nothing moves then.
    ///
    /// # Errors
    /// [`Refusal`]
    fn begin(&mut self, now: Micros, command: &Command, world: World<'_>)
    -> Result<Taken, Refusal>;

    /// Goes to the ready posture, as a command of its own.
    ///
    /// # Errors
    /// [`Refusal`]
    fn home(&mut self, now: Micros, id: CommandId) -> Result<Taken, Refusal> {
        let _ = (now, id);
        Err(Refusal::UnknownMotion("go home".into()))
    }

    /// Pauses in the middle of what it is doing, ready to go on. `false` when it is doing nothing, or
    /// cannot.
    fn hold(&mut self, now: Micros) -> bool {
        let _ = now;
        false
    }

    /// Goes on with what was held. `false` when nothing is.
    fn resume(&mut self, now: Micros) -> bool {
        let _ = now;
        false
    }

    /// What went wrong has been seen to: it takes commands again. `false` when it cannot yet.
    fn clear_fault(&mut self, now: Micros) -> bool {
        let _ = now;
        true
    }

    /// How the arm stands, where it says so.
    fn posture(&self, now: Micros) -> Option<Posture> {
        let _ = now;
        None
    }

    /// Stops at once, whatever it is doing; [`Robot::poll`] then tells where.
    fn stop(&mut self, now: Micros);

    /// What has happened up to now.
    fn poll(&mut self, now: Micros) -> Vec<Event>;

    /// The command it is doing, and how many percent of it are done.
    fn progress(&self, now: Micros) -> Option<(CommandId, u8)>;

    /// What is in its hand: the name of a thing.
    fn holding(&self) -> Option<&str>;
}
