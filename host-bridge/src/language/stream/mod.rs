//! Streams of time-stamped hypotheses, as recognisers give them: words, each with alternatives and
//! their probabilities, and gestures likewise; fused by alignment over a grammar that follows from
//! the actions' signatures.
//!
//! Positions in the two streams need not agree, words may be covered by a hesitation or cut off, and
//! the parts of a sentence may come in any order. What stays open is asked for, not guessed.

mod align;
mod evidence;
mod fuse;
mod grammar;
mod orders;

pub use fuse::{Fused, Open, Outcome, Part};
pub use grammar::{Class, Grammar, GrammarError, Signature, Words};

/// What was recognised at one moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hypothesis {
    /// When, in seconds.
    pub time: f64,
    /// The alternatives with their probabilities, 0..=1, which need not sum to 1.
    pub words: Vec<(String, f64)>,
}

/// What was recognised of one sentence.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Streams {
    /// What was heard, in order of time.
    pub voice: Vec<Hypothesis>,
    /// What was seen, in order of time: actions that were shown, things that were pointed at.
    pub gesture: Vec<Hypothesis>,
}
