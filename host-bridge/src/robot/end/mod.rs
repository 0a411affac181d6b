//! The robot's side of the command set: hears a host, has a [`Robot`] do what it says, and tells how
//! it fares. Packets and time in, packets out; `deictic robot-sim` puts links around it.
//!
//! * It does what has one name at most once, and nothing of a number that was passed over or halted.
//! * It moves only while it hears its host: [`HOST_LOST`] after the last beat it stops.
//! * It tells the end of a command, and all that it changed, as often as it is asked.

mod served;
mod telling;

use std::collections::BTreeMap;

use deictic_core::category::Category;
use deictic_core::command::code::Outcome;
use deictic_core::command::field::{Features, Id, Number, Thing};
use deictic_core::command::message::{
    Accepted, Execute, FromRobot, Item, Refused, Scene, ToRobot, Welcome,
};
use deictic_core::command::{BEAT, HOST_LOST, Packet};
use deictic_core::intent::Parameter;
use deictic_core::large::{Entity, Intent};
use deictic_core::time::Micros;

use super::remote::{action_of, direction_option, reason_of};
use super::{Command, CommandId, Refusal, Robot, Taken, World};
use crate::scene::Tabletop;
use crate::vocabulary::Lexicon;

pub use served::{ListenError, Listener, Served};

/// How many runs of hosts are remembered; the oldest run's number is forgotten first.
const RUNS: usize = 1024;

/// The command that was taken last, and all that was said of it.
struct Current {
    id: Id,
    outcome: Outcome,
    /// Its acceptance, changes and end, to be said again when asked.
    said: Vec<Packet>,
    groups: u8,
    step: u8,
    steps: u8,
    /// Whether it is being stopped since the host is not heard.
    host_lost: bool,
}

/// A scene that is being told.
struct Telling {
    version: u32,
    things: usize,
    entities: Vec<Entity>,
}

/// The robot's side.
pub struct End {
    robot: Box<dyn Robot + Send>,
    lexicon: Lexicon,
    boot: u16,
    table: Option<Tabletop>,
    telling: Option<Telling>,
    /// The run that it hears, and when it heard it last.
    host: Option<(u32, Micros)>,
    /// The newest number of every run.
    newest: BTreeMap<u32, Number>,
    current: Option<Current>,
    held: bool,
    faulted: bool,
    beat: Micros,
}

impl End {
    /// A robot that has just started; `boot` tells this start from others.
    #[must_use]
    pub fn new(robot: Box<dyn Robot + Send>, lexicon: Lexicon, boot: u16) -> Self {
        Self {
            robot,
            lexicon,
            boot,
            table: None,
            telling: None,
            host: None,
            newest: BTreeMap::new(),
            current: None,
            held: false,
            faulted: false,
            beat: Micros(0),
        }
    }

    /// Takes a packet from the host; puts into `out` what there is to say.
    pub fn take(&mut self, now: Micros, packet: &Packet, out: &mut Vec<Packet>) {
        // What is no message of ours is as good as lost.
        let Ok(message) = ToRobot::read(packet) else {
            return;
        };
        match message {
            ToRobot::HostBeat(of) => self.heard(now, of.id.run, out),
            ToRobot::Halt(of) => self.halt(now, of.id, out),
            ToRobot::Hold(of) => {
                if self.is_running(of.id) {
                    self.held |= self.robot.hold(now);
                }
            }
            ToRobot::Resume(of) => {
                if self.is_running(of.id) && self.held && !self.is_alone(now) {
                    self.held = !self.robot.resume(now);
                }
            }
            ToRobot::ClearFault(_) => self.faulted &= !self.robot.clear_fault(now),
            ToRobot::Ask(of) => self.ask(of.id, out),
            ToRobot::Home(of) => {
                if self.is_new(of.id, out) {
                    let name = named(of.id);
                    let taken = self
                        .may_begin(now, of.id)
                        .and_then(|()| self.robot.home(now, name));
                    self.begun(of.id, taken, out);
                }
            }
            ToRobot::Execute(of) => {
                if self.is_new(of.id, out) {
                    let taken = self.execute(now, &of);
                    self.begun(of.id, taken, out);
                }
            }
            ToRobot::Scene(of) => self.scene(&of),
            ToRobot::Item(of) => self.item(&of),
        }
        self.hear_robot(now, out);
    }

    /// Does what is due, and tells what has happened.
    pub fn poll(&mut self, now: Micros, out: &mut Vec<Packet>) {
        if self.is_alone(now)
            && let Some(current) = &mut self.current
            && current.outcome == Outcome::Running
            && !current.host_lost
        {
            current.host_lost = true;
            self.robot.stop(now);
        }
        self.hear_robot(now, out);
        if now >= self.beat {
            self.beat = now.after(BEAT);
            self.show(now, out);
        }
    }

    /// The latest moment at which [`End::poll`] is to be called again.
    #[must_use]
    pub fn next_wake(&self, now: Micros) -> Micros {
        let moving = self.is_moving();
        let soon = if moving {
            now.after(Micros::from_millis(5))
        } else {
            Micros::NEVER
        };
        self.beat.min(soon)
    }

    /// Whether a command is being done.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        let current = self.current.as_ref();
        current.is_some_and(|c| c.outcome == Outcome::Running)
    }

    fn is_running(&self, id: Id) -> bool {
        self.is_moving() && self.current.as_ref().is_some_and(|c| c.id == id)
    }

    fn is_alone(&self, now: Micros) -> bool {
        self.host.is_none_or(|(_, at)| now.since(at) >= HOST_LOST)
    }

    /// Hears a run; another one only when the present one is gone and nothing moves.
    fn heard(&mut self, now: Micros, run: u32, out: &mut Vec<Packet>) {
        let present = self.host.map(|(run, _)| run);
        if present == Some(run) {
            self.host = Some((run, now));
        } else if self.is_alone(now) && !self.is_moving() {
            self.host = Some((run, now));
            let boot = self.boot;
            out.push(FromRobot::from(Welcome { run, boot }).packet());
        }
    }

    fn newest_of(&self, run: u32) -> Number {
        self.newest.get(&run).copied().unwrap_or_default()
    }

    fn count(&mut self, id: Id) {
        if self.newest.len() >= RUNS && !self.newest.contains_key(&id.run) {
            self.newest.pop_first();
        }
        self.newest.insert(id.run, id.number);
    }

    /// Whether a command is to be judged; one that was given before is answered as it was.
    fn is_new(&mut self, id: Id, out: &mut Vec<Packet>) -> bool {
        if id.number > self.newest_of(id.run) {
            return true;
        }
        match &self.current {
            Some(current) if current.id == id => out.extend(current.said.first().cloned()),
            _ => out.push(refused(id, &Refusal::Repeated)),
        }
        false
    }

    fn may_begin(&self, now: Micros, id: Id) -> Result<(), Refusal> {
        if self.host.is_none_or(|(run, _)| run != id.run) || self.is_alone(now) {
            return Err(Refusal::Other("no beat of this host is heard".into()));
        }
        if self.faulted {
            return Err(Refusal::Faulted);
        }
        match (self.held, self.is_moving()) {
            (true, _) => Err(Refusal::Held),
            (_, true) => Err(Refusal::Busy),
            _ => Ok(()),
        }
    }

    fn execute(&mut self, now: Micros, of: &Execute) -> Result<Taken, Refusal> {
        self.may_begin(now, of.id)?;
        let present = self.table.as_ref().map_or(0, Tabletop::version);
        let Some(table) = self.table.as_ref().filter(|_| of.scene == present) else {
            return Err(Refusal::StaleScene {
                decided_on: of.scene,
                present,
            });
        };
        let command = Command {
            id: named(of.id),
            intent: intent_of(of, &self.lexicon)?,
            scene: of.scene,
        };
        let lexicon = &self.lexicon;
        self.robot.begin(now, &command, World { table, lexicon })
    }

    fn begun(&mut self, id: Id, taken: Result<Taken, Refusal>, out: &mut Vec<Packet>) {
        self.count(id);
        match taken {
            Err(refusal) => {
                let packet = refused(id, &refusal);
                out.push(packet.clone());
                // What is being done goes on, and may still be asked after.
                if !self.is_moving() {
                    self.take_up(id, Outcome::Refused, packet);
                }
            }
            Ok(_) => {
                let packet = FromRobot::from(Accepted { id }).packet();
                out.push(packet.clone());
                self.take_up(id, Outcome::Running, packet);
            }
        }
    }

    fn take_up(&mut self, id: Id, outcome: Outcome, first: Packet) {
        self.held = false;
        self.current = Some(Current {
            id,
            outcome,
            said: vec![first],
            groups: 0,
            step: 0,
            steps: 0,
            host_lost: false,
        });
    }

    /// Stands still, and begins nothing of what was given before.
    fn halt(&mut self, now: Micros, id: Id, out: &mut Vec<Packet>) {
        self.held = false;
        self.robot.stop(now);
        self.hear_robot(now, out);
        if id.number > self.newest_of(id.run) {
            self.count(id);
            // It was lost on the way, and will not be done any more.
            let packet = telling::stopped(id, 0, "before it began");
            self.take_up(id, Outcome::Void, packet);
        }
        self.ask(id, out);
    }

    /// Says again all that was said of a command.
    fn ask(&self, id: Id, out: &mut Vec<Packet>) {
        if let Some(current) = self.current.as_ref().filter(|c| c.id == id) {
            out.extend(current.said.iter().cloned());
        }
    }

    fn scene(&mut self, of: &Scene) {
        self.telling = None;
        if of.vocabulary != self.lexicon.vocabulary().fingerprint() {
            return;
        }
        self.telling = Some(Telling {
            version: of.version,
            things: usize::from(of.things),
            entities: Vec::new(),
        });
        self.told();
    }

    fn item(&mut self, of: &Item) {
        let features = self.lexicon.features().len();
        let Some(telling) = &mut self.telling else {
            return;
        };
        let next = (telling.version, telling.entities.len()) == (of.version, of.place.into());
        match entity_of(&of.thing, &of.features, features).filter(|_| next) {
            Some(entity) => telling.entities.push(entity),
            // Something was lost: the scene is told anew when a command on it is refused.
            None => self.telling = None,
        }
        self.told();
    }

    fn told(&mut self) {
        let Some(telling) = self.telling.take_if(|t| t.entities.len() >= t.things) else {
            return;
        };
        let table = Tabletop::numbered(telling.version, telling.entities, &self.lexicon);
        self.table = table.ok().or(self.table.take());
    }
}

fn named(id: Id) -> CommandId {
    CommandId {
        run: id.run,
        number: id.number.get(),
    }
}

fn refused(id: Id, refusal: &Refusal) -> Packet {
    let (reason, value, text) = reason_of(refusal);
    let refused = Refused {
        id,
        reason,
        value,
        text,
    };
    FromRobot::from(refused).packet()
}

/// What a command wants, in the vocabulary's numbers.
fn intent_of(of: &Execute, lexicon: &Lexicon) -> Result<Intent, Refusal> {
    let action = action_of(of.motion, lexicon)
        .ok_or_else(|| Refusal::UnknownMotion(format!("{:?}", of.motion)))?;
    let mut intent = Intent {
        action,
        ..Intent::default()
    };
    let option = |thing: &Thing| thing.name.get().map(|(_, option)| option);
    let amount = Some(f32::from(of.amount)).filter(|a| *a > 0.0);
    let parameters = [
        (Category::OBJECT, option(&of.object), None),
        (Category::STORAGE, option(&of.storage), None),
        (Category::DISTANCE, None, of.distance.get()),
        (
            Category::DIRECTION,
            direction_option(of.direction, lexicon),
            None,
        ),
        (Category::ANGLE, None, of.angle.get()),
        (Category::AMOUNT, None, amount),
    ];
    for (category, option, quantity) in parameters {
        if option.is_none() && quantity.is_none() {
            continue;
        }
        let option = option.unwrap_or(0);
        let parameter = Parameter {
            category,
            option,
            quantity,
        };
        // There is room for every category.
        let _ = intent.parameters.push(parameter);
    }
    Ok(intent)
}

fn entity_of(thing: &Thing, features: &Features, count: usize) -> Option<Entity> {
    let (storage, option) = thing.name.get()?;
    let features = features.0.iter().take(count);
    Some(Entity {
        category: if storage {
            Category::STORAGE
        } else {
            Category::OBJECT
        },
        option,
        position: thing.place.metres(),
        features: features.map(|f| Features::likelihood(*f)).collect(),
    })
}
