//! What does the deciding's bidding: a robot takes one command at a time, says how it fares, and can
//! be stopped at any moment.

pub mod address;
mod check;
pub mod end;
pub mod fci;
mod given;
mod hold;
mod liquid;
mod motion;
pub mod panda;
mod plan;
mod refusal;
pub mod remote;
pub mod sim;
mod skill;
mod task;
pub mod way;

pub use deictic_core::command::code::Fault;
use deictic_core::large::Intent;
use deictic_core::time::Micros;

use crate::scene::{Change, Tabletop};
use crate::vocabulary::Lexicon;
pub use refusal::Refusal;
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
    /// The arm stands, ready to go on.
    Held(CommandId),
    /// It goes on.
    Resumed(CommandId),
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

    /// Pauses in the middle of what it is doing, ready to go on; [`Event::Held`] tells when the arm stands. One that is
    /// held already stays so.
    ///
    /// # Errors
    /// [`Refusal::Idle`] when it is doing nothing, [`Refusal::CannotHold`] when it cannot.
    fn hold(&mut self, now: Micros) -> Result<(), Refusal> {
        let _ = now;
        Err(Refusal::CannotHold)
    }

    /// Goes on with what was held; [`Event::Resumed`] tells when it does.
    ///
    /// # Errors
    /// [`Refusal::NotHeld`] when nothing is held.
    fn resume(&mut self, now: Micros) -> Result<(), Refusal> {
        let _ = now;
        Err(Refusal::NotHeld)
    }

    /// What went wrong has been seen to: it takes commands again.
    ///
    /// # Errors
    /// [`Refusal`] when it cannot yet.
    fn clear_fault(&mut self, now: Micros) -> Result<(), Refusal> {
        let _ = now;
        Ok(())
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
