//! One sample of a data set: a scene, what both modalities said of it, and what was meant. Options
//! are numbers into a [`crate::catalogue::Catalogue`].

/// Categories that the data sets know: action, object, storage.
pub const CATEGORIES: usize = 3;

/// Modalities that the data sets know: gesture and language, as in [`deictic_core::sentence`].
pub const MODALITIES: usize = 2;

/// How far a feature holds, in both forms that the data sets give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feature {
    /// How likely it holds, in 0..=1.
    pub likelihood: f32,
    /// Whether it holds; what the reference reads.
    pub holds: bool,
}

impl Feature {
    /// A feature that surely holds or does not.
    #[must_use]
    pub fn sure(holds: bool) -> Self {
        Self {
            likelihood: f32::from(u8::from(holds)),
            holds,
        }
    }
}

/// An object or a storage in the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// Which object or storage of the catalogue.
    pub option: u8,
    /// Which of the catalogue's types; the first where a file lists several, as the reference reads
    /// it.
    pub kind: Option<u8>,
    /// One per feature of the catalogue.
    pub features: Vec<Feature>,
}

/// What is meant, done or decided: an action and what it is done to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Triple {
    /// Which action.
    pub action: u8,
    /// Which object, where the action has one.
    pub object: Option<u8>,
    /// Which storage, where the action has one.
    pub storage: Option<u8>,
}

impl Triple {
    /// Its three options, action first.
    #[must_use]
    pub fn options(&self) -> [Option<u8>; CATEGORIES] {
        [Some(self.action), self.object, self.storage]
    }
}

/// The words of one modality: per category one likelihood per option of the catalogue, or nothing
/// when the word is absent.
pub type Words = [Option<Vec<f32>>; CATEGORIES];

/// One sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// The objects on the table. Their order means nothing.
    pub objects: Vec<Thing>,
    /// The storages on the table. Their order means nothing.
    pub storages: Vec<Thing>,
    /// What was shown and what was said: see [`deictic_core::sentence::GESTURE`] and
    /// [`deictic_core::sentence::LANGUAGE`].
    pub words: [Words; MODALITIES],
    /// What was meant.
    pub truth: Triple,
}

impl Record {
    /// The things of a category: objects for 1, storages for 2, none for the action's 0.
    #[must_use]
    pub fn things(&self, category: usize) -> &[Thing] {
        match category {
            1 => &self.objects,
            2 => &self.storages,
            _ => &[],
        }
    }

    /// Whether any modality has a word of this category.
    #[must_use]
    pub fn mentions(&self, category: usize) -> bool {
        self.words
            .iter()
            .any(|words| words.get(category).is_some_and(Option::is_some))
    }
}
