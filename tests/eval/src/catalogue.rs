//! What a vocabulary's numbers mean: the names of actions, objects, storages and features, what
//! every action needs, and how easily every modality mistakes one option for another.

use deictic_core::board;
use deictic_core::category::Category;
use deictic_core::joint::fit::product;
use deictic_core::vocabulary::{Action, Requirement, Signature};
use thiserror::Error;

use crate::order::Order;
use crate::recipe::Recipe;
use crate::record::{CATEGORIES, MODALITIES, Record, Thing};

mod json;
mod toml;

/// How alike options look or sound: row = what is meant, column = what is observed, in 0..=1.
pub type Table = Vec<Vec<f32>>;

/// A vocabulary with its names. Types of things (container, ...) follow the features as further
/// features, of which at most one holds.
#[derive(Clone, Debug)]
pub struct Catalogue {
    /// Names of actions, objects and storages.
    pub names: [Vec<String>; CATEGORIES],
    /// Names of the features proper.
    pub features: Vec<String>,
    /// Names of the types.
    pub types: Vec<String>,
    /// What every action takes and needs.
    pub actions: Vec<Action>,
    /// Similarity by modality and category; the level of an observed word without noise.
    pub similarity: [[Table; CATEGORIES]; MODALITIES],
}

/// Why a catalogue was refused.
#[derive(Debug, Error)]
pub enum CatalogueError {
    /// The file cannot be read.
    #[error("{file}: {cause}")]
    Read {
        /// Its path.
        file: String,
        /// The system's reason.
        cause: std::io::Error,
    },
    /// The file is not in the format that its name says.
    #[error("{file}: {reason}")]
    Format {
        /// Its path.
        file: String,
        /// The parser's reason, with the line.
        reason: String,
    },
    /// The file contradicts itself or exceeds what the core is built for.
    #[error("{file}: {reason}")]
    Content {
        /// Its path.
        file: String,
        /// What is wrong.
        reason: String,
    },
}

impl Catalogue {
    /// Reads the `vocab.json` that lies beside the reference's data sets.
    ///
    /// # Errors
    /// [`CatalogueError`] naming the file and what is wrong in it.
    pub fn read_json(path: &std::path::Path) -> Result<Self, CatalogueError> {
        json::read(path)
    }

    /// Reads a vocabulary in TOML, and how scenes are made up for it.
    ///
    /// # Errors
    /// [`CatalogueError`] naming the file and what is wrong in it.
    pub fn read_toml(path: &std::path::Path) -> Result<(Self, Recipe), CatalogueError> {
        toml::read(path)
    }

    /// The vocabulary of the paper's simulated experiments, which comes with this crate.
    ///
    /// # Panics
    /// Never: a test reads it.
    #[must_use]
    pub fn papers() -> (Self, Recipe) {
        let text = include_str!("../vocabularies/paper.toml");
        toml::parse(text, "vocabularies/paper.toml").expect("the committed vocabulary is sound")
    }

    /// How many options a category has.
    #[must_use]
    pub fn count(&self, category: usize) -> usize {
        self.names.get(category).map_or(0, Vec::len)
    }

    /// Whether the action takes something of this category.
    #[must_use]
    pub fn takes(&self, action: usize, category: usize) -> bool {
        category == 0
            || self
                .actions
                .get(action)
                .is_some_and(|a| a.signature.compulsory.contains(category))
    }

    /// Whether a thing has all that an action needs of its object or storage, its features taken as
    /// holding or not.
    #[must_use]
    pub fn meets(&self, action: usize, category: usize, thing: &Thing) -> bool {
        let Some(action) = self.actions.get(action) else {
            return false;
        };
        let Requirement { wanted, unwanted } = match category {
            1 => action.object,
            2 => action.storage,
            _ => return false,
        };
        let holds = |k: usize| match k.checked_sub(self.features.len()) {
            None => thing.features.get(k).is_some_and(|f| f.holds),
            Some(kind) => thing.kind.is_some_and(|t| usize::from(t) == kind),
        };
        wanted.iter().all(holds) && !unwanted.iter().any(holds)
    }

    /// How likely a thing meets an action's requirement of its category: the product of its features'
    /// likelihoods; 0 where there is no such requirement.
    #[must_use]
    pub fn likelihood(&self, action: usize, category: usize, thing: &Thing) -> f64 {
        let Some(action) = self.actions.get(action) else {
            return 0.0;
        };
        let requirement = match category {
            1 => action.object,
            2 => action.storage,
            _ => return 0.0,
        };
        let features = thing.features.iter().map(|f| f.likelihood);
        let kinds = (0_u8..).take(self.types.len());
        let kinds = kinds.map(|t| f32::from(u8::from(thing.kind == Some(t))));
        let likelihoods: Vec<f32> = features.chain(kinds).collect();
        f64::from(product(requirement, &likelihoods))
    }

    /// Whether the scene has all that an action needs.
    #[must_use]
    pub fn possible(&self, action: usize, record: &Record) -> bool {
        (1..CATEGORIES)
            .filter(|&c| self.takes(action, c))
            .all(|c| record.things(c).iter().any(|t| self.meets(action, c, t)))
    }

    /// The core's vocabulary with options in the given order.
    ///
    /// # Panics
    /// Never for a catalogue that was read, as reading checks the capacities.
    #[must_use]
    pub fn vocabulary(&self, order: &Order) -> board::Vocabulary {
        let actions: Vec<Action> = order
            .places(0)
            .iter()
            .map(|&a| self.actions[usize::from(a)])
            .collect();
        self.build(&actions)
            .expect("capacities were checked when the catalogue was read")
    }

    fn build(
        &self,
        actions: &[Action],
    ) -> Result<board::Vocabulary, deictic_core::vocabulary::VocabularyError> {
        let small = |n: usize| u8::try_from(n).unwrap_or(u8::MAX);
        board::Vocabulary::new(
            actions,
            &[small(self.count(1)), small(self.count(2))],
            small(self.features.len() + self.types.len()),
            None,
            0,
        )
    }

    /// Finds what contradicts itself or does not fit.
    fn check(self, file: &str) -> Result<Self, CatalogueError> {
        let refuse = |reason: String| {
            Err(CatalogueError::Content {
                file: file.to_owned(),
                reason,
            })
        };
        if let Err(error) = self.build(&self.actions) {
            return refuse(format!("the core refuses it: {error:?}"));
        }
        for (m, tables) in self.similarity.iter().enumerate() {
            for (c, table) in tables.iter().enumerate() {
                let n = self.count(c);
                let sound =
                    |row: &Vec<f32>| row.len() == n && row.iter().all(|x| (0.0..=1.0).contains(x));
                if table.len() != n || !table.iter().all(sound) {
                    return refuse(format!(
                        "the similarity table of {} in {} is not {n} rows of {n} numbers in 0..=1",
                        CATEGORY_NAMES[c], MODALITY_NAMES[m]
                    ));
                }
            }
        }
        Ok(self)
    }
}

/// What the categories are called in files.
pub const CATEGORY_NAMES: [&str; CATEGORIES] = ["action", "object", "storage"];

/// What the modalities are called in files.
pub const MODALITY_NAMES: [&str; MODALITIES] = ["gesture", "language"];

/// An action as files describe it, with features by name.
struct NamedAction<'a> {
    name: &'a str,
    takes: &'a [String],
    object: NamedRequirement<'a>,
    storage: NamedRequirement<'a>,
}

/// What is needed of a thing, by name.
#[derive(Clone, Copy, Default)]
struct NamedRequirement<'a> {
    wanted: &'a [String],
    unwanted: &'a [String],
    kind: Option<&'a str>,
}

/// Turns names into bits.
fn resolve(
    named: &NamedAction<'_>,
    features: &[String],
    types: &[String],
) -> Result<Action, String> {
    let place = |name: &str| {
        features
            .iter()
            .position(|f| f == name)
            .ok_or_else(|| format!("action `{}` needs the unknown feature `{name}`", named.name))
    };
    let requirement = |r: NamedRequirement<'_>| -> Result<Requirement, String> {
        let mut out = Requirement::default();
        for name in r.wanted {
            out.wanted = out.wanted.with(place(name)?);
        }
        for name in r.unwanted {
            out.unwanted = out.unwanted.with(place(name)?);
        }
        if let Some(kind) = r.kind {
            let at = types.iter().position(|t| t == kind).ok_or_else(|| {
                format!("action `{}` needs the unknown type `{kind}`", named.name)
            })?;
            out.wanted = out.wanted.with(features.len() + at);
        }
        Ok(out)
    };
    let mut compulsory = Vec::new();
    for name in named.takes {
        match name.as_str() {
            "action" => {}
            "object" => compulsory.push(Category::OBJECT),
            "storage" => compulsory.push(Category::STORAGE),
            other => {
                return Err(format!(
                    "action `{}` takes `{other}`; the data sets know object and storage",
                    named.name
                ));
            }
        }
    }
    Ok(Action {
        signature: Signature {
            compulsory: compulsory.into_iter().collect(),
            ..Signature::default()
        },
        object: requirement(named.object)?,
        storage: requirement(named.storage)?,
    })
}
