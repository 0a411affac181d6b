//! A session: a unit that decides, a robot that acts, and the table between them. It prints nothing
//! and asks nobody; whoever runs it hands in sentences and reads what happened.
//!
//! The robot moves only on an execution that the unit made of the present scene and vocabulary, in
//! sequence and complete ([`crate::unit::Distrust`] says what else there is), and it stops as soon as
//! the unit is lost. A stop goes to the robot at once and to the unit as well, and overrules whatever
//! the unit decides until it has confirmed it.

mod ends;
mod forbidding;
mod happening;
mod hearing;
pub mod journal;
mod orders;
mod seen;
mod telling;

use std::collections::VecDeque;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use deictic_core::category::Category;
use deictic_core::decide::Question;
use deictic_core::large::{self, Intent, Sentence};
use deictic_core::profile::{Model, Profile};
use deictic_core::protocol::message::Configuration;
use deictic_core::scene::SceneError;
use deictic_core::sentence::ANSWER;
use deictic_core::time::Micros;

use crate::answering::certainly;
use crate::clock;
use crate::explain::reasons::Reasons;
use crate::robot::{CommandId, Robot};
use crate::scene::Tabletop;
use crate::unit::{GestureUnit, Opener, UnitError};
use crate::vocabulary::Lexicon;

pub use happening::Happening;
pub use orders::Order;

/// How long after the pairing window a decision may take before it counts as missing.
const PATIENCE: Duration = Duration::from_secs(2);

/// What an answer weighs beside what it was asked about: it must prevail over all other modalities
/// at their surest.
pub const ANSWER_WEIGHT: f32 = 10.0;

/// How long a robot may neither say anything nor get on before it counts as hanging: several times the
/// longest motion of a careful arm.
const HANGING: Duration = Duration::from_secs(60);

/// The decision that a command comes from.
#[derive(Clone, Debug)]
struct Source {
    decision: u32,
    intent: Intent,
}

/// A command that the robot is doing.
struct Doing {
    id: CommandId,
    /// None of a way home, which the person has asked for.
    source: Option<Source>,
    /// Whether it is held.
    held: bool,
    /// Whether others have changed the table since it began.
    relaid: bool,
    /// How far it was when it last got on, and when that was.
    percent: u8,
    heard: Instant,
}

/// A unit, a robot and a table.
pub struct Session<'a> {
    lexicon: &'a Lexicon,
    unit: GestureUnit,
    robot: Box<dyn Robot>,
    table: Tabletop,
    configuration: Configuration,
    began: Instant,
    run: u32,
    commands: u32,
    doing: Option<Doing>,
    /// Commands that were overtaken by a stop, until the robot says that it stands.
    overtaken: Vec<Doing>,
    /// What the next decision is made of: the sentences since the last one that was final.
    spoken: Vec<Sentence>,
    /// The decision that asked, and what.
    question: Option<(u32, Question)>,
    /// Until when a decision is to be there.
    due: Option<Instant>,
    /// Whether a stop was given that the unit has not yet confirmed: what it decides until then was
    /// decided on what was said before.
    stopping: bool,
    /// How many prohibitions the unit has not yet confirmed, which overrule it alike.
    forbidding: u32,
    /// Until when what is shown belongs to what was forbidden.
    forbidden: Option<Instant>,
    /// What is still to be said to the unit, once the robot is ready for more.
    queue: VecDeque<Sentence>,
    /// Since when a hand has been saying something.
    showing: Option<Instant>,
    /// The reasons that are arriving, and until when they are waited for.
    reasons: Option<(Reasons, Instant)>,
    happened: Vec<Happening>,
}

impl<'a> Session<'a> {
    /// Connects to a unit and loads it.
    ///
    /// # Errors
    /// [`UnitError`] with what to do about it.
    pub fn open(
        opener: Opener,
        robot: Box<dyn Robot>,
        table: Tabletop,
        lexicon: &'a Lexicon,
        mut configuration: Configuration,
    ) -> Result<Self, UnitError> {
        weigh_answers(&mut configuration.profile);
        let unit = GestureUnit::over(opener, lexicon.vocabulary(), table.scene(), configuration)?;
        Ok(Self {
            lexicon,
            unit,
            robot,
            table,
            configuration,
            began: clock::now(),
            run: new_run(),
            commands: 0,
            doing: None,
            overtaken: Vec::new(),
            spoken: Vec::new(),
            question: None,
            due: None,
            stopping: false,
            forbidding: 0,
            forbidden: None,
            queue: VecDeque::new(),
            showing: None,
            reasons: None,
            happened: Vec::new(),
        })
    }

    /// Lays the table anew, as a scene source sees it now. The unit is told; what it decided on the table
    /// before is not executed any more.
    ///
    /// # Errors
    /// [`SceneError`] when a thing does not fit the vocabulary; the table is then as it was.
    pub fn lay(&mut self, things: Vec<large::Entity>) -> Result<(), SceneError> {
        if things == self.table.scene().entities() {
            return Ok(());
        }
        self.table.replace(things, self.lexicon)?;
        if let Some(doing) = &mut self.doing {
            doing.relaid = true;
        }
        self.happened.push(Happening::Table(self.table.version()));
        // A unit that is not there gets it when it comes back.
        let _ = self.unit.set_scene(self.table.scene());
        Ok(())
    }

    /// Stops the robot at once, without asking the unit, and drops what was still to come. A command
    /// that the unit is about to decide on is overruled.
    pub fn stop(&mut self) {
        self.halt();
        let stop = self.lexicon.vocabulary().stop();
        if self.due.is_some()
            && let Some(Ok(sentence)) =
                stop.map(|stop| certainly(Category::ACTION, stop, self.lexicon))
        {
            // A unit that cannot be told is lost, and decides nothing.
            let _ = self.observe(sentence);
        }
    }

    fn halt(&mut self) {
        self.robot.stop(self.now());
        self.question = None;
        self.drop_queue();
    }

    /// Lets things happen, waiting up to `patience` for the first of them. Call it often: it keeps
    /// the unit and the robot going.
    pub fn turn(&mut self, patience: Duration) -> Vec<Happening> {
        self.hear_robot();
        self.give_up_on_hanging();
        // What is held back until a decision's reasons come is no reason to hurry.
        let patience = if self.happened.is_empty() || self.reasons.is_some() {
            patience
        } else {
            Duration::ZERO
        };
        for event in self.unit.poll(patience) {
            self.hear_unit(event);
        }
        if !self.waits_for_hand() && self.due.is_some_and(|due| clock::now() >= due) {
            self.due = None;
            self.happened.push(Happening::NoDecision);
            self.drop_queue();
            // Whatever it still had in hand must not come as a surprise later.
            self.unit.forget();
        }
        if self
            .reasons
            .as_ref()
            .is_some_and(|(_, until)| clock::now() >= *until)
        {
            self.tell_reasons();
        }
        let still = self.doing.is_none() && self.overtaken.is_empty();
        let ready = self.due.is_none() && still && self.question.is_none();
        if ready
            && self.unit.is_there()
            && let Some(next) = self.queue.pop_front()
            && self.observe(next).is_err()
        {
            self.drop_queue();
        }
        if self.reasons.is_some() {
            // What follows the decision is told after its reasons, which are a frame or two behind.
            return Vec::new();
        }
        std::mem::take(&mut self.happened)
    }

    fn now(&self) -> Micros {
        Micros(u64::try_from(clock::since(self.began).as_micros()).unwrap_or(u64::MAX))
    }

    /// Puts the reasons behind the decision that they are for.
    fn tell_reasons(&mut self) {
        let Some((reasons, _)) = self.reasons.take() else {
            return;
        };
        let decided = |h: &Happening| matches!(h, Happening::Decided { .. });
        let place = self.happened.iter().rposition(decided).map_or(0, |i| i + 1);
        let reasons = Happening::Reasons(Box::new(reasons));
        self.happened.insert(place, reasons);
    }

    fn drop_queue(&mut self) {
        if !self.queue.is_empty() {
            self.happened.push(Happening::Dropped(self.queue.len()));
            self.queue.clear();
        }
    }
}

/// Of the joint model an answer is a word like any other.
fn weigh_answers(profile: &mut Profile) {
    if profile.model != Model::Joint
        && let Some(weight) = profile.weights.get_mut(usize::from(ANSWER))
    {
        *weight = ANSWER_WEIGHT;
    }
}

/// Tells one run of a bridge from another, so that a robot that remembers what it was given does not take
/// the commands of this one for those of the last.
fn new_run() -> u32 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    let millis = since.map_or(0, |since| since.as_millis());
    // The lower half of the milliseconds comes back after 49 days.
    (millis as u32) ^ std::process::id().rotate_left(16)
}
