//! What one modality observed: the ordered words of a sentence, each a likelihood per option and a
//! probability over categories (the paper, Problem formulation: observations from modalities).

mod error;
mod word;

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::vocabulary::Vocabulary;

pub use error::SentenceError;
pub use word::{ABSENT_BELOW, Word};

/// How many modalities one decision can draw on.
pub const MODALITIES: usize = 4;

/// What a hand showed.
pub const GESTURE: u8 = 0;
/// What was said or typed.
pub const LANGUAGE: u8 = 1;
/// What was answered to questions: fused with what they were asked about.
pub const ANSWER: u8 = 3;

/// The words of one modality. `W` words, `C` categories, `N` options at most.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sentence<const W: usize, const C: usize, const N: usize> {
    modality: u8,
    words: Vec<Word<C, N>, W>,
}

impl<const W: usize, const C: usize, const N: usize> Sentence<W, C, N> {
    /// An empty sentence of modality `modality`, counted from 0.
    #[must_use]
    pub const fn new(modality: u8) -> Self {
        Self {
            modality,
            words: Vec::new(),
        }
    }

    /// Appends a word.
    ///
    /// # Errors
    /// [`SentenceError::TooManyWords`]; the sentence is then as it was.
    pub fn push(&mut self, word: Word<C, N>) -> Result<(), SentenceError> {
        self.words
            .push(word)
            .map_err(|_| SentenceError::TooManyWords {
                capacity: u8::try_from(W).unwrap_or(u8::MAX),
            })
    }

    /// Forgets the words, to be filled anew by `modality`, in place.
    pub fn restart(&mut self, modality: u8) {
        self.modality = modality;
        self.words.clear();
    }

    /// Which modality observed it.
    #[must_use]
    pub fn modality(&self) -> u8 {
        self.modality
    }

    /// Its words, in the order in which they were observed.
    #[must_use]
    pub fn words(&self) -> &[Word<C, N>] {
        &self.words
    }

    /// Checks what may have come over a wire against the vocabulary it speaks of.
    ///
    /// # Errors
    /// The first [`SentenceError`] found, with the word's place.
    pub fn check<const F: usize>(
        &self,
        vocabulary: &Vocabulary<N, C, F>,
    ) -> Result<(), SentenceError> {
        for (i, word) in self.words.iter().enumerate() {
            word.check(u8::try_from(i).unwrap_or(u8::MAX), vocabulary)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::category::Category;
    use crate::vocabulary::Action;

    type W = Word<4, 4>;

    fn check(word: W) -> Result<(), SentenceError> {
        let v: Vocabulary<4, 4, 4> =
            Vocabulary::new(&[Action::default(); 3], &[2, 0, 1], 0, None, 0).unwrap();
        let mut s = Sentence::<2, 4, 4>::new(0);
        s.push(Word::ABSENT).unwrap();
        s.push(word).unwrap();
        s.check(&v)
    }

    #[test]
    fn good_words_pass() {
        assert_eq!(
            check(W::certain(Category::ACTION, &[0.1, 1.0, 0.0]).unwrap()),
            Ok(())
        );
        assert_eq!(check(W::new(&[0.2, 0.8], &[0.1, 1.0]).unwrap()), Ok(()));
        let five_cm = W::certain(Category::DISTANCE, &[1.0])
            .unwrap()
            .with_quantity(0.05);
        assert_eq!(check(five_cm), Ok(()));
    }

    #[test]
    fn bad_words_are_refused_with_their_place() {
        for x in [f32::NAN, f32::INFINITY, -0.5, 1.5] {
            let bad = W::certain(Category::OBJECT, &[0.1, x]).unwrap();
            assert_eq!(check(bad), Err(SentenceError::BadLikelihood { word: 1 }));
            let bad = W::new(&[x, 0.4], &[0.1, 0.2]).unwrap();
            assert_eq!(check(bad), Err(SentenceError::BadLikelihood { word: 1 }));
        }
        assert_eq!(
            check(W::new(&[0.6, 0.8], &[0.1, 0.2]).unwrap()),
            Err(SentenceError::BadCategories { word: 1 })
        );
        assert_eq!(
            check(W::certain(Category::STORAGE, &[0.1]).unwrap()),
            Err(SentenceError::UnknownCategory { word: 1 })
        );
        assert_eq!(
            check(W::certain(Category::OBJECT, &[0.1]).unwrap()),
            Err(SentenceError::WrongOptionCount {
                word: 1,
                options: 2
            })
        );
        let bad = W::certain(Category::DISTANCE, &[1.0])
            .unwrap()
            .with_quantity(f32::NAN);
        assert_eq!(check(bad), Err(SentenceError::BadQuantity { word: 1 }));
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        assert_eq!(
            W::certain(Category::ACTION, &[0.0; 5]),
            Err(SentenceError::TooLong { capacity: 4 })
        );
        assert_eq!(
            W::certain(Category::ANGLE, &[0.0]),
            Err(SentenceError::TooLong { capacity: 4 })
        );
        let mut s = Sentence::<1, 4, 4>::new(0);
        s.push(Word::ABSENT).unwrap();
        assert_eq!(
            s.push(Word::ABSENT),
            Err(SentenceError::TooManyWords { capacity: 1 })
        );
    }

    #[test]
    fn a_word_of_tiny_likelihoods_is_absent() {
        assert!(
            !W::certain(Category::OBJECT, &[9e-4, 0.0])
                .unwrap()
                .is_present()
        );
        assert!(
            W::certain(Category::OBJECT, &[1e-3, 0.0])
                .unwrap()
                .is_present()
        );
        assert!(!W::ABSENT.is_present());
    }
}
