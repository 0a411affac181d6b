//! Why a sentence cannot be.

use serde::{Deserialize, Serialize};

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
