//! What is too large for one message, in parts.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::category::Category;
use crate::scene::Entity;
use crate::sentence::Word;
use crate::vocabulary::Action;

/// How many actions one part of a vocabulary carries.
pub const ACTIONS_PART: usize = 4;
/// How many things one part of a scene carries.
pub const ENTITIES_PART: usize = 2;
/// How many words one part of a sentence carries.
pub const WORDS_PART: usize = 2;

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
