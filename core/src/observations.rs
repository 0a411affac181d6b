//! What all modalities observed: at most one checked sentence of each.

use core::borrow::Borrow;

use heapless::Vec;

use crate::clarify::{Confirmation, QUESTIONS};
use crate::math::clamp_unit;
use crate::sentence::{ANSWER, MODALITIES, Sentence, SentenceError};
use crate::vocabulary::Vocabulary;

/// At most one checked sentence per modality: all that one decision draws on.
#[derive(Clone, Debug, PartialEq)]
pub struct Observations<const W: usize, const C: usize, const N: usize> {
    sentences: [Sentence<W, C, N>; MODALITIES],
    /// The modalities that are there, one bit each.
    there: u8,
    /// What was said to yes-or-no questions.
    confirmations: Vec<Confirmation, QUESTIONS>,
    /// How many questions were answered.
    answers: u8,
}

impl<const W: usize, const C: usize, const N: usize> Default for Observations<W, C, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const W: usize, const C: usize, const N: usize> Observations<W, C, N> {
    /// Nothing observed.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            sentences: [const { Sentence::new(0) }; MODALITIES],
            there: 0,
            confirmations: Vec::new(),
            answers: 0,
        }
    }

    /// Checks a sentence against the vocabulary it speaks of and adds it, in place of an earlier one
    /// of the same modality.
    ///
    /// # Errors
    /// [`SentenceError`]; nothing has changed then.
    pub fn insert<const F: usize>(
        &mut self,
        sentence: impl Borrow<Sentence<W, C, N>>,
        vocabulary: &Vocabulary<N, C, F>,
    ) -> Result<(), SentenceError> {
        let sentence = sentence.borrow();
        sentence.check(vocabulary)?;
        let place = self.place(sentence.modality())?;
        place.restart(sentence.modality());
        sentence
            .words()
            .iter()
            .try_for_each(|word| place.push(word.clone()))?;
        self.there |= bit(sentence.modality());
        Ok(())
    }

    /// Adds an answer's words to those of earlier answers ([`ANSWER`]), whichever modality it is of.
    ///
    /// # Errors
    /// [`SentenceError`]; the words before the one that did not fit have been added.
    pub fn answer<const F: usize>(
        &mut self,
        sentence: &Sentence<W, C, N>,
        vocabulary: &Vocabulary<N, C, F>,
    ) -> Result<(), SentenceError> {
        sentence.check(vocabulary)?;
        let there = self.there & bit(ANSWER) != 0;
        let place = self.place(ANSWER)?;
        if !there {
            place.restart(ANSWER);
        }
        sentence
            .words()
            .iter()
            .try_for_each(|word| place.push(word.clone()))?;
        self.there |= bit(ANSWER);
        self.answers = self.answers.saturating_add(1);
        Ok(())
    }

    /// Adds what was said to a yes-or-no question; likelihoods that are no numbers count as 0. What is
    /// beyond [`QUESTIONS`] is left out.
    pub fn confirm(&mut self, confirmation: Confirmation) {
        let likelihoods = confirmation.likelihoods.map(clamp_unit);
        // No more are asked than there is room for.
        let _ = self.confirmations.push(Confirmation {
            likelihoods,
            ..confirmation
        });
        self.answers = self.answers.saturating_add(1);
    }

    /// What was said to yes-or-no questions.
    #[must_use]
    pub fn confirmations(&self) -> &[Confirmation] {
        &self.confirmations
    }

    /// How many questions were answered.
    #[must_use]
    pub fn answers(&self) -> u8 {
        self.answers
    }

    fn place(&mut self, modality: u8) -> Result<&mut Sentence<W, C, N>, SentenceError> {
        let place = self.sentences.get_mut(usize::from(modality));
        place.ok_or(SentenceError::UnknownModality {
            capacity: MODALITIES as u8,
        })
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.sentences
            .iter_mut()
            .for_each(|sentence| sentence.restart(0));
        self.there = 0;
        self.confirmations.clear();
        self.answers = 0;
    }

    /// The modalities that are there, one bit each.
    #[must_use]
    pub fn modalities(&self) -> u8 {
        self.there
    }

    /// The sentence of this modality, if there is one.
    #[must_use]
    pub fn get(&self, modality: u8) -> Option<&Sentence<W, C, N>> {
        let sentence = self.sentences.get(usize::from(modality));
        sentence.filter(|_| self.there & bit(modality) != 0)
    }

    /// The sentences, by modality.
    pub fn iter(&self) -> impl Iterator<Item = &Sentence<W, C, N>> {
        (0..MODALITIES as u8).filter_map(|modality| self.get(modality))
    }
}

/// The bit of a modality in a set of them.
fn bit(modality: u8) -> u8 {
    1_u8.checked_shl(u32::from(modality)).unwrap_or(0)
}
