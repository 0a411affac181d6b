//! The words of an installation: names, what people say and show for them, and what every action
//! needs. The core knows numbers only; a [`Lexicon`] is the one place where names become numbers.

mod entries;
mod error;
mod file;
mod load;
mod said;
mod similarity;
mod written;

use std::ops::Range;

use deictic_core::category::Category;
use deictic_core::large;

pub use error::VocabularyProblem;
pub use load::VocabularyFileError;
pub use said::Said;
pub use similarity::SimilarityTables;

/// The vocabulary that comes with the program: the paper's nine actions on a tabletop.
pub const TABLETOP: &str = include_str!("../../data/tabletop.toml");

/// One option of a category: its name and what people say and show for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name in files and messages, for example `put-into`.
    pub name: String,
    /// What people say for it, besides its name.
    pub words: Vec<String>,
    /// What people show for it, besides its name.
    pub gestures: Vec<String>,
}

impl Entry {
    /// Everything people say for it: its name with spaces for hyphens, then its words, all in lower
    /// case.
    pub fn spoken(&self) -> impl Iterator<Item = String> + '_ {
        std::iter::once(self.name.replace(['-', '_'], " ").to_lowercase())
            .chain(self.words.iter().map(|word| word.to_lowercase()))
    }
}

/// The options of one category.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CategoryEntries {
    /// Which category.
    pub category: Category,
    /// Its name, for example `object`.
    pub name: String,
    /// Its options, in the order of a word's likelihoods; empty when the vocabulary does not have
    /// the category. One that carries a quantity only has a single option of the category's name.
    pub entries: Vec<Entry>,
    /// Whether it carries a quantity only.
    pub quantity_only: bool,
}

/// A checked vocabulary with its names. Names are unique within a category; the same name can stand
/// in several, as a thing can be an object and a storage.
#[derive(Clone, Debug, PartialEq)]
pub struct Lexicon {
    name: String,
    language: String,
    language_place: Option<Range<usize>>,
    vocabulary: large::Vocabulary,
    categories: Vec<CategoryEntries>,
    motions: Vec<String>,
    motion_places: Vec<Option<Range<usize>>>,
    said: Vec<Said>,
    features: Vec<String>,
    fillers: Vec<String>,
    similarity: SimilarityTables,
}

impl Lexicon {
    /// The vocabulary's own name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Which language pack's grammar words apply: one that is built in, for example `en`, or a pack's file.
    #[must_use]
    pub fn language(&self) -> &str {
        &self.language
    }

    /// Where in its file it names its language, in bytes.
    #[must_use]
    pub fn language_place(&self) -> Option<Range<usize>> {
        self.language_place.clone()
    }

    /// What the core makes of it.
    #[must_use]
    pub fn vocabulary(&self) -> &large::Vocabulary {
        &self.vocabulary
    }

    /// All categories up to the last one that the vocabulary has, actions first; `categories()[q]`
    /// is that of [`Category::index`] `q`.
    #[must_use]
    pub fn categories(&self) -> &[CategoryEntries] {
        &self.categories
    }

    /// The options of a category, in the order of a word's likelihoods; empty for one that the
    /// vocabulary does not have.
    #[must_use]
    pub fn entries(&self, category: Category) -> &[Entry] {
        self.categories
            .get(category.index())
            .map_or(&[], |c| &c.entries)
    }

    /// The category of this name, if the vocabulary has it.
    #[must_use]
    pub fn category(&self, name: &str) -> Option<Category> {
        self.categories
            .iter()
            .find(|c| c.name == name && !c.entries.is_empty())
            .map(|c| c.category)
    }

    /// The name of a category; "category 9" for one that the vocabulary does not have.
    #[must_use]
    pub fn category_name(&self, category: Category) -> String {
        match self.categories.get(category.index()) {
            Some(c) => c.name.clone(),
            None => format!("category {}", category.index()),
        }
    }

    /// The option of this name in a category.
    #[must_use]
    pub fn option(&self, category: Category, name: &str) -> Option<u8> {
        self.entries(category)
            .iter()
            .position(|e| e.name == name)
            .and_then(|i| u8::try_from(i).ok())
    }

    /// The name of an option; "object 9" for one that the vocabulary does not have.
    #[must_use]
    pub fn option_name(&self, category: Category, option: u8) -> String {
        match self.entries(category).get(usize::from(option)) {
            Some(entry) => entry.name.clone(),
            None => format!("{} {option}", self.category_name(category)),
        }
    }

    /// Whether a category carries a quantity only, as a distance in metres does.
    #[must_use]
    pub fn is_quantity_only(&self, category: Category) -> bool {
        self.categories
            .get(category.index())
            .is_some_and(|c| c.quantity_only)
    }

    /// Which motion of the robot an action stands for: its `motion` in the file, or its name.
    #[must_use]
    pub fn motion(&self, action: u8) -> Option<&str> {
        self.motions.get(usize::from(action)).map(String::as_str)
    }

    /// Where in its file an action names its motion, in bytes, if it does.
    #[must_use]
    pub fn motion_place(&self, action: u8) -> Option<Range<usize>> {
        self.motion_places.get(usize::from(action)).cloned()?
    }

    /// The names and words of actions, objects and storages with their places in the file.
    #[must_use]
    pub fn said(&self) -> &[Said] {
        &self.said
    }

    /// The names of the features, in the order of a thing's feature likelihoods.
    #[must_use]
    pub fn features(&self) -> &[String] {
        &self.features
    }

    /// The place of a feature among a thing's likelihoods.
    #[must_use]
    pub fn feature(&self, name: &str) -> Option<usize> {
        self.features.iter().position(|f| f == name)
    }

    /// Words that say nothing.
    #[must_use]
    pub fn fillers(&self) -> &[String] {
        &self.fillers
    }

    /// What sensors make of the true options.
    #[must_use]
    pub fn similarity(&self) -> &SimilarityTables {
        &self.similarity
    }
}
