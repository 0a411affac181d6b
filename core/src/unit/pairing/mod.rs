//! Bringing sentences of different modalities together by time, and deciding when they are complete
//! or their window closes.

mod deciding;
mod forbidding;
mod hearing;

use super::loading::in_order;
use crate::category::Category;
use crate::decide::Kind;
use crate::joint::posterior::Triple;
use crate::observations::Observations;
use crate::protocol::message::{Fault, SentencePart};
use crate::sentence::Sentence;
use crate::time::Micros;
use forbidding::Forbidden;

/// How long a decision waits for a hand that is in the middle of a sentence, from the first sentence
/// of another modality on. People point for seconds, and say what they point at in the middle of it.
pub const HAND_PATIENCE: Micros = Micros::from_millis(10_000);

/// How often it looks whether the hand has finished.
const LOOKING: Micros = Micros::from_millis(100);

/// How long a question stays open.
pub const QUESTION: Micros = Micros::from_millis(60_000);

/// Where a sentence comes from that is to be looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::unit) enum Source {
    /// The host said it.
    Host,
    /// The hand reader read it.
    Hand,
}

/// A question that is open.
#[derive(Clone, Copy, Debug)]
struct Open {
    /// The number of the decision that asked.
    number: u32,
    /// Until when its answer is taken.
    until: Micros,
    kind: Kind,
    category: Category,
    /// The intent that a yes or no speaks of.
    about: Option<Triple>,
}

/// Sentences that wait for others, or for an answer.
#[derive(Debug)]
pub struct Pairing<const N: usize, const C: usize, const W: usize> {
    observations: Observations<W, C, N>,
    /// The sentence that is arriving, and which decision's question it answers.
    arriving: Sentence<W, C, N>,
    answers: Option<u32>,
    /// Whether all of it has arrived and nobody has looked at it yet.
    complete: bool,
    due: Micros,
    /// Until when a hand that is in the middle of a sentence is waited for.
    patience: Micros,
    question: Option<Open>,
    forbidden: Forbidden,
    numbered: u32,
}

impl<const N: usize, const C: usize, const W: usize> Default for Pairing<N, C, W> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize, const C: usize, const W: usize> Pairing<N, C, W> {
    /// Nothing waits.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            observations: Observations::new(),
            arriving: Sentence::new(0),
            answers: None,
            complete: false,
            due: Micros::NEVER,
            patience: Micros(0),
            question: None,
            forbidden: Forbidden::NOTHING,
            numbered: 0,
        }
    }

    /// As new, in place.
    pub fn restart(&mut self) {
        self.forget();
        self.arriving.restart(0);
        self.answers = None;
        self.complete = false;
        self.numbered = 0;
    }

    /// Forgets what waits; decisions keep being numbered on.
    pub fn clear(&mut self) {
        self.observations.clear();
        self.due = Micros::NEVER;
        self.patience = Micros(0);
        self.question = None;
    }

    /// Forgets what waits and what is forbidden.
    pub fn forget(&mut self) {
        self.clear();
        self.forbidden = Forbidden::NOTHING;
    }

    /// When what waits is to be decided with what there is.
    #[must_use]
    pub fn due(&self) -> Micros {
        self.due
    }

    /// Whether that moment has come.
    #[must_use]
    pub fn is_due(&self, now: Micros) -> bool {
        now >= self.due
    }

    /// Takes a part of a sentence, the last of which completes it.
    ///
    /// # Errors
    /// [`Fault`] when the part is out of order or there is no room; from the first part on the
    /// sentence can be said again.
    pub(in crate::unit) fn take(&mut self, part: &SentencePart<C, N>) -> Result<(), Fault> {
        let modality = part.modality;
        if part.first == 0 {
            self.arriving.restart(modality);
            self.answers = part.answers;
        }
        if modality != self.arriving.modality() || part.answers != self.answers {
            return Err(Fault::PartOutOfOrder {
                expected: 0,
                got: part.first,
            });
        }
        in_order(self.arriving.words().len(), part.first)?;
        for word in &part.words {
            let pushed = self.arriving.push(word.clone());
            pushed.map_err(|error| Fault::Sentence { modality, error })?;
        }
        self.complete = self.arriving.words().len() >= usize::from(part.total);
        Ok(())
    }
}
