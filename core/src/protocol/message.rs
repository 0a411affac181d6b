//! What unit and host say to each other. Larger things go in parts, so that a unit needs little room
//! for any one message.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use super::hand::{
    HandFault, HandSettings, HandStatistics, HandView, Meanings, SampleBytes, TemplatesPart,
};
use super::link::{Counters, Opening};
use super::seal::TAG;
use crate::category::Category;
use crate::decide::Decision;
use crate::joint::sensors::SensorError;
use crate::profile::{Profile, ProfileError};
use crate::scene::{Entity, SceneError};
use crate::sentence::{SentenceError, Word};
use crate::time::Micros;
use crate::vocabulary::{Action, VocabularyError};

/// How many actions one part of a vocabulary carries.
pub const ACTIONS_PART: usize = 4;
/// How many things one part of a scene carries.
pub const ENTITIES_PART: usize = 2;
/// How many words one part of a sentence carries.
pub const WORDS_PART: usize = 2;

/// What a host says to a unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ToUnit<const N: usize, const C: usize, const F: usize> {
    /// Opens a conversation. Its form never changes, so that ends of different versions can tell
    /// each other so.
    Hello(Hello),
    /// Twice a second and more: the host lives.
    Heartbeat(Heartbeat),
    /// Part of a vocabulary.
    Vocabulary(VocabularyPart<C>),
    /// Part of a scene.
    Scene(ScenePart<F>),
    /// How to decide.
    Configure(Configuration),
    /// Part of what one modality observed, or of the person's answer to a question.
    Sentence(SentencePart<C, N>),
    /// How the robot fares with a command.
    Robot(RobotStatus),
    /// Tell your statistics.
    AskStatistics,
    /// What a hand sensor at the host saw.
    Sample(SampleBytes),
    /// Which gestures stand for which actions; in place of all that was said about it before.
    Meanings(Meanings),
    /// How to read a hand.
    Hand(HandSettings),
    /// Part of the templates of dynamic gestures.
    Templates(TemplatesPart),
    /// Tell what you see of a hand.
    AskHand,
    /// Shows that the host has the key.
    Prove(Proof),
    /// What a sensor reports, a row of its table at a time.
    Sensor(SensorPart<N>),
    /// How the answer to a question sounded.
    Answer(Answer<N>),
}

impl<const N: usize, const C: usize, const F: usize> Opening for ToUnit<N, C, F> {
    fn opens(&self) -> bool {
        matches!(self, Self::Hello(_))
    }

    fn proves(&self) -> bool {
        matches!(self, Self::Prove(_))
    }
}

/// What a unit says to a host.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(
    clippy::large_enum_variant,
    reason = "without a heap there is nowhere to put the larger ones; how large they are differs by target"
)]
pub enum ToHost<const N: usize, const C: usize> {
    /// Answers a Hello, and is the first thing a unit says that has restarted.
    Hello(Hello),
    /// Twice a second: the unit lives.
    Heartbeat(Heartbeat),
    /// This was taken over.
    Loaded(Loaded),
    /// What to do now.
    Decision(Decided<C>),
    /// When configured: why, one category at a time.
    Why(Why<N>),
    /// When configured: why, the actions' penalties.
    WhyActions(WhyActions<N>),
    /// Something was not right; nothing was done.
    Fault(Fault),
    /// What the unit has counted.
    Statistics(Statistics),
    /// A hand has begun to say something; `false`: it is over.
    Showing(bool),
    /// Part of what a hand said, as the unit goes by it from now on.
    Shown(SentencePart<C, N>),
    /// Asked for: what the unit sees of a hand.
    Hand(HandView),
    /// Asked for: what has become of samples.
    HandStatistics(HandStatistics),
    /// Follows a Hello of a unit that has a key: what this unit has never said before, to be answered with a proof.
    Challenge(u64),
    /// The proof was right; this and all that follows is sealed.
    Proven,
}

impl<const N: usize, const C: usize> Opening for ToHost<N, C> {
    fn opens(&self) -> bool {
        matches!(self, Self::Hello(_))
    }

    fn proves(&self) -> bool {
        matches!(self, Self::Challenge(_))
    }
}

/// What a host shows to have the key with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Proof {
    /// What this host has never said before.
    pub nonce: u64,
    /// What only the key makes of it and of the unit's challenge ([`super::seal::Key::proof`]).
    pub proof: [u8; TAG],
}

/// Who speaks, and in which version.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hello {
    /// [`super::VERSION`] of the sender.
    pub version: u16,
    /// [`super::SCHEMA`] of the sender.
    pub schema: u32,
    /// Different after every start of the sender.
    pub boot: u32,
    /// What the sender can hold.
    pub capacities: Capacities,
}

/// What an end can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Capacities {
    /// Options per category, actions included.
    pub options: u16,
    /// Categories, the action's included.
    pub categories: u16,
    /// Features of a thing.
    pub features: u16,
    /// Things in a scene.
    pub entities: u16,
    /// Words in a sentence.
    pub words: u16,
    /// Bytes of a frame before stuffing.
    pub frame: u16,
}

/// The sender lives, and this is what it holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Heartbeat {
    /// The sender's clock.
    pub now: Micros,
    /// Fingerprint of its vocabulary; 0 without one.
    pub vocabulary: u32,
    /// Version of its scene; 0 without one.
    pub scene: u32,
}

/// Part of a vocabulary: up to [`ACTIONS_PART`] of its actions, and all else with each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VocabularyPart<const C: usize> {
    /// The host's hash over all names.
    pub fingerprint: u32,
    /// Options of every category after the action.
    pub parameters: Vec<u8, C>,
    /// How many features a thing has.
    pub features: u8,
    /// The action that beats everything.
    pub stop: Option<u8>,
    /// How many actions there are in all.
    pub total: u8,
    /// The place of this part's first.
    pub first: u8,
    /// The actions of this part.
    pub actions: Vec<Action, ACTIONS_PART>,
}

/// Part of a scene: up to [`ENTITIES_PART`] of its things.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScenePart<const F: usize> {
    /// The scene's number; larger than the one before, never 0.
    pub version: u32,
    /// How many things there are in all.
    pub total: u8,
    /// The place of this part's first.
    pub first: u8,
    /// The things of this part.
    pub entities: Vec<Entity<F>, ENTITIES_PART>,
}

/// How to decide.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Configuration {
    /// The variant of the method and its numbers.
    pub profile: Profile,
    /// How long to wait for further modalities after the first sentence.
    pub window: Micros,
    /// The modalities that are waited for, one bit each.
    pub expected: u8,
    /// Whether to say why with every decision.
    pub explain: bool,
}

impl Configuration {
    /// The paper's method, a second's wait for gesture and language, no reasons.
    pub const DEFAULT: Self = Self {
        profile: Profile::PAPER,
        window: Micros::from_millis(1_000),
        expected: 0b11,
        explain: false,
    };
}

/// Part of a sentence: up to [`WORDS_PART`] of its words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SentencePart<const C: usize, const N: usize> {
    /// Which modality observed it.
    pub modality: u8,
    /// The number of the decision whose question it answers; `None` for a command.
    pub answers: Option<u32>,
    /// How many words there are in all.
    pub total: u8,
    /// The place of this part's first.
    pub first: u8,
    /// The words of this part.
    pub words: Vec<Word<C, N>, WORDS_PART>,
}

/// What a sensor reports of a category.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SensorPart<const N: usize> {
    /// One row of its table.
    Row(SensorRow<N>),
    /// It has none: its figures are how likely what was seen is under each option.
    Likelihoods {
        /// Which modality.
        modality: u8,
        /// Of which category.
        category: Category,
    },
}

/// One row of a sensor's table: what a modality reports when an option is meant. Rows come in the
/// order of the options, one table after the other.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SensorRow<const N: usize> {
    /// Which modality.
    pub modality: u8,
    /// Of which category.
    pub category: Category,
    /// The option that is meant.
    pub meant: u8,
    /// What is reported of every option, in 255ths.
    pub likelihoods: Vec<u8, N>,
}

/// The answer to an open question, as likelihoods.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer<const N: usize> {
    /// The number of the decision that asked.
    pub question: u32,
    /// How likely it sounded like each answer, 0..=1: yes and no of [`crate::decide::Kind::Confirm`],
    /// the category's options of [`crate::decide::Kind::Which`].
    pub likelihoods: Vec<f32, N>,
}

/// How the robot fares with a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RobotStatus {
    /// The number of the decision that commanded it.
    pub decision: u32,
    /// How far it is.
    pub state: RobotState,
}

/// What a robot makes of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum RobotState {
    /// It is moving: percent done.
    Running(u8),
    /// It has done it.
    Done,
    /// It would not begin.
    Refused,
    /// It was stopped on the way.
    Stopped,
    /// It failed on the way.
    Failed,
}

/// What was taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Loaded {
    /// The vocabulary with this fingerprint.
    Vocabulary(u32),
    /// The scene of this version.
    Scene(u32),
    /// The configuration.
    Configuration,
    /// Which gestures stand for which actions.
    Meanings,
    /// How to read a hand.
    Hand,
    /// So many templates.
    Templates(u8),
    /// A table of a sensor.
    Sensor {
        /// Of which modality.
        modality: u8,
        /// For which category.
        category: Category,
    },
}

/// A decision and what it was made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decided<const C: usize> {
    /// Its number, counted from 1 at every start of the unit.
    pub number: u32,
    /// The fingerprint of the vocabulary it speaks.
    pub vocabulary: u32,
    /// The version of the scene it was made on.
    pub scene: u32,
    /// The modalities it draws on, one bit each.
    pub modalities: u8,
    /// How many more questions may be asked about the command after this one, if it is one; of models
    /// that do not count them as many as the profile has.
    pub questions_left: u8,
    /// What to do now.
    pub decision: Decision<C>,
}

/// Why a decision came out as it did: one category ([`crate::trace::CategoryTrace`]).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Why<const N: usize> {
    /// The decision's number.
    pub number: u32,
    /// The category.
    pub category: Category,
    /// Probability that it is in the merged sentence.
    pub present: f32,
    /// The merged word; for actions after alpha and beta.
    pub merged: Vec<f32, N>,
    /// Its diagonal cross-entropy.
    pub h: Vec<f32, N>,
    /// Its normalised entropy.
    pub entropy: f32,
    /// Against what clarity was judged.
    pub threshold: f32,
    /// Which options are clear, one bit each.
    pub clear: u64,
}

/// Why a decision came out as it did: the actions' penalties.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WhyActions<const N: usize> {
    /// The decision's number.
    pub number: u32,
    /// The merged action word before any penalty.
    pub heard: Vec<f32, N>,
    /// alpha of every action.
    pub alpha: Vec<f32, N>,
    /// beta of every action.
    pub beta: Vec<f32, N>,
}

/// Something was not right. Nothing was done about the message in question.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Fault {
    /// The other end speaks another schema; both are named.
    Schema {
        /// This unit's version and schema.
        unit: (u16, u32),
        /// The host's version and schema.
        host: (u16, u32),
    },
    /// Something was said before Hello.
    NoHello,
    /// A sentence or scene came before a vocabulary.
    NoVocabulary,
    /// A sentence came before a scene.
    NoScene,
    /// A part of a vocabulary, scene or sentence came out of order; send all parts again from the
    /// first.
    PartOutOfOrder {
        /// The place of the part's first that was expected.
        expected: u8,
        /// The place it had.
        got: u8,
    },
    /// A scene is not newer than the one that is held.
    OldScene {
        /// The version that is held.
        held: u32,
        /// The version that came.
        got: u32,
    },
    /// The vocabulary cannot be.
    Vocabulary(VocabularyError),
    /// The scene cannot be.
    Scene(SceneError),
    /// A sentence cannot be.
    Sentence {
        /// Which modality's.
        modality: u8,
        /// What is wrong with it.
        error: SentenceError,
    },
    /// The configuration cannot be.
    Configuration(ProfileError),
    /// An answer to a question that is not open.
    NoQuestion {
        /// The number that was answered.
        decision: u32,
    },
    /// The host was not heard for too long: what was waiting is forgotten.
    HostLost,
    /// Something about hands.
    Hand(HandFault),
    /// What was to show that the host has the key does not; or the unit has no key.
    NotProven,
    /// A row of a sensor's table cannot be.
    Sensor(SensorError),
    /// An answer is not one likelihood in 0..=1 per possible answer; the question stays open.
    Answer {
        /// How many there are: two of a yes or no, the options of the category otherwise.
        expected: u8,
    },
}

/// What a unit has counted since it started.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics {
    /// What has become of frames.
    pub link: Counters,
    /// Decisions to execute.
    pub executes: u32,
    /// Decisions to ask.
    pub asks: u32,
    /// Decisions to ask for a repetition.
    pub repeats: u32,
    /// Faults that were told.
    pub faults: u32,
}
