//! Clauses to a queue of commands: corrections replace, prohibitions and questions set aside, "it"
//! finds what was spoken of, "before" and "after" put in order.

use super::clause::{Clause, Link, Mood};
use super::draft::{Draft, Slot};
use super::drafter::drafts;
use super::error::LanguageError;
use super::mood::request;
use super::read::{Piece, What};
use super::table::Table;
use crate::vocabulary::Lexicon;

/// Why a part of a text became no command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// It was forbidden.
    Negated,
    /// It was a question.
    Question,
    /// It depends on something that nobody checks.
    Conditional,
    /// It told something.
    Told,
    /// It told what who speaks means to do.
    Own,
    /// It is for another time, which nobody waits for.
    Timed,
    /// It was talk.
    Talk,
    /// It was replaced or withdrawn.
    Corrected,
}

/// A part of a text that became no command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SetAside {
    /// Why.
    pub why: Why,
    /// Its bytes in the text.
    pub span: std::ops::Range<usize>,
    /// Of a question whether something can be done, the bytes of what it would be: "can you pick the cup?".
    pub request: Option<std::ops::Range<usize>>,
}

/// A draft with its place in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// What to do.
    pub draft: Draft,
    /// Its bytes in the text.
    pub span: std::ops::Range<usize>,
    /// Whether it corrects something said in an earlier text.
    pub corrects: bool,
}

/// All that a text says.
#[derive(Debug, Default)]
pub struct Plan {
    /// What to do, in order.
    pub commands: Vec<Planned>,
    /// What is not done.
    pub aside: Vec<SetAside>,
}

struct Composer<'a> {
    table: &'a Table,
    lexicon: &'a Lexicon,
    plan: Plan,
    /// A correction was announced, and nothing has followed it yet.
    correcting: bool,
    /// The action of a prohibition, for "but the box".
    forbidden: Option<Draft>,
    /// The thing that was spoken of last, done or not.
    mentioned: Option<Slot>,
    /// A clause that was announced by a leading "before".
    later: Vec<Planned>,
}

/// The commands of these clauses.
///
/// # Errors
/// [`LanguageError`] for an unknown word, or one that has no place, in a clause that would be
/// executed.
pub fn compose(
    clauses: &[Clause],
    table: &Table,
    lexicon: &Lexicon,
) -> Result<Plan, LanguageError> {
    let mut composer = Composer {
        table,
        lexicon,
        plan: Plan::default(),
        correcting: false,
        forbidden: None,
        mentioned: None,
        later: Vec::new(),
    };
    for clause in clauses {
        composer.take(clause)?;
    }
    if composer.correcting {
        composer.withdraw(1);
    }
    composer.release();
    Ok(composer.plan)
}

fn span_of(pieces: &[Piece]) -> std::ops::Range<usize> {
    let start = pieces.first().map_or(0, |p| p.span.start);
    start..pieces.last().map_or(start, |p| p.span.end)
}

impl Composer<'_> {
    fn take(&mut self, clause: &Clause) -> Result<(), LanguageError> {
        let span = span_of(&clause.pieces);
        let why = match clause.mood {
            Mood::Command => return self.command(clause, span),
            Mood::Negated => Why::Negated,
            Mood::Question => Why::Question,
            Mood::Conditional => Why::Conditional,
            Mood::Told => Why::Told,
            Mood::Own => Why::Own,
            Mood::Timed => Why::Timed,
        };
        if why == Why::Negated {
            let says = |p: &Piece| p.is_name() || p.forms().next().is_some();
            if !clause.pieces.iter().any(says) && clause.link != Link::Start {
                self.withdraw(1);
            }
            // Whatever has no place in it does not matter, as it is not done.
            self.forbidden = drafts(&clause.pieces, true, self.table, self.lexicon)
                .ok()
                .and_then(|list| list.into_iter().next());
            if let Some(draft) = self.forbidden.clone() {
                self.topic(&draft);
                self.mention(&draft);
            }
        }
        let request = (why == Why::Question)
            .then(|| request(&clause.pieces, self.table))
            .flatten();
        self.plan.aside.push(SetAside { why, span, request });
        Ok(())
    }

    /// In "the cup, don't pick it" the cup is not for anything else.
    fn topic(&mut self, forbidden: &Draft) {
        let bare = |p: &Planned| p.draft.action.is_none();
        if forbidden.action.is_some() && self.plan.commands.last().is_some_and(bare) {
            self.withdraw(1);
        }
    }

    fn withdraw(&mut self, count: usize) {
        for _ in 0..count {
            if let Some(gone) = self.plan.commands.pop() {
                self.plan.aside.push(SetAside {
                    why: Why::Corrected,
                    span: gone.span,
                    request: None,
                });
            }
        }
        self.correcting = false;
    }

    fn command(
        &mut self,
        clause: &Clause,
        span: std::ops::Range<usize>,
    ) -> Result<(), LanguageError> {
        if clause.link == Link::Retract {
            let all = self.plan.commands.len();
            self.withdraw(all);
            self.later.clear();
            return Ok(());
        }
        let temporal = matches!(clause.link, Link::Later(_) | Link::Earlier(_));
        let list = drafts(&clause.pieces, temporal, self.table, self.lexicon)?;
        let says = list.iter().any(|d| !d.is_empty() || d.again);
        if let Some(unknown) = clause.pieces.iter().find(|p| p.what == What::Unknown) {
            let talk = |p: &Piece| p.is(super::pack::Role::Chatter);
            if says || !clause.pieces.iter().any(talk) {
                return Err(LanguageError::UnknownWord {
                    word: unknown.words.clone(),
                    at: unknown.span.start,
                    nearest: Vec::new(),
                });
            }
        }
        if !says {
            self.correcting |= clause.link == Link::Correct;
            if !clause.pieces.is_empty() {
                self.plan.aside.push(SetAside {
                    why: Why::Talk,
                    span,
                    request: None,
                });
            }
            return Ok(());
        }
        let corrects = std::mem::take(&mut self.correcting) || clause.link == Link::Correct;
        let list = list.into_iter().map(|draft| Planned {
            draft: self.resolve(draft),
            span: span.clone(),
            corrects,
        });
        let planned = list.collect();
        self.place(planned, clause.link);
        Ok(())
    }

    /// Finds what "it" is.
    fn resolve(&mut self, mut draft: Draft) -> Draft {
        if std::mem::take(&mut draft.again) && draft.target.is_none() {
            let wanted = draft.action.is_some();
            let known = self.mentioned.clone();
            draft.target = known.or_else(|| wanted.then(Draft::shown));
        }
        self.mention(&draft);
        draft
    }

    fn mention(&mut self, draft: &Draft) {
        let named = draft.target.as_ref().filter(|t| !t.is_pointed());
        self.mentioned = named.cloned().or_else(|| self.mentioned.take());
    }

    fn place(&mut self, mut planned: Vec<Planned>, link: Link) {
        let fragment = planned.first().is_some_and(|p| p.draft.action.is_none());
        let corrects = planned.first().is_some_and(|p| p.corrects);
        if (corrects || link == Link::But)
            && planned.len() == 1
            && let Some(new) = planned.first()
        {
            if let (true, Some(last)) = (
                link == Link::But && fragment,
                self.forbidden.take().filter(|d| d.action.is_some()),
            ) {
                let mut merged = last;
                merged.amend(&new.draft);
                let new = Planned {
                    draft: merged,
                    corrects: false,
                    ..new.clone()
                };
                self.plan.commands.push(new);
                return;
            }
            if (corrects || fragment)
                && let Some(last) = self.plan.commands.last_mut()
            {
                self.plan.aside.push(SetAside {
                    why: Why::Corrected,
                    span: last.span.clone(),
                    request: None,
                });
                last.draft.amend(&new.draft);
                last.draft.prune(self.lexicon);
                last.span.end = new.span.end;
                return;
            }
        }
        if link == Link::Or
            && !fragment
            && let (Some(new), Some(last)) = (planned.first(), self.plan.commands.last_mut())
        {
            last.draft.or(&new.draft);
            last.span.end = new.span.end;
            return;
        }
        match link {
            Link::Later(true) => {
                self.later = planned;
                return;
            }
            Link::Earlier(false) => {
                let at = self.plan.commands.len().saturating_sub(1);
                self.plan.commands.splice(at..at, planned);
                return;
            }
            _ => {}
        }
        if fragment {
            self.complete(&mut planned, link);
        }
        self.plan.commands.append(&mut planned);
        self.release();
    }

    /// "Then the box" does with the box what was done last.
    fn complete(&self, planned: &mut [Planned], link: Link) {
        let last = self.plan.commands.last();
        if let Some(last) = last.filter(|_| matches!(link, Link::Then | Link::And | Link::Or)) {
            for p in planned {
                let mut draft = last.draft.clone();
                draft.amend(&p.draft);
                p.draft = draft;
            }
        }
    }

    fn release(&mut self) {
        self.plan.commands.append(&mut self.later);
    }
}
