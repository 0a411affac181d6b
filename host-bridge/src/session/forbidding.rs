//! What a person forbids, takes back or corrects while something waits or is being done.

use deictic_core::category::{Category, CategorySet};
use deictic_core::large::{Intent, Sentence, Word};
use deictic_core::protocol::message::Withheld;
use deictic_core::sentence::{LANGUAGE, SentenceError};

use super::{Happening, PATIENCE, Session};
use crate::clock;
use crate::language::Command;
use crate::unit::UnitError;

impl Session<'_> {
    /// Takes it that what was said forbids, asks or tells something, or was not understood: what waits at the unit is dropped, an
    /// open question with it, and what is shown within the pairing window is not done. What the unit decides before it has
    /// confirmed this is overruled. What the robot is doing goes on.
    ///
    /// # Errors
    /// [`UnitError`] when the unit is not there; it is told when it comes back within the window.
    pub fn forbid(&mut self) -> Result<(), UnitError> {
        self.question = None;
        self.spoken.clear();
        self.forbidden = Some(clock::now() + self.window());
        self.tell_forbidden()
    }

    /// As [`Session::forbid`]; and the robot stops at once, and what was queued is dropped.
    ///
    /// # Errors
    /// As [`Session::forbid`]; the robot has stopped all the same.
    pub fn refuse(&mut self) -> Result<(), UnitError> {
        self.halt();
        self.forbid()
    }

    pub(super) fn tell_forbidden(&mut self) -> Result<(), UnitError> {
        self.unit.forbid(LANGUAGE)?;
        self.forbidding = self.forbidding.saturating_add(1);
        self.due = Some(clock::now() + PATIENCE);
        Ok(())
    }

    /// The unit has come back: it does not know what was forbidden before.
    pub(super) fn forbid_again(&mut self) {
        if self.forbids() {
            // A unit that cannot be told is lost again, and decides nothing.
            let _ = self.tell_forbidden();
        }
    }

    /// The unit does not decide on this, as it was forbidden.
    pub(super) fn withheld(&mut self, withheld: Withheld) {
        if withheld.confirms {
            self.forbidding = self.forbidding.saturating_sub(1);
        } else {
            let gone = |s: &Sentence| has(withheld.modalities, s.modality());
            self.spoken.retain(|sentence| !gone(sentence));
        }
        if self.spoken.is_empty() && self.forbidding == 0 && !self.stopping {
            self.due = None;
        }
        if withheld.modalities != 0 {
            let modalities = withheld.modalities;
            self.happened.push(Happening::Withheld { modalities });
        }
    }

    /// Whether what is shown now is not done, as it belongs to something that was forbidden.
    #[must_use]
    pub fn forbids(&self) -> bool {
        self.forbidden.is_some_and(|until| clock::now() < until)
    }

    /// What waits for a decision or is being done, with the words of a correction in place of its own; `None` when there
    /// is nothing to be corrected.
    ///
    /// # Errors
    /// [`SentenceError`] for more words than a sentence has.
    pub fn corrected(&self, by: &Command) -> Result<Option<Sentence>, SentenceError> {
        let waiting = self.spoken.iter().filter(|_| self.due.is_some());
        let waiting = waiting.max_by_key(|sentence| sentence.modality() == LANGUAGE);
        let doing = self.doing.as_ref().and_then(|d| d.source.as_ref());
        let meant = match (waiting, doing) {
            (Some(sentence), _) => sentence.words().to_vec(),
            (None, Some(source)) => self.words_of(&source.intent)?,
            (None, None) => return Ok(None),
        };
        let said = by.sentence.words();
        let named = |c: Category| said.iter().any(|w| is_of(w, c)) || by.pointed.contains(&c);
        let takes = by.best(Category::ACTION).map(|action| {
            let actions = self.lexicon.vocabulary().actions();
            let signature = actions.get(usize::from(action)).map(|a| a.signature);
            signature.map_or(CategorySet::EMPTY, |s| s.compulsory.union(s.voluntary))
        });
        let kept = meant.iter().filter(|word| {
            word.category()
                .is_some_and(|c| !named(c) && takes.is_none_or(|takes| takes.contains(c.index())))
        });
        let mut corrected = Sentence::new(LANGUAGE);
        for word in kept.chain(said.iter().filter(|word| word.is_present())) {
            corrected.push(word.clone())?;
        }
        Ok(Some(corrected))
    }

    /// An intent as words that are certain.
    fn words_of(&self, intent: &Intent) -> Result<Vec<Word>, SentenceError> {
        let one = |category: Category, option: u8| {
            let mut likelihoods = vec![0.0; self.lexicon.entries(category).len()];
            if let Some(own) = likelihoods.get_mut(usize::from(option)) {
                *own = 1.0;
            }
            Word::certain(category, &likelihoods)
        };
        let mut words = vec![one(Category::ACTION, intent.action)?];
        for parameter in &intent.parameters {
            let word = one(parameter.category, parameter.option)?;
            words.push(match parameter.quantity {
                Some(quantity) => word.with_quantity(quantity),
                None => word,
            });
        }
        Ok(words)
    }
}

fn is_of(word: &Word, category: Category) -> bool {
    word.is_present() && word.category() == Some(category)
}

/// Whether a modality is in a set of them, one bit each.
fn has(modalities: u8, modality: u8) -> bool {
    modalities & 1_u8.checked_shl(u32::from(modality)).unwrap_or(0) != 0
}
