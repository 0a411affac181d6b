//! A session: a unit that decides, a robot that acts, and the table between them. It prints nothing
//! and asks nobody; whoever runs it hands in sentences and reads what happened.
//!
//! The robot moves only on an execution that the unit made of the present scene and vocabulary, in
//! sequence and complete ([`crate::unit::Distrust`] says what else there is), and it stops as soon as
//! the unit is lost. A stop goes to the robot at once and to the unit as well, and overrules whatever
//! the unit decides until it has confirmed it.

mod happening;
mod hearing;
pub mod journal;

use std::collections::VecDeque;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use deictic_core::category::Category;
use deictic_core::decide::Question;
use deictic_core::gesture::wire::Sample;
use deictic_core::large::{self, Intent, Sentence};
use deictic_core::protocol::message::Configuration;
use deictic_core::scene::SceneError;
use deictic_core::time::Micros;
use deictic_core::unit::pairing::{ANSWER, HAND_PATIENCE};

use crate::answering::certainly;
use crate::clock;
use crate::explain::reasons::Reasons;
use crate::hand::meaning::HandSetup;
use crate::robot::{CommandId, Posture, Robot};
use crate::scene::Tabletop;
use crate::sensor_model::SensorModel;
use crate::understanding::is_stop;
use crate::unit::{GestureUnit, Opener, UnitError};
use crate::vocabulary::Lexicon;

pub use happening::Happening;

/// How long after the pairing window a decision may take before it counts as missing.
const PATIENCE: Duration = Duration::from_secs(2);

/// What an answer weighs beside what it was asked about: it must prevail over all other modalities
/// at their surest.
pub const ANSWER_WEIGHT: f32 = 10.0;

/// How long a robot may neither say anything nor get on before it counts as hanging: several times the
/// longest motion of a careful arm.
const HANGING: Duration = Duration::from_secs(60);

/// A command that the robot is doing, and the decision it comes from.
struct Doing {
    id: CommandId,
    decision: u32,
    intent: Intent,
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
        if let Some(weight) = configuration.profile.weights.get_mut(usize::from(ANSWER)) {
            *weight = ANSWER_WEIGHT;
        }
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
            queue: VecDeque::new(),
            showing: None,
            reasons: None,
            happened: Vec::new(),
        })
    }

    /// The table as it is now.
    #[must_use]
    pub fn table(&self) -> &Tabletop {
        &self.table
    }

    /// The names of everything.
    #[must_use]
    pub fn lexicon(&self) -> &'a Lexicon {
        self.lexicon
    }

    /// The unit.
    #[must_use]
    pub fn unit(&self) -> &GestureUnit {
        &self.unit
    }

    /// The question that waits for the person's answer.
    #[must_use]
    pub fn question(&self) -> Option<&Question> {
        self.question.as_ref().map(|(_, question)| question)
    }

    /// What is in the robot's hand.
    #[must_use]
    pub fn holding(&self) -> Option<&str> {
        self.robot.holding()
    }

    /// How many percent of its command the robot has done, while it is doing one.
    #[must_use]
    pub fn progress(&self) -> Option<u8> {
        self.robot.progress(self.now()).map(|(_, percent)| percent)
    }

    /// How the arm stands, where the robot says so.
    #[must_use]
    pub fn posture(&self) -> Option<Posture> {
        self.robot.posture(self.now())
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
        self.happened.push(Happening::Table(self.table.version()));
        // A unit that is not there gets it when it comes back.
        let _ = self.unit.set_scene(self.table.scene());
        Ok(())
    }

    /// Whether nothing is going on: no decision is waited for, the robot stands still, nothing is
    /// queued. A question may be open.
    #[must_use]
    pub fn is_idle(&self) -> bool {
        self.due.is_none()
            && self.doing.is_none()
            && self.overtaken.is_empty()
            && self.queue.is_empty()
            && self.reasons.is_none()
            && self.happened.is_empty()
    }

    /// Whether the unit waits for what this modality observes, having heard of another.
    #[must_use]
    pub fn is_waiting_for(&self, modality: u8) -> bool {
        self.due.is_some()
            && self.doing.is_none()
            && self.question.is_none()
            && !self.stopping
            && !self.spoken.is_empty()
            && self.spoken.iter().all(|s| s.modality() != modality)
    }

    /// Whether a hand is in the middle of a sentence.
    #[must_use]
    pub fn is_showing(&self) -> bool {
        self.showing.is_some()
    }

    /// Tells the unit what a modality observed, at once. A clear stop stops the robot first.
    ///
    /// # Errors
    /// [`UnitError`] when the unit is not there; a stop has been carried out all the same.
    pub fn observe(&mut self, sentence: Sentence) -> Result<(), UnitError> {
        if is_stop(&sentence, self.lexicon, &self.configuration.profile) {
            self.halt();
            self.stopping = true;
        }
        self.hears(&sentence);
        self.spoken.push(sentence.clone());
        self.unit.observe(sentence)?;
        let window = Duration::from_micros(self.configuration.window.0);
        self.due = Some(clock::now() + window + PATIENCE);
        Ok(())
    }

    /// A sentence that is no answer ends the question, and what was said before by the same modality.
    fn hears(&mut self, sentence: &Sentence) {
        let modality = sentence.modality();
        if self.question.take().is_some() || self.spoken.iter().any(|s| s.modality() == modality) {
            self.spoken.clear();
        }
    }

    /// Tells the unit how to read a hand.
    ///
    /// # Errors
    /// [`UnitError`] when the unit is not there; it is told when it comes back.
    pub fn set_hand(&mut self, setup: HandSetup) -> Result<(), UnitError> {
        self.unit.set_hand(setup)
    }

    /// As [`GestureUnit::set_sensors`].
    ///
    /// # Errors
    /// [`UnitError`]; the unit is told when it comes back.
    pub fn set_sensors(&mut self, sensors: SensorModel) -> Result<(), UnitError> {
        self.unit.set_sensors(sensors)
    }

    /// Tells the unit what a hand sensor at this machine saw.
    ///
    /// # Errors
    /// [`UnitError`] when the unit is not there.
    pub fn sense(&mut self, sample: &Sample) -> Result<(), UnitError> {
        self.unit.sense(sample)
    }

    /// Whether a hand is in the middle of something, which a decision waits for.
    fn waits_for_hand(&self) -> bool {
        let patience = Duration::from_micros(HAND_PATIENCE.0) + PATIENCE;
        self.showing
            .is_some_and(|since| clock::now() < since + patience)
    }

    /// Tells the unit further sentences one by one, each when the robot is done with the one before.
    /// They are dropped as soon as one of them is not executed to its end.
    pub fn queue(&mut self, sentences: impl IntoIterator<Item = Sentence>) {
        self.queue.extend(sentences);
    }

    /// Takes back what was queued and not begun; what the robot is doing goes on.
    pub fn cancel(&mut self) {
        self.drop_queue();
    }

    /// Tells the unit the answer to its question.
    ///
    /// # Errors
    /// [`UnitError`] when the unit is not there.
    pub fn answer(&mut self, sentence: Sentence) -> Result<(), UnitError> {
        let Some((decision, _)) = self.question.take() else {
            return self.observe(sentence);
        };
        self.spoken.push(sentence.clone());
        self.unit.answer(decision, sentence)?;
        self.due = Some(clock::now() + PATIENCE);
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
        let patience = if self.happened.is_empty() {
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

/// Tells one run of a bridge from another, so that a robot that remembers what it was given does not take
/// the commands of this one for those of the last.
fn new_run() -> u32 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    let millis = since.map_or(0, |since| since.as_millis());
    // The lower half of the milliseconds comes back after 49 days.
    (millis as u32) ^ std::process::id().rotate_left(16)
}
