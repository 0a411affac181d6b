//! A robot at the other end of a link: the host's side of the command set.
//!
//! Nothing is done twice: a command that is not answered is given again under the same name, and the
//! robot does what has one name at most once. A command whose fate is unknown, since the link or the
//! robot was lost, counts as failed, and is voided before the robot takes another.

mod carrier;
mod gate;
mod giving;
mod hearing;
mod link;
mod words;

use std::collections::VecDeque;
use std::io;
use std::time::{Duration, Instant};

use deictic_core::command::code::Motion;
use deictic_core::command::field::{Id, Number};
use deictic_core::command::message::{ClearFault, Halt, Home, HostBeat};
use deictic_core::command::{Packet, ROBOT_LOST};
use deictic_core::time::Micros;

use super::{Command, CommandId, Event, Posture, Refusal, Robot, Taken, World};
use crate::scene::Change;
use crate::vocabulary::Lexicon;

pub use carrier::{Carrier, OnBus, OnWire};
pub use gate::Gate;
pub(super) use words::{action_of, direction_option, reason_of, thing_named};

/// When an unanswered command is given again.
const AGAIN: Micros = Micros::from_millis(60);

/// Opens a link to a robot, as often as one is needed.
pub type Opener = Box<dyn FnMut() -> io::Result<Box<dyn Carrier>> + Send>;

/// The command that was given last, while its end is not known.
struct Given {
    id: CommandId,
    packet: Packet,
    at: Micros,
    again: Micros,
    accepted: bool,
    stopping: bool,
    step: String,
    percent: u8,
    /// How many groups of changes were told.
    groups: u8,
    /// The changes of the group that is being told.
    changes: Vec<Change>,
    /// Whether the last beat said that it has ended.
    ended: bool,
    /// Whether the last beat said that it is held.
    held: bool,
    /// Whether it is to be held or to go on, while the robot does not do so yet.
    wanted: Option<bool>,
}

/// A robot behind a link.
pub struct Remote {
    open: Opener,
    carrier: Option<Box<dyn Carrier>>,
    gate: Gate,
    /// Whether the robot has asked for a key that this side does not have.
    wants_key: bool,
    /// Why it was lost last.
    gone: String,
    lexicon: Lexicon,
    run: u32,
    newest: Number,
    given: Option<Given>,
    /// The newest command as its giver names it.
    last: Option<CommandId>,
    /// A stop that is done once what was being done has ended.
    stops: Option<CommandId>,
    /// The scene that the robot knows.
    told: Option<u32>,
    boot: Option<u16>,
    heard: Option<Micros>,
    beat: Micros,
    reopen: Micros,
    held: Option<String>,
    joints: [f32; 7],
    posture: Option<Posture>,
    happened: VecDeque<Event>,
}

impl Remote {
    /// Opens the link; the robot is waited for when it is first told to do something.
    ///
    /// # Errors
    /// When the link cannot be opened.
    pub fn open(open: Opener, lexicon: &Lexicon) -> io::Result<Self> {
        Self::behind(Gate::default(), open, lexicon)
    }

    /// As [`Remote::open`], behind a gate.
    ///
    /// # Errors
    /// When the link cannot be opened.
    pub fn behind(gate: Gate, mut open: Opener, lexicon: &Lexicon) -> io::Result<Self> {
        let carrier = Some(open()?);
        let mut remote = Self {
            open,
            carrier,
            gate,
            wants_key: false,
            gone: String::new(),
            lexicon: lexicon.clone(),
            run: fresh_run(),
            newest: Number::default(),
            given: None,
            last: None,
            stops: None,
            told: None,
            boot: None,
            heard: None,
            beat: Micros(0),
            reopen: Micros(0),
            held: None,
            joints: [0.0; 7],
            posture: None,
            happened: VecDeque::new(),
        };
        remote.greet(Micros(0));
        Ok(remote)
    }

    /// Whether the robot was heard of late.
    #[must_use]
    pub fn is_there(&self, now: Micros) -> bool {
        let heard = self.heard.is_some_and(|at| now.since(at) < ROBOT_LOST);
        heard && self.carrier.is_some()
    }

    /// Packets that were lost or damaged on the way to here.
    #[must_use]
    pub fn lost(&self) -> u64 {
        self.carrier.as_ref().map_or(0, |c| c.lost())
    }

    /// What stands between this side and the link.
    #[must_use]
    pub fn gate(&self) -> &Gate {
        &self.gate
    }

    /// Whether the robot has asked for a key that this side does not have.
    #[must_use]
    pub fn wants_key(&self) -> bool {
        self.wants_key
    }

    /// Waits until the robot shows that it lives.
    ///
    /// # Errors
    /// When it does not in `patience`.
    pub fn wait(&mut self, patience: Duration) -> io::Result<()> {
        let until = Instant::now() + patience;
        while self.heard.is_none() {
            if Instant::now() >= until {
                return Err(io::ErrorKind::TimedOut.into());
            }
            self.say(&HostBeat { id: self.id() }.into());
            self.listen(Micros(0), Duration::from_millis(50));
        }
        Ok(())
    }

    /// The newest command of this run.
    fn id(&self) -> Id {
        Id {
            run: self.run,
            number: self.newest,
        }
    }
}

impl Robot for Remote {
    fn begin(
        &mut self,
        now: Micros,
        command: &Command,
        world: World<'_>,
    ) -> Result<Taken, Refusal> {
        let mut execute = words::execute(command, world)?;
        if execute.motion == Motion::Stop {
            return Ok(self.stand_still(now, command.id));
        }
        self.ready(now)?;
        if self.told != Some(world.table.version()) {
            for message in words::scene(world)? {
                self.say(&message);
            }
            self.told = Some(world.table.version());
        }
        execute.id = self.name(command.id)?;
        self.give(now, command.id, &execute.into())
    }

    fn home(&mut self, now: Micros, id: CommandId) -> Result<Taken, Refusal> {
        self.ready(now)?;
        let named = self.name(id)?;
        self.give(now, id, &Home { id: named }.into())
    }

    fn hold(&mut self, _now: Micros) -> Result<(), Refusal> {
        self.want(true, Refusal::Idle)
    }

    fn resume(&mut self, _now: Micros) -> Result<(), Refusal> {
        let held = |given: &Given| given.held || given.wanted == Some(true);
        if !self.given.as_ref().is_some_and(held) {
            return Err(Refusal::NotHeld);
        }
        self.want(false, Refusal::NotHeld)
    }

    fn clear_fault(&mut self, now: Micros) -> Result<(), Refusal> {
        self.ready(now)?;
        self.say(&ClearFault { id: self.id() }.into());
        Ok(())
    }

    fn posture(&self, _now: Micros) -> Option<Posture> {
        self.posture
    }

    fn stop(&mut self, now: Micros) {
        self.say(&Halt { id: self.id() }.into());
        if let Some(given) = &mut self.given
            && !given.stopping
        {
            given.stopping = true;
            given.at = now;
            given.again = now.after(AGAIN);
        }
    }

    fn poll(&mut self, now: Micros) -> Vec<Event> {
        self.listen(now, Duration::ZERO);
        self.see_to(now);
        if self.given.is_none() {
            let stopped = self.stops.take().map(Event::Done);
            self.happened.extend(stopped);
        }
        self.happened.drain(..).collect()
    }

    fn progress(&self, _now: Micros) -> Option<(CommandId, u8)> {
        let given = self.given.as_ref().filter(|g| g.accepted)?;
        Some((given.id, given.percent))
    }

    fn holding(&self) -> Option<&str> {
        self.held.as_deref()
    }
}

/// Tells this run of the bridge from others, of this and of other machines.
fn fresh_run() -> u32 {
    use std::hash::{BuildHasher, RandomState};
    // The only source of chance in the standard library; its keys are new for every state.
    RandomState::new().hash_one(std::process::id()) as u32
}
