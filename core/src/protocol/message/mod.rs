//! What unit and host say to each other. Larger things go in parts, so that a unit needs little room
//! for any one message.

mod fault;
mod parts;
mod told;

use heapless::Vec;
use serde::{Deserialize, Serialize};

use super::hand::{HandSettings, HandStatistics, HandView, Meanings, SampleBytes, TemplatesPart};
use super::link::Opening;
use super::seal::TAG;
use crate::category::Category;
use crate::profile::Profile;
use crate::time::Micros;

pub use fault::Fault;
pub use parts::{
    ACTIONS_PART, ENTITIES_PART, ScenePart, SensorPart, SensorRow, SentencePart, VocabularyPart,
    WORDS_PART,
};
pub use told::{Decided, Statistics, Why, WhyActions, WhyWhole, Withheld};

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
    /// Pass on what your own hand sensor sends, or stop to.
    Relay(bool),
    /// This modality forbade, asked or told something, or said what nobody understood: what waits, and what others show
    /// within the pairing window, is not to be done.
    Forbid(u8),
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
    /// Asked for: what the unit's own hand sensor sent.
    Sample(SampleBytes),
    /// When configured: why, the whole intent; of the joint model.
    WhyWhole(WhyWhole),
    /// This is not decided on, as it was forbidden.
    Withheld(Withheld),
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
