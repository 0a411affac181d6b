//! What the person wants: an action with its parameters (the paper, Problem formulation: I = (ta,
//! to, ap)).

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::category::Category;

/// One parameter of an intent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Its category.
    pub category: Category,
    /// Which of the category's options.
    pub option: u8,
    /// The quantity that was said or shown, if any: metres, radians or a number.
    pub quantity: Option<f32>,
}

/// An action with at most one parameter of each category.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Intent<const C: usize> {
    /// Which action.
    pub action: u8,
    /// Its parameters, in the order of the categories.
    pub parameters: Vec<Parameter, C>,
}

impl<const C: usize> Intent<C> {
    /// The parameter of this category, if the intent has one.
    #[must_use]
    pub fn parameter(&self, category: Category) -> Option<&Parameter> {
        self.parameters.iter().find(|p| p.category == category)
    }

    /// The option chosen for this category, if the intent has one.
    #[must_use]
    pub fn option(&self, category: Category) -> Option<u8> {
        self.parameter(category).map(|p| p.option)
    }
}
