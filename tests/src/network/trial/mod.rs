//! One session under faults, and what must hold of it whatever happens.

mod holds;
mod mishap;

use std::time::Duration;

use deictic::clock::Simulated;
use deictic::link::Wire;
use deictic::session::{Happening, Session};
use deictic::unit::UnitError;
use deictic_bits::random::Random;
use deictic_core::decide::Outcome;
use deictic_core::protocol::message::Configuration;
use deictic_core::protocol::seal::{KEY, Key};
use deictic_core::sentence::LANGUAGE;
use deictic_core::time::Micros;

use super::around::Around;
use super::line::Faults;
pub use super::setting::Setting;
use super::watch::Watch;
use super::world::World;

/// How a command ended: exactly one of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// The robot did it.
    Done,
    /// Something would not do it, and said so.
    Refused,
    /// The person was asked, and answers with a new command.
    Asked,
    /// It was stopped, before or on the way.
    Stopped,
    /// It was lost, and the person was told.
    Lost,
}

/// What came of a session.
#[derive(Clone, Debug, Default)]
pub struct Account {
    /// How its commands ended.
    pub ends: Vec<End>,
    /// How many commands the robot began.
    pub begun: usize,
    /// How often the unit was lost.
    pub losses: usize,
    /// The longest the robot moved after the last whole frame from the unit.
    pub alone: Micros,
}

/// What is said and shown, as the vocabulary calls it.
const COMMANDS: [&str; 8] = [
    "pick can",
    "put-into can drawer",
    "push cube",
    "unglue box",
    "move-up",
    "pick cup",
    "put-into cup bowl",
    "release",
];

/// How long one turn of the session waits.
const TURN: Duration = Duration::from_millis(20);

/// How long a command may take until it must have ended, whatever the faults.
const PATIENCE: Micros = Micros::from_millis(120_000);

/// Runs the session of this seed; unit and bridge have a key when it is odd.
///
/// # Panics
/// When something does not hold.
#[must_use]
pub fn run(setting: &Setting, seed: u64) -> Account {
    let clock = Simulated::start();
    let mut random = Random::new(seed);
    let key = Key::new(&[7; KEY]).filter(|_| !seed.is_multiple_of(2));
    let world = World::keyed(random.next(), key);
    let explain = random.one_in(4);
    let mut trial =
        Trial::open(setting, world, random.next(), explain).expect("nothing is wrong yet");
    if trial.random.one_in(4) {
        let width = 1 + trial.random.below(40) as usize;
        trial.world.narrow(width);
    }
    for _ in 0..1 + trial.random.below(3) {
        trial.command(setting);
    }
    drop(clock);
    trial.account()
}

/// Faults of one session: mostly one or two kinds, from hardly any to every other frame.
fn faults(random: &mut Random) -> Faults {
    let mut often = || match random.below(3) {
        0 => 2 + random.below(60),
        _ => 0,
    };
    Faults {
        lost: often(),
        flipped: often(),
        burst: often(),
        cut: often(),
        doubled: often(),
        delayed: often(),
        noise: often(),
    }
}

/// A session under way, in the midst of what goes wrong.
pub struct Trial<'a, A> {
    /// The action that stops.
    stop: Option<u8>,
    session: Session<'a>,
    world: A,
    /// When the session began, from which it counts the robot's time.
    began: Micros,
    robot: Watch,
    faults: Faults,
    random: Random,
    account: Account,
    /// All that happened since the command was given.
    happened: Vec<Happening>,
    /// How many of the robot's commands have been looked at.
    watched: usize,
    /// How late the bridge may find something out.
    late: Duration,
}

impl<'a, A: Around + Wire + Clone + Send + 'static> Trial<'a, A> {
    /// A session whose faults follow from the seed; with `explain` it asks for the reasons of every decision, and for
    /// statistics.
    ///
    /// # Errors
    /// When the unit cannot be loaded over a good line.
    pub fn open(
        setting: &'a Setting,
        world: A,
        seed: u64,
        explain: bool,
    ) -> Result<Self, UnitError> {
        let mut random = Random::new(seed);
        let robot = Watch::new(1.0 + random.below(8) as f32);
        let wire = world.clone();
        let session = Session::open(
            Box::new(move || {
                wire.opened();
                Ok(Box::new(wire.clone()) as Box<dyn Wire>)
            }),
            Box::new(robot.clone()),
            setting.table.clone(),
            &setting.lexicon,
            Configuration {
                window: Micros::from_millis(600),
                explain,
                ..Configuration::DEFAULT
            },
        )?;
        let faults = faults(&mut random);
        world.set_faults(faults);
        Ok(Self {
            stop: setting.lexicon.vocabulary().stop(),
            session,
            began: world.now(),
            world,
            robot,
            faults,
            random,
            account: Account::default(),
            happened: Vec::new(),
            watched: 0,
            late: 2 * TURN,
        })
    }

    /// Time passes many times as fast as this machine's, which has other work too: what is found out may be found out
    /// later.
    pub fn in_a_hurry(&mut self) {
        self.late = Duration::from_secs(900);
    }

    /// From now on the line has other faults, or, every second time, none.
    pub fn change_faults(&mut self) {
        self.faults = match self.random.one_in(2) {
            true => Faults::NONE,
            false => faults(&mut self.random),
        };
        self.world.set_faults(self.faults);
    }

    /// What came of it.
    #[must_use]
    pub fn account(mut self) -> Account {
        self.check_robot();
        self.account.begun = self.robot.seen().begun.len();
        self.account
    }

    /// Gives a command and lets it come to its end, whatever happens.
    ///
    /// # Panics
    /// When something does not hold.
    pub fn command(&mut self, setting: &Setting) {
        let text = COMMANDS[self.random.below(COMMANDS.len() as u32) as usize];
        self.happened.clear();
        let began = self.world.now();
        let given = self.session.observe(setting.say(text, LANGUAGE)).is_ok()
            && self.session.observe(setting.say(text, 0)).is_ok();
        let mut stopped = false;
        let mut mishaps = self.random.below(3);
        let mut at = self.random.below(120);
        let mut turns = 0_u32;
        loop {
            self.turn();
            if turns == at && mishaps > 0 {
                stopped |= self.mishap(setting);
                mishaps -= 1;
                at = turns + 1 + self.random.below(60);
            }
            turns += 1;
            let idle = self.session.is_idle() && self.session.unit().is_there();
            if idle && mishaps == 0 {
                break;
            }
            let waited = self.world.now().since(began);
            assert!(
                waited
                    < PATIENCE
                        .after(PATIENCE)
                        .after(Micros(self.late.as_micros() as u64)),
                "it never ends: {:#?}",
                self.happened
            );
            if waited > PATIENCE {
                // With a line this bad nothing can be loaded; the person mends it.
                self.world.set_faults(Faults::NONE);
                self.world.narrow(usize::MAX);
                mishaps = 0;
            } else if idle && mishaps > 0 {
                at = turns;
            }
        }
        self.world.set_faults(self.faults);
        self.robot.revive();
        let end = self.end(given, stopped);
        self.account.ends.push(end);
    }

    fn turn(&mut self) {
        let happened = self.session.turn(TURN);
        let stops = |h: &Happening| match h {
            Happening::Decided { decision, .. } => match &decision.outcome {
                Outcome::Execute(intent) => Some(intent.action) == self.stop,
                _ => false,
            },
            _ => false,
        };
        if happened.last().is_some_and(stops) {
            // By the unit's word: in the very moment in which it is heard, none of the arm's control periods later.
            self.check_still();
        }
        self.account.losses += happened
            .iter()
            .filter(|h| matches!(h, Happening::Lost(_)))
            .count();
        self.happened.extend(happened);
        self.check_motion();
        self.check_robot();
    }
}
