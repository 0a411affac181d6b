//! Where one clause ends and the next begins.

use deictic_core::category::Category;

use super::clause::{Clause, Link, Mood, is_empty};
use super::pack::Role;
use super::read::{Piece, What};
use super::table::{Meaning, Table};

/// What the next piece that says anything is.
fn ahead(rest: &[Piece]) -> Option<&Piece> {
    let skipped = [Role::And, Role::Then, Role::But];
    rest.iter()
        .find(|p| !is_empty(p) && !skipped.iter().any(|&role| p.is(role)))
}

fn opens(piece: &Piece) -> bool {
    const OPENERS: [Role; 9] = [
        Role::Own,
        Role::Report,
        Role::Not,
        Role::Request,
        Role::Question,
        Role::RequestQuestion,
        Role::Subject,
        Role::Condition,
        Role::Correct,
    ];
    is_verb(piece)
        || piece.forms().next().is_some()
        || OPENERS.iter().any(|&role| piece.is(role)) && !piece.is(Role::Relative)
}

/// Names an action and is nothing that goes with one.
pub(super) fn is_verb(piece: &Piece) -> bool {
    let with = [Role::Particle, Role::Place, Role::Storage, Role::Filler];
    piece.is_head()
        || piece.is_action()
            && !with.iter().any(|&role| piece.is(role))
            && piece.names(Category::DIRECTION).next().is_none()
}

struct Splitter<'a> {
    table: &'a Table,
    done: Vec<Clause>,
    link: Link,
    pieces: Vec<Piece>,
}

impl Splitter<'_> {
    fn cut(&mut self, next: Link) {
        let pieces = std::mem::take(&mut self.pieces);
        let kept = pieces.iter().any(|p| p.what != What::Comma);
        if kept || matches!(self.link, Link::Correct | Link::Retract) {
            let link = self.link;
            self.done.push(Clause {
                link,
                mood: Mood::Command,
                pieces,
            });
            self.link = next;
        } else if next != Link::Comma && !(self.link == Link::But && next == Link::And) {
            self.link = next;
        }
    }

    /// Whether something was said that a "not" ahead of `rest` does not forbid: "pick the box, not
    /// the cup", but "pick anything but the cup" and "the box do not push".
    fn begun(&self, rest: &[Piece]) -> bool {
        let paused = self.pieces.last().is_some_and(|p| p.what == What::Comma);
        let verb = self.verb().is_some();
        match ahead_is_verb(rest) {
            true => verb,
            false => self.has_thing() || verb && paused,
        }
    }

    /// Whether what comes before or after was said whole: "after picking the cup", and then the command.
    fn is_told_first(&self) -> bool {
        matches!(self.link, Link::Earlier(true) | Link::Later(true))
            && self.has_thing()
            && self.pieces.iter().any(|p| p.forms().next().is_some())
    }

    fn has_thing(&self) -> bool {
        self.pieces
            .iter()
            .any(|p| p.is_thing() || p.is(Role::Pointed))
    }

    /// Whether a "no" forbids what is next: "no picking", "no cup"; but "no, pick", "the box no the
    /// cup". "No stop" stops, as that harms nobody.
    fn refuses(&self, next: Option<&Piece>) -> bool {
        let stops = |p: &Piece| p.is_action() && p.names(Category::ACTION).eq(self.table.stop);
        next.is_some_and(|p| {
            p.forms().next().is_some()
                || is_verb(p) && !stops(p)
                || p.is_thing() && !self.has_thing()
        })
    }

    /// Whether a thing alone was denied, so that the right one comes next: "not the cup, the box".
    fn denies(&self) -> bool {
        let verb = |p: &Piece| is_verb(p) || p.forms().next().is_some();
        self.pieces.iter().any(|p| p.is(Role::Not))
            && self.pieces.iter().any(Piece::is_thing)
            && !self.pieces.iter().any(verb)
    }

    fn verb(&self) -> Option<&Piece> {
        self.pieces.iter().find(|p| p.is_action() || p.is_head())
    }

    /// Whether the clause's verb and this piece are one action, as "pick ... up" is.
    fn completes(&self, piece: &Piece) -> bool {
        let whole = |verb: &Piece| !joined(verb, piece, self.table).is_empty();
        self.verb().is_some_and(whole)
    }
}

/// The actions that a verb and a later particle name together.
#[must_use]
pub fn joined(verb: &Piece, particle: &Piece, table: &Table) -> Vec<u8> {
    let words: Vec<_> = verb
        .words
        .split(' ')
        .chain(particle.words.split(' '))
        .collect();
    let actions = table.meanings(&words).iter().filter_map(|m| match m {
        Meaning::Name(Category::ACTION, option) => Some(*option),
        _ => None,
    });
    actions.collect()
}

/// The clauses of a sentence, all taken for commands.
pub(super) fn split(pieces: Vec<Piece>, table: &Table) -> Vec<Clause> {
    let mut s = Splitter {
        table,
        done: Vec::new(),
        link: Link::Start,
        pieces: Vec::new(),
    };
    for (i, piece) in pieces.iter().enumerate() {
        let rest = pieces.get(i + 1..).unwrap_or_default();
        let not = || Piece {
            what: What::Known(vec![Meaning::Role(Role::Not)]),
            ..piece.clone()
        };
        let separates =
            [Role::And, Role::Or].iter().any(|&r| piece.is(r)) || piece.what == What::Comma;
        if piece.is_name() && !separates {
            let verb = s.verb();
            let again = !s.has_thing()
                && verb
                    .is_some_and(|v| v.names(Category::ACTION).eq(piece.names(Category::ACTION)));
            let begun = verb.is_some() || s.is_told_first();
            if is_verb(piece) && begun && !again && !s.completes(piece) {
                s.cut(Link::Comma);
            }
            s.pieces.push(piece.clone());
        } else if piece.is(Role::Retract) {
            // "Never mind the cup" does not withdraw and then name a cup.
            let about = rest
                .iter()
                .take_while(|p| p.what != What::Comma)
                .any(Piece::is_thing);
            s.cut(Link::Retract);
            s.cut(Link::Start);
            if about {
                s.pieces.push(not());
            }
        } else if piece.is(Role::Refuse) && (s.refuses(rest.first()) || excludes(piece, rest)) {
            if s.verb().is_none() || s.has_thing() {
                s.cut(Link::Comma);
            }
            s.pieces.push(not());
        } else if piece.is(Role::Correct) {
            s.cut(Link::Correct);
        } else if piece.is(Role::Then) {
            s.cut(Link::Then);
        } else if piece.is(Role::But) {
            s.cut(Link::But);
        } else if piece.is(Role::Before) || piece.is(Role::After) {
            let later = piece.is(Role::After);
            s.cut(Link::Start);
            let leads = s.done.is_empty();
            s.link = if later {
                Link::Earlier(leads)
            } else {
                Link::Later(leads)
            };
        } else if piece.is(Role::Not) && s.begun(rest) {
            s.cut(Link::Comma);
            s.pieces.push(piece.clone());
        } else if piece.what == What::Comma && s.denies() {
            s.cut(Link::But);
        } else if separates {
            match ahead(rest) {
                Some(p) if opens(p) && !s.completes(p) => s.cut(match () {
                    () if piece.is(Role::And) => Link::And,
                    () if piece.is(Role::Or) => Link::Or,
                    () => Link::Comma,
                }),
                _ => s.pieces.push(piece.clone()),
            }
        } else {
            s.pieces.push(piece.clone());
        }
    }
    s.cut(Link::Start);
    s.done
}

/// Whether a verb comes before the next comma.
fn ahead_is_verb(rest: &[Piece]) -> bool {
    rest.iter()
        .take_while(|p| p.what != What::Comma)
        .any(|p| is_verb(p) || p.forms().next().is_some())
}

/// Where one word is "no" and "not", as "ne" is in Czech, only a pause behind it makes it "no".
fn excludes(piece: &Piece, rest: &[Piece]) -> bool {
    let next = rest.first();
    piece.is(Role::Not) && next.is_some_and(|p| p.what != What::Comma && !is_verb(p))
}
