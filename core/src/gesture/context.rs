//! What a hand reader goes by, and what it tells.

use super::mapping::Mapping;
use super::pointing::{Aim, Mount};
use super::stroke::Templates;
use crate::scene::Scene;
use crate::vocabulary::Vocabulary;

/// What the reader goes by: fixed while a hand is there.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a, const N: usize, const C: usize, const F: usize, const E: usize> {
    /// What can be said and shown.
    pub vocabulary: &'a Vocabulary<N, C, F>,
    /// What can be pointed at.
    pub scene: &'a Scene<E, F>,
    /// Which gestures stand for which actions.
    pub mapping: &'a Mapping,
    /// Examples of the dynamic gestures.
    pub templates: Templates<'a>,
    /// Where the sensor stands.
    pub mount: &'a Mount,
    /// How well the person aims.
    pub aim: &'a Aim,
}

/// What a sample led to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// A word has begun; there are this many before it.
    Opened(u8),
    /// A word is complete; there are this many now.
    Closed(u8),
    /// The hand has left: [`super::reader::HandReader::said`] is what it said.
    Said,
    /// The stop gesture. [`super::reader::HandReader::said`] is this one action, nothing is waited
    /// for.
    Stop,
    /// The sensor fell silent while a hand was there. What it had said is forgotten, as nobody knows
    /// what it would have said.
    SensorLost,
}
