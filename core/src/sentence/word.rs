//! One slot of a sentence: a likelihood per option, and a probability over categories.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use super::SentenceError;
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

    pub(super) fn check<const F: usize>(
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
