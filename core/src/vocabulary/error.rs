//! Why a vocabulary cannot be.

use serde::{Deserialize, Serialize};

use crate::category::Category;

/// Why a vocabulary was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum VocabularyError {
    /// No action at all.
    NoActions,
    /// More actions than this build holds.
    TooManyActions {
        /// How many it holds.
        capacity: u8,
    },
    /// More categories than this build holds, or than the 32 there can be.
    TooManyCategories {
        /// How many it holds.
        capacity: u8,
    },
    /// A category has more options than this build holds.
    TooManyOptions {
        /// The category.
        category: Category,
        /// How many options it holds.
        capacity: u8,
    },
    /// More features than this build holds, or than the 32 there can be.
    TooManyFeatures {
        /// How many it holds.
        capacity: u8,
    },
    /// A signature names a category that the vocabulary does not have, or the action category,
    /// which every action has without saying.
    UnknownCategory {
        /// The action whose signature it is.
        action: u8,
    },
    /// A category is both compulsory and voluntary.
    Contradiction {
        /// The action whose signature or requirement it is.
        action: u8,
    },
    /// A requirement names a feature that the vocabulary does not have.
    UnknownFeature {
        /// The action whose requirement it is.
        action: u8,
    },
    /// The stop action does not exist or takes compulsory parameters.
    BadStop,
}
