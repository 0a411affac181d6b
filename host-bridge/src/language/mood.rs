//! Pieces to clauses, and which of them are no commands at all but prohibitions, questions, conditions, tales or talk.

use deictic_core::category::Category;

use super::clause::{Clause, Link, Mood, is_empty};
use super::pack::Role;
use super::read::{Piece, What};
use super::split::{is_verb, split};
use super::table::Table;

/// The clauses of a text.
#[must_use]
pub fn clauses(pieces: &[Piece], table: &Table) -> Vec<Clause> {
    let mut all = Vec::new();
    let ends = |p: &Piece| matches!(p.what, What::Stop | What::Question);
    for sentence in pieces.split_inclusive(ends) {
        let asked = sentence.last().is_some_and(|p| p.what == What::Question);
        let words = sentence.iter().filter(|p| !ends(p)).cloned().collect();
        all.push(of_sentence(words, asked, table));
    }
    // "Push the cube!" he said.
    for at in 0..all.len() {
        let only = |list: &Vec<Clause>| {
            let said = |c: &Clause| c.pieces.iter().any(says);
            list.iter().any(|c| reports(c, table)) && !list.iter().any(said)
        };
        if all.get(at).is_some_and(only) {
            for beside in [at.checked_sub(1), at.checked_add(1)] {
                let list = beside.and_then(|beside| all.get_mut(beside));
                instead(
                    list.map_or(&mut [], |list| list.as_mut_slice()),
                    Mood::Told,
                    table,
                );
            }
        }
    }
    all.concat()
}

/// Makes this of the commands. Only a stop is one however it is said, as it harms nobody.
fn instead(list: &mut [Clause], mood: Mood, table: &Table) {
    let stops = |p: &Piece| p.is_action() && p.names(Category::ACTION).eq(table.stop);
    let commands = list.iter_mut().filter(|c| c.mood == Mood::Command);
    for clause in commands.filter(|c| !c.pieces.iter().any(stops)) {
        clause.mood = mood;
    }
}

/// Whether a clause tells what somebody said: with a word for it, or with a verb behind its subject
/// that is not known but has a verb's ending, as "he bellowed" has.
fn reports(clause: &Clause, table: &Table) -> bool {
    let endings = &table.pack().endings.verb;
    let verb = |p: &Piece| {
        p.what == What::Unknown && endings.iter().any(|e| p.words.ends_with(e.as_str()))
    };
    let tells = |pair: &[Piece]| match pair {
        [subject, next] => subject.is(Role::Subject) && verb(next),
        _ => false,
    };
    let word = |p: &Piece| p.is(Role::Report) && !p.is_name();
    clause.pieces.iter().any(word) || clause.pieces.windows(2).any(tells)
}

fn of_sentence(mut pieces: Vec<Piece>, mut asked: bool, table: &Table) -> Vec<Clause> {
    if asked && drop_tag(&mut pieces, table) {
        asked = false;
    }
    let polite = pieces.iter().any(|p| p.is(Role::Polite));
    let leads = |p: &&Piece| {
        let skipped = [Role::And, Role::Then, Role::Correct, Role::But];
        !is_empty(p) && (p.is(Role::Question) || !skipped.iter().any(|&role| p.is(role)))
    };
    let first = pieces.iter().find(leads);
    let questioned = first.is_some_and(|p| p.is(Role::Question))
        || !polite && (asked || first.is_some_and(|p| p.is(Role::RequestQuestion)));
    let conditional = pieces.iter().any(|p| p.is(Role::Condition) && !p.is_name());
    let mut list = split(pieces.clone(), table);
    // "Once the cup is empty, push it" waits for what nobody checks.
    let waits = |c: &Clause| matches!(c.link, Link::Earlier(_)) && mood(c, polite) == Mood::Told;
    let conditional = conditional || list.iter().any(waits);
    let mut carried = None;
    for clause in &mut list {
        clause.mood = match () {
            () if questioned => Mood::Question,
            () if conditional => Mood::Conditional,
            () => mood(clause, polite),
        };
        let bound = matches!(clause.link, Link::And | Link::Or);
        match carried {
            Some((mood, empty)) if clause.mood == Mood::Command && (bound || empty) => {
                clause.mood = mood;
            }
            _ => {}
        }
        // A question is asked up to the end of its sentence; "don't" without a verb forbids what
        // comes next.
        let empty = clause.mood == Mood::Question
            || clause.mood == Mood::Negated && !clause.pieces.iter().any(says);
        carried = (clause.mood != Mood::Command).then_some((clause.mood, empty));
    }
    if list.iter().any(|c| reports(c, table)) {
        instead(&mut list, Mood::Told, table);
    }
    if pieces.iter().any(|p| p.is(Role::Time) && !p.is_name()) {
        instead(&mut list, Mood::Timed, table);
    }
    list
}

/// Takes ", ok?" and the like off the end.
fn drop_tag(pieces: &mut Vec<Piece>, table: &Table) -> bool {
    let tags = &table.pack().tags.plain;
    let is_tag = pieces.last().is_some_and(|p| tags.contains(&p.words));
    let before = pieces.len().checked_sub(2).and_then(|i| pieces.get(i));
    let set_off = before.is_some_and(|p| p.what == What::Comma);
    let drop = is_tag && set_off && pieces.last().is_some_and(|p| !p.is(Role::Polite));
    if drop {
        pieces.truncate(pieces.len() - 2);
    }
    drop
}

fn says(piece: &Piece) -> bool {
    piece.is_name() || piece.forms().next().is_some() || piece.is(Role::Pointed)
}

fn mood(clause: &Clause, polite: bool) -> Mood {
    let pieces = &clause.pieces;
    let place = |test: &dyn Fn(&Piece) -> bool| pieces.iter().position(test);
    let action = place(&|p| (p.is_action() || p.is_head()) && !p.is(Role::Particle));
    let told_of = |at: Option<usize>| at.is_some_and(|at| action.is_none_or(|a| at < a));
    let temporal = matches!(clause.link, Link::Later(_) | Link::Earlier(_));
    let request = place(&|p| p.is(Role::Request));
    if pieces.iter().any(|p| p.is(Role::Not)) {
        return Mood::Negated;
    }
    let question = |p: &Piece| {
        p.is(Role::Question) && !p.is(Role::Relative) && !p.is(Role::Copula)
            || !polite && p.is(Role::RequestQuestion)
    };
    if place(&question).is_some() {
        return Mood::Question;
    }
    let noun = |pair: &[Piece]| match pair {
        [before, word] => before.is(Role::Article) && is_verb(word) && !word.is_thing(),
        _ => false,
    };
    if pieces.windows(2).any(noun) {
        return Mood::Told;
    }
    let you = |p: &Piece| temporal && p.is(Role::You);
    if told_of(place(&|p| p.is(Role::Own))) {
        return Mood::Own;
    }
    let subject = place(&|p| p.is(Role::Subject) && !you(p));
    if told_of(subject) && request.is_none_or(|r| subject.is_some_and(|s| s < r && r - s > 1)) {
        return Mood::Told;
    }
    if told_of(place(&|p| p.is(Role::Copula))) {
        return Mood::Told;
    }
    let form = place(&|p| p.forms().next().is_some());
    if form.is_some() && action.is_none() && request.is_none() && !temporal {
        return Mood::Told;
    }
    Mood::Command
}

/// What a question whether something can be done would be as a command: its bytes in the text.
pub(super) fn request(pieces: &[Piece], table: &Table) -> Option<std::ops::Range<usize>> {
    let begins = pieces.iter().position(|p| !is_empty(p))?;
    let (first, rest) = pieces.get(begins..)?.split_first()?;
    let rest = rest.get(rest.iter().position(|p| !is_empty(p))?..)?;
    let asked = first.is(Role::RequestQuestion) && rest.first().is_some_and(is_verb);
    let (begin, end) = (rest.first()?, rest.last()?);
    let commands = clauses(rest, table).iter().all(|c| c.mood == Mood::Command);
    (asked && commands).then_some(begin.span.start..end.span.end)
}
