//! A clause: what follows from another how, and what it is.

use super::pack::Role;
use super::read::{Piece, What};

/// How a clause follows the one before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// First of its sentence.
    Start,
    /// After it.
    Then,
    /// With it.
    And,
    /// Or it.
    Or,
    /// Beside it, after a comma or nothing.
    Comma,
    /// In contrast to it.
    But,
    /// In its place.
    Correct,
    /// Withdraws all before.
    Retract,
    /// Done after it, though said before or behind it: `true` when it leads the sentence.
    Later(bool),
    /// Done before it: `true` when it leads the sentence.
    Earlier(bool),
}

/// What a clause is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mood {
    /// To be done.
    Command,
    /// Not to be done.
    Negated,
    /// Asked.
    Question,
    /// To be done under a condition that nobody checks.
    Conditional,
    /// Told of.
    Told,
    /// To be done by who speaks.
    Own,
    /// To be done at another time.
    Timed,
}

/// A clause.
#[derive(Clone, Debug, PartialEq)]
pub struct Clause {
    /// How it follows.
    pub link: Link,
    /// What it is.
    pub mood: Mood,
    /// Its pieces, without those that link it.
    pub pieces: Vec<Piece>,
}

/// Says nothing by itself, wherever it stands.
pub(super) fn is_empty(piece: &Piece) -> bool {
    piece.what == What::Comma
        || !piece.is_name()
            && [Role::Filler, Role::Polite, Role::Chatter]
                .iter()
                .any(|&role| piece.is(role))
}
