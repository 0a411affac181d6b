//! What one modality observed: the ordered words of a sentence, each a likelihood per option and a
//! probability over categories (the paper, Problem formulation: observations from modalities).

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::category::Category;
use crate::vocabulary::Vocabulary;

/// Below this the likelihoods of a word say nothing, and the word counts as absent (METHOD, section
/// 2).
pub const ABSENT_BELOW: f32 = 1e-3;

/// One slot of a sentence. `C` categories, `N` options at most.
///
/// A word without likelihoods is *absent*: the modality had nothing to say there.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Word<const C: usize, const N: usize> {
    categories: Vec<f32, C>,
    likelihoods: Vec<f32, N>,
    quantity: Option<f32>,
}

/// Why a word or sentence was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SentenceError {
    /// More words than this build holds.
    TooManyWords {
        /// How many it holds.
        capacity: u8,
    },
    /// More likelihoods or categories in a word than this build holds.
    TooLong {
        /// How many it holds.
        capacity: u8,
    },
    /// A likelihood or category probability outside 0..=1, or not a number.
    BadLikelihood {
        /// The word's place in the sentence.
        word: u8,
    },
    /// The category probabilities sum to more than 1.
    BadCategories {
        /// The word's place in the sentence.
        word: u8,
    },
    /// A category that the vocabulary does not have.
    UnknownCategory {
        /// The word's place in the sentence.
        word: u8,
    },
    /// Not one likelihood per option of the word's category.
    WrongOptionCount {
        /// The word's place in the sentence.
        word: u8,
        /// How many options its category has.
        options: u8,
    },
    /// A quantity that is not finite.
    BadQuantity {
        /// The word's place in the sentence.
        word: u8,
    },
    /// A modality number at or above what this build holds.
    UnknownModality {
        /// How many it holds.
        capacity: u8,
    },
}

impl<const C: usize, const N: usize> Word<C, N> {
    /// A word with nothing in it.
    pub const ABSENT: Self = Self {
        categories: Vec::new(),
        likelihoods: Vec::new(),
        quantity: None,
    };

    /// A word that certainly belongs to `category`.
    ///
    /// # Errors
    /// [`SentenceError::TooLong`] when the capacities do not hold it.
    pub fn certain(category: Category, likelihoods: &[f32]) -> Result<Self, SentenceError> {
        let mut categories = [0.0; Category::LIMIT];
        if let Some(p) = categories.get_mut(category.index()) {
            *p = 1.0;
        }
        let used = categories.get(..=category.index()).unwrap_or(&[]);
        Self::new(used, likelihoods)
    }

    /// A word of uncertain category: `categories[q]` is p(C(w) = C^q), categories beyond the end
    /// have probability 0. The likelihoods are those of the most probable category's options.
    ///
    /// # Errors
    /// [`SentenceError::TooLong`] when the capacities do not hold it.
    pub fn new(categories: &[f32], likelihoods: &[f32]) -> Result<Self, SentenceError> {
        let too_long = |capacity| SentenceError::TooLong {
            capacity: u8::try_from(capacity).unwrap_or(u8::MAX),
        };
        Ok(Self {
            categories: Vec::from_slice(categories).map_err(|_| too_long(C))?,
            likelihoods: Vec::from_slice(likelihoods).map_err(|_| too_long(N))?,
            quantity: None,
        })
    }

    /// The same word with a quantity: metres, radians or a number, by its category.
    #[must_use]
    pub fn with_quantity(mut self, quantity: f32) -> Self {
        self.quantity = Some(quantity);
        self
    }

    /// The most probable category, whose options the likelihoods are; `None` when absent.
    #[must_use]
    pub fn category(&self) -> Option<Category> {
        self.likeliest().and_then(|(q, _)| Category::from_index(q))
    }

    /// The most probable category's index, and its probability.
    pub(crate) fn likeliest(&self) -> Option<(usize, f32)> {
        let q = crate::math::argmax(&self.categories)?;
        Some((q, self.categories.get(q).copied()?))
    }

    /// p(C(w) = C^q), for every category from the action on; those beyond the end are 0.
    #[must_use]
    pub fn categories(&self) -> &[f32] {
        &self.categories
    }

    /// One likelihood per option of [`Word::category`].
    #[must_use]
    pub fn likelihoods(&self) -> &[f32] {
        &self.likelihoods
    }

    /// The quantity it carries: metres, radians or a number, by its category.
    #[must_use]
    pub fn quantity(&self) -> Option<f32> {
        self.quantity
    }

    /// Whether it says anything.
    #[must_use]
    pub fn is_present(&self) -> bool {
        self.likelihoods.iter().any(|&w| w >= ABSENT_BELOW)
    }

    fn check<const F: usize>(
        &self,
        word: u8,
        vocabulary: &Vocabulary<N, C, F>,
    ) -> Result<(), SentenceError> {
        if self.likelihoods.is_empty() {
            return Ok(());
        }
        let unit = 0.0..=1.0;
        let mut sum = 0.0;
        for p in &self.categories {
            if !unit.contains(p) {
                return Err(SentenceError::BadLikelihood { word });
            }
            sum += p;
        }
        // Probabilities that were rounded to f32 one by one may sum to a little more than 1.
        if sum > 1.0 + 1e-3 {
            return Err(SentenceError::BadCategories { word });
        }
        if !self.likelihoods.iter().all(|w| unit.contains(w)) {
            return Err(SentenceError::BadLikelihood { word });
        }
        let category = self
            .category()
            .ok_or(SentenceError::UnknownCategory { word })?;
        let options = vocabulary.options_of(category);
        if options == 0 {
            return Err(SentenceError::UnknownCategory { word });
        }
        if options != self.likelihoods.len() {
            let options = u8::try_from(options).unwrap_or(u8::MAX);
            return Err(SentenceError::WrongOptionCount { word, options });
        }
        match self.quantity {
            Some(q) if !q.is_finite() => Err(SentenceError::BadQuantity { word }),
            _ => Ok(()),
        }
    }
}

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

/// How many modalities one decision can draw on.
pub const MODALITIES: usize = 4;

/// What a hand showed.
pub const GESTURE: u8 = 0;
/// What was said or typed.
pub const LANGUAGE: u8 = 1;
/// What was answered to questions: fused with what they were asked about.
pub const ANSWER: u8 = 3;

#[cfg(test)]
mod tests {
    use super::*;
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
