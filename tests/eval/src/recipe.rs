//! How scenes are made up for a catalogue.

/// How often things have a feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chance {
    /// How often a thing that happens to be there has it.
    pub probability: f64,
    /// The feature of which it is another name.
    pub same_as: Option<usize>,
    /// Whether it is given to everything but what is meant, unless the action asks for such a
    /// thing.
    pub spoils: bool,
}

/// What a scene consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipe {
    /// How many things of each category stand in a scene.
    pub things: [usize; crate::record::CATEGORIES],
    /// One per feature of the catalogue.
    pub chances: Vec<Chance>,
}
