//! One line of a data set, checked against the catalogue.

use deictic_core::board;
use serde::Deserialize;
use thiserror::Error;

use crate::catalogue::{CATEGORY_NAMES, Catalogue, MODALITY_NAMES};
use crate::record::{CATEGORIES, Feature, Record, Thing, Triple, Words};

/// What is wrong with a line.
#[derive(Debug, Error)]
pub enum Fault {
    /// It is not the JSON object that is expected; a line cut short is this too.
    #[error("not a sample: {0}")]
    Json(String),
    /// A number that is written as NaN or Infinity, which JSON does not have.
    #[error("a number is written as NaN or Infinity; likelihoods lie in 0..=1")]
    NotANumber,
    /// A likelihood outside 0..=1.
    #[error("{place} has {value}; likelihoods lie in 0..=1")]
    Range {
        /// Where.
        place: String,
        /// The number.
        value: f32,
    },
    /// A list of the wrong length.
    #[error("{place} has {found} entries instead of {wanted}")]
    Length {
        /// Where.
        place: String,
        /// How many there are.
        found: usize,
        /// How many there must be.
        wanted: usize,
    },
    /// A name that the vocabulary does not have.
    #[error("the {category} `{name}` is not in vocab.json")]
    Unknown {
        /// What it should have been: an action, an object, ...
        category: &'static str,
        /// The name.
        name: String,
    },
    /// The same object or storage stands twice in the scene.
    #[error("the {category} `{name}` stands twice in the scene")]
    Twice {
        /// Object or storage.
        category: &'static str,
        /// Its name.
        name: String,
    },
    /// More things than the core is built for.
    #[error("the scene has {found} things; the core is built for {capacity}")]
    Crowded {
        /// How many there are.
        found: usize,
        /// How many there can be.
        capacity: usize,
    },
    /// The truth lacks or has a parameter against its action's signature.
    #[error("the truth `{action}` and its {category} contradict the action's signature")]
    Signature {
        /// The action.
        action: String,
        /// Object or storage.
        category: &'static str,
    },
}

#[derive(Deserialize)]
struct Line {
    objects: Vec<Entry>,
    storages: Vec<Entry>,
    gesture: Sentence,
    language: Sentence,
    truth: Truth,
}

/// A thing: name, types, [likelihood, holds] per feature.
#[derive(Deserialize)]
struct Entry(String, Vec<String>, Vec<(f32, u8)>);

#[derive(Deserialize)]
struct Sentence {
    action: Vec<f32>,
    object: Vec<f32>,
    storage: Vec<f32>,
}

#[derive(Deserialize)]
struct Truth {
    action: String,
    object: Option<String>,
    storage: Option<String>,
}

pub(super) fn parse(text: &str, catalogue: &Catalogue) -> Result<Record, Fault> {
    let line: Line = serde_json::from_str(text).map_err(|error| {
        if text.contains("NaN") || text.contains("Infinity") {
            Fault::NotANumber
        } else {
            Fault::Json(error.to_string())
        }
    })?;
    let found = line.objects.len() + line.storages.len();
    if found > board::ENTITIES {
        return Err(Fault::Crowded {
            found,
            capacity: board::ENTITIES,
        });
    }
    let truth = Triple {
        action: option(catalogue, 0, &line.truth.action)?,
        object: named(catalogue, 1, line.truth.object.as_deref())?,
        storage: named(catalogue, 2, line.truth.storage.as_deref())?,
    };
    for (c, parameter) in truth.options().iter().enumerate().skip(1) {
        if parameter.is_some() != catalogue.takes(usize::from(truth.action), c) {
            return Err(Fault::Signature {
                action: line.truth.action,
                category: CATEGORY_NAMES[c],
            });
        }
    }
    Ok(Record {
        objects: things(line.objects, 1, catalogue)?,
        storages: things(line.storages, 2, catalogue)?,
        words: [
            words(line.gesture, 0, catalogue)?,
            words(line.language, 1, catalogue)?,
        ],
        truth,
    })
}

fn option(catalogue: &Catalogue, category: usize, name: &str) -> Result<u8, Fault> {
    place(&catalogue.names[category], CATEGORY_NAMES[category], name)
}

fn named(catalogue: &Catalogue, category: usize, name: Option<&str>) -> Result<Option<u8>, Fault> {
    name.map(|name| option(catalogue, category, name))
        .transpose()
}

fn place(names: &[String], category: &'static str, name: &str) -> Result<u8, Fault> {
    names
        .iter()
        .position(|known| known == name)
        .and_then(|at| u8::try_from(at).ok())
        .ok_or_else(|| Fault::Unknown {
            category,
            name: name.to_owned(),
        })
}

fn things(
    entries: Vec<Entry>,
    category: usize,
    catalogue: &Catalogue,
) -> Result<Vec<Thing>, Fault> {
    let mut things: Vec<Thing> = Vec::with_capacity(entries.len());
    for Entry(name, types, features) in entries {
        let option = option(catalogue, category, &name)?;
        if things.iter().any(|t| t.option == option) {
            return Err(Fault::Twice {
                category: CATEGORY_NAMES[category],
                name,
            });
        }
        if features.len() != catalogue.features.len() {
            return Err(Fault::Length {
                place: format!("`{name}`'s list of features"),
                found: features.len(),
                wanted: catalogue.features.len(),
            });
        }
        if let Some(&(value, _)) = features.iter().find(|(p, _)| !(0.0..=1.0).contains(p)) {
            return Err(Fault::Range {
                place: format!("a feature of `{name}`"),
                value,
            });
        }
        let mut kinds = Vec::with_capacity(types.len());
        for kind in &types {
            kinds.push(place(&catalogue.types, "type", kind)?);
        }
        things.push(Thing {
            option,
            kind: kinds.first().copied(),
            features: features
                .into_iter()
                .map(|(likelihood, holds)| Feature {
                    likelihood,
                    holds: holds != 0,
                })
                .collect(),
        });
    }
    Ok(things)
}

fn words(sentence: Sentence, modality: usize, catalogue: &Catalogue) -> Result<Words, Fault> {
    let mut words: Words = Default::default();
    let said: [Vec<f32>; CATEGORIES] = [sentence.action, sentence.object, sentence.storage];
    for (c, likelihoods) in said.into_iter().enumerate() {
        if likelihoods.is_empty() {
            continue;
        }
        let place = || format!("{}'s {} word", MODALITY_NAMES[modality], CATEGORY_NAMES[c]);
        if likelihoods.len() != catalogue.count(c) {
            return Err(Fault::Length {
                place: place(),
                found: likelihoods.len(),
                wanted: catalogue.count(c),
            });
        }
        if let Some(&value) = likelihoods.iter().find(|p| !(0.0..=1.0).contains(*p)) {
            return Err(Fault::Range {
                place: place(),
                value,
            });
        }
        words[c] = Some(likelihoods);
    }
    Ok(words)
}
