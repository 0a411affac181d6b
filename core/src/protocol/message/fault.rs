//! What can be wrong with what a host says.

use serde::{Deserialize, Serialize};

use crate::joint::sensors::SensorError;
use crate::profile::ProfileError;
use crate::protocol::hand::HandFault;
use crate::scene::SceneError;
use crate::sentence::SentenceError;
use crate::vocabulary::VocabularyError;

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
