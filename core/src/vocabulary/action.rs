//! What an action takes, and what it needs of the things it takes (the paper, Problem formulation).

use serde::{Deserialize, Serialize};

use crate::category::{Category, CategorySet, FeatureSet};

/// Which parameters an action takes, each category at most once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Signature {
    /// Without these the action cannot be done.
    pub compulsory: CategorySet,
    /// These may be given; giving or leaving them costs nothing.
    pub voluntary: CategorySet,
}

/// A conjunction of features that an action needs of an object or a storage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Requirement {
    /// Features it must have.
    pub wanted: FeatureSet,
    /// Features it must not have.
    pub unwanted: FeatureSet,
}

/// One action: its signature and what it needs of its object and storage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Action {
    /// The parameters it takes.
    pub signature: Signature,
    /// What the target object must be like; without effect when no object is compulsory.
    pub object: Requirement,
    /// What the storage must be like; without effect when no storage is compulsory.
    pub storage: Requirement,
}

impl Action {
    /// The requirement on the things of one entity category.
    #[must_use]
    pub fn requirement(&self, category: Category) -> Requirement {
        match category {
            Category::OBJECT => self.object,
            Category::STORAGE => self.storage,
            _ => Requirement::default(),
        }
    }
}
