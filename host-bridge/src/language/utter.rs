//! A draft to a sentence of the core: likelihoods, category probabilities and quantities.

use deictic_core::category::Category;
use deictic_core::large::{OPTIONS, Sentence, Word};
use deictic_core::sentence::LANGUAGE;

use super::draft::{Draft, Slot};
use super::error::LanguageError;
use super::guess::Guesser;
use crate::vocabulary::Lexicon;

/// How a heard word becomes likelihoods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Uncertainty {
    /// Every option by how alike its words sound and look to what was heard.
    Likeness {
        /// The likeness is multiplied by itself so many times; the larger, the surer. At 4 "cup"
        /// leaves "cube" a third.
        sharpness: u8,
    },
    /// How likely what was heard is when an option is said, beside the one that is said most likely: for
    /// the joint model, which takes figures for likelihoods.
    Likelihood {
        /// The likeness, beside the largest, is multiplied by itself so many times.
        sharpness: u8,
    },
    /// The options that were named have 1, all others the same constant, 0..=1 (the paper, One-hot
    /// encoding).
    OneHot {
        /// That of the others.
        others: f32,
    },
}

impl Uncertainty {
    /// Likelihoods of which "cup", whose likeness to "cube" is 0.75, leaves "cube" one in 1000.
    pub const LIKELIHOOD: Self = Self::Likelihood { sharpness: 24 };
}

impl Default for Uncertainty {
    fn default() -> Self {
        Self::Likeness { sharpness: 4 }
    }
}

/// The largest [`Uncertainty::Likelihood`] of an option beside one that was named to the letter: "into"
/// is 0.875 like "onto" and had 0.04 of it, so that the joint model asked about either.
const EXACT: f32 = 0.001;

/// Makes sentences.
#[derive(Clone, Copy, Debug)]
pub struct Utterer<'a> {
    /// The names.
    pub lexicon: &'a Lexicon,
    /// What sounds like what.
    pub guesser: &'a Guesser,
    /// How sure a word is.
    pub uncertainty: Uncertainty,
}

impl Utterer<'_> {
    /// The sentence of a draft: its words in the order of the categories, empty ones for what the
    /// hand shows.
    ///
    /// # Errors
    /// [`LanguageError::Sentence`] for more words than a sentence holds.
    pub fn sentence(&self, draft: &Draft) -> Result<Sentence, LanguageError> {
        let mut sentence = Sentence::new(LANGUAGE);
        let slots = [&draft.action, &draft.target, &draft.storage]
            .into_iter()
            .flatten();
        for slot in slots.chain(&draft.others) {
            sentence.push(self.word(slot)?)?;
        }
        Ok(sentence)
    }

    fn word(&self, slot: &Slot) -> Result<Word, LanguageError> {
        let options = self.lexicon.vocabulary().options_of(slot.category);
        if slot.is_pointed() || options == 0 {
            return Ok(Word::ABSENT);
        }
        let mut likelihoods = [0.0; OPTIONS];
        let places = likelihoods.get_mut(..options).unwrap_or_default();
        if slot.heard.is_empty() {
            // A quantity leaves open which of the options it is.
            places.fill(1.0);
        }
        for heard in &slot.heard {
            let alike = self
                .guesser
                .likenesses(&heard.words, slot.category, options);
            let most = alike.iter().copied().fold(0.0, f64::max);
            for (option, (place, alike)) in places.iter_mut().zip(alike).enumerate() {
                let named = heard.options.iter().any(|&o| usize::from(o) == option);
                *place = f32::max(*place, self.likelihood(alike, most, named));
            }
        }
        let mut categories = [0.0; Category::LIMIT];
        let mut set = |category: Category, p: f32| {
            if let Some(place) = categories.get_mut(category.index()) {
                *place = p;
            }
            category.index() + 1
        };
        let mut used = set(slot.category, slot.belief);
        if let Some(other) = slot.instead {
            used = used.max(set(other, 1.0 - slot.belief));
        }
        let word = Word::new(
            categories.get(..used).unwrap_or_default(),
            likelihoods.get(..options).unwrap_or_default(),
        )?;
        Ok(match slot.quantity {
            Some(quantity) => word.with_quantity(quantity),
            None => word,
        })
    }

    fn likelihood(&self, alike: f64, most: f64, named: bool) -> f32 {
        match self.uncertainty {
            Uncertainty::OneHot { others } => {
                if named {
                    1.0
                } else {
                    others
                }
            }
            Uncertainty::Likelihood { sharpness } if most > 0.0 => {
                let likelihood = (alike / most).powi(i32::from(sharpness.max(1))) as f32;
                // What is a word of the vocabulary to the letter was hardly a misspelt other one.
                if most >= 1.0 && alike < 1.0 {
                    likelihood.min(EXACT)
                } else {
                    likelihood
                }
            }
            Uncertainty::Likelihood { .. } => 0.0,
            Uncertainty::Likeness { sharpness } => {
                let likelihood = alike.powi(i32::from(sharpness.max(1))) as f32;
                // Two names can look alike to the last letter only if they are one word's options.
                if named && alike >= 1.0 {
                    1.0
                } else {
                    likelihood.min(0.999)
                }
            }
        }
    }
}
