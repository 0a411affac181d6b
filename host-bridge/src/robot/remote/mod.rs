//! A robot at the other end of a link: the host's side of the command set.
//!
//! Nothing is done twice: a command that is not answered is given again under the same name, and the
//! robot does what has one name at most once. A command whose fate is unknown, since the link or the
//! robot was lost, counts as failed, and is voided before the robot takes another.

mod carrier;
mod hearing;
mod words;

use std::collections::VecDeque;
use std::io;
use std::time::{Duration, Instant};

use deictic_core::command::code::Motion;
use deictic_core::command::field::{Id, Number};
use deictic_core::command::message::{
    Ask, ClearFault, FromRobot, Halt, Hold, Home, HostBeat, Resume, ToRobot,
};
use deictic_core::command::{BEAT, Packet, ROBOT_LOST};
use deictic_core::time::Micros;

use super::{Command, CommandId, Event, Fault, Posture, Refusal, Robot, Taken, World};
use crate::scene::Change;
use crate::vocabulary::Lexicon;

pub use carrier::{Carrier, OnBus, OnWire};
pub(super) use words::{action_of, direction_option, reason_of, thing_named};

/// How long [`Robot::begin`] waits for the robot's answer; one that comes later is an event.
const AT_ONCE: Duration = Duration::from_millis(5);

/// When an unanswered command is given again.
const AGAIN: Micros = Micros::from_millis(60);

/// When an unanswered command counts as lost.
const GIVEN_UP: Micros = Micros::from_millis(600);

/// How often a lost link is opened anew.
const REOPEN: Micros = Micros::from_millis(500);

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
}

/// A robot behind a link.
pub struct Remote {
    open: Opener,
    carrier: Option<Box<dyn Carrier>>,
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
    pub fn open(mut open: Opener, lexicon: &Lexicon) -> io::Result<Self> {
        let carrier = Some(open()?);
        let mut remote = Self {
            open,
            carrier,
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

    /// After opening: whatever an earlier end of this link left behind is not begun any more.
    fn greet(&mut self, now: Micros) {
        self.told = None;
        self.heard = None;
        self.beat = now.after(BEAT);
        let id = self.id();
        self.say(&HostBeat { id }.into());
        self.say(&Halt { id }.into());
    }

    fn say(&mut self, message: &ToRobot) {
        self.send(&message.packet());
    }

    fn send(&mut self, packet: &Packet) {
        if let Some(carrier) = &mut self.carrier
            && let Err(error) = carrier.send(packet)
        {
            self.lose(&error);
        }
    }

    fn lose(&mut self, error: &io::Error) {
        self.carrier = None;
        self.gone = error.to_string();
    }

    /// Takes what has arrived, waiting for the first of it.
    fn listen(&mut self, now: Micros, patience: Duration) {
        let mut patience = patience;
        while let Some(carrier) = &mut self.carrier {
            match carrier.receive(patience) {
                Ok(Some(packet)) => {
                    // What is no message of ours is as good as lost.
                    if let Ok(message) = FromRobot::read(&packet) {
                        self.hear(now, &message);
                    }
                }
                Ok(None) => return,
                Err(error) => self.lose(&error),
            }
            patience = Duration::ZERO;
        }
    }

    /// Numbers a new command.
    fn name(&mut self, id: CommandId) -> Result<Id, Refusal> {
        let old = |last: CommandId| last.run == id.run && id.number <= last.number;
        if self.last.is_some_and(old) {
            return Err(Refusal::Repeated);
        }
        self.last = Some(id);
        match Number::new(self.newest.get().saturating_add(1)) {
            Some(number) => self.newest = number,
            None => {
                self.run = self.run.wrapping_add(1);
                self.newest = Number::new(1).unwrap_or_default();
                self.say(&HostBeat { id: self.id() }.into());
            }
        }
        Ok(self.id())
    }

    /// Gives a command, and waits a little for the answer.
    fn give(&mut self, now: Micros, id: CommandId, message: &ToRobot) -> Result<Taken, Refusal> {
        let packet = message.packet();
        // A line that delivers in bursts may hold the last beat's successor back behind the command.
        self.say(&HostBeat { id: self.id() }.into());
        self.send(&packet);
        self.given = Some(Given {
            id,
            packet,
            at: now,
            again: now.after(AGAIN),
            accepted: false,
            stopping: false,
            step: String::new(),
            percent: 0,
            groups: 0,
            changes: Vec::new(),
            ended: false,
        });
        let before = self.happened.len();
        let until = Instant::now() + AT_ONCE;
        loop {
            let left = until.saturating_duration_since(Instant::now());
            self.listen(now, left);
            let mine = |e: &Event| match e {
                Event::Accepted(of) => *of == id,
                Event::Refused { id: of, .. } => *of == id,
                _ => false,
            };
            let answered = self.happened.iter().skip(before).position(mine);
            match answered.and_then(|at| self.happened.remove(before + at)) {
                Some(Event::Refused { refusal, .. }) => return Err(refusal),
                Some(_) => return Ok(Taken::Begun),
                None if left.is_zero() || self.carrier.is_none() => return Ok(Taken::Sent),
                None => {}
            }
        }
    }

    /// Why a command cannot be given now.
    fn ready(&mut self, now: Micros) -> Result<(), Refusal> {
        self.listen(now, Duration::ZERO);
        if self.given.is_some() {
            return Err(Refusal::Busy);
        }
        if !self.is_there(now) {
            return Err(Refusal::Gone);
        }
        Ok(())
    }

    fn fail(&mut self, fault: Fault, why: &str) {
        if let Some(given) = self.given.take() {
            let (id, why) = (given.id, why.to_owned());
            self.happened.push_back(Event::Failed { id, fault, why });
            // Should it still arrive, or be going on unheard, it ends here.
            self.say(&Halt { id: self.id() }.into());
        }
    }

    /// What is due: a link to be opened anew, a command to be given again, a robot that is lost.
    fn see_to(&mut self, now: Micros) {
        if self.carrier.is_none() {
            let why = format!("the link to the robot is gone: {}", self.gone);
            self.fail(Fault::RobotLost, &why);
            if now >= self.reopen {
                self.reopen = now.after(REOPEN);
                self.carrier = (self.open)().ok();
                if self.carrier.is_some() {
                    self.greet(now);
                }
            }
            return;
        }
        if now >= self.beat {
            self.beat = now.after(BEAT);
            self.say(&HostBeat { id: self.id() }.into());
        }
        let there = self.is_there(now);
        let Some(given) = &mut self.given else { return };
        if !there {
            self.fail(Fault::RobotLost, "the robot is not heard any more");
        } else if now >= given.again && (!given.accepted || given.stopping) {
            if now.since(given.at) >= GIVEN_UP {
                self.fail(Fault::RobotLost, "the robot does not answer");
                return;
            }
            given.again = now.after(AGAIN);
            let (stopping, packet) = (given.stopping, given.packet.clone());
            if stopping {
                self.say(&Halt { id: self.id() }.into());
            } else {
                self.send(&packet);
            }
        }
    }

    fn ask(&mut self) {
        self.say(&Ask { id: self.id() }.into());
    }

    /// A stop that is a command of its own: it is done when what was being done has ended.
    fn stand_still(&mut self, now: Micros, id: CommandId) -> Taken {
        if self.given.is_none() {
            // A person who says "stop" to an arm that stands still has seen to it.
            self.say(&ClearFault { id: self.id() }.into());
        }
        self.stop(now);
        self.last = Some(id);
        self.stops = Some(id);
        let until = Instant::now() + AT_ONCE;
        while self.given.is_some() && self.carrier.is_some() && Instant::now() < until {
            self.listen(now, until.saturating_duration_since(Instant::now()));
        }
        Taken::Begun
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

    fn hold(&mut self, _now: Micros) -> bool {
        self.say(&Hold { id: self.id() }.into());
        self.given.is_some() && self.carrier.is_some()
    }

    fn resume(&mut self, _now: Micros) -> bool {
        self.say(&Resume { id: self.id() }.into());
        self.given.is_some() && self.carrier.is_some()
    }

    fn clear_fault(&mut self, _now: Micros) -> bool {
        self.say(&ClearFault { id: self.id() }.into());
        self.carrier.is_some()
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
