//! A change of the scene as one line of JSON, from a camera or any other program.
//!
//! ```text
//! {"change": {"object": "can", "position": [0.4, 0.1, 0.06], "features": {"full-liquid": 0.3}}}
//! {"remove": {"object": "cup"}}
//! {"things": [{"object": "can", "position": [0.4, 0.1, 0.06], "features": {"pickable": true}}]}
//! "show"
//! ```
//!
//! `change` keeps what it does not name and puts a thing on the table that was not there; `things` is the
//! whole table. Every line is done wholly or not at all.

use std::collections::BTreeMap;

use deictic_core::category::Category;
use deictic_core::large;
use serde::{Deserialize, Serialize};

use super::error::SceneProblem as Problem;
use super::{Likelihood, Tabletop};
use crate::vocabulary::Lexicon;

/// The longest line that is read, in bytes: a full table with every feature is a third of it.
pub const LONGEST: usize = 16_384;

/// What a line says.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum SceneLine {
    /// The whole table.
    Things(Vec<Thing>),
    /// A thing is otherwise than it was, or new.
    Change(Thing),
    /// A thing is gone.
    Remove(Thing),
    /// What is on the table is asked for; nothing changes.
    Show,
}

/// A thing on the table; it has a name as an object or as a storage.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Thing {
    /// Its name, when it is an object.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub object: Option<String>,
    /// Its name, when it is a storage.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub storage: Option<String>,
    /// Metres in the robot's base frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<[f32; 3]>,
    /// Likelihoods in 0..=1 by the names of features.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub features: BTreeMap<String, Likelihood>,
}

impl SceneLine {
    /// Reads a line.
    ///
    /// # Errors
    /// [`Problem`] with what was wrong.
    pub fn parse(line: &[u8]) -> Result<Self, Problem> {
        if line.len() > LONGEST {
            return Err(Problem::LongLine(line.len()));
        }
        serde_json::from_slice(line).map_err(|e| Problem::Line(e.to_string()))
    }

    /// Whether a line that a person may have typed is one.
    #[must_use]
    pub fn is_meant(line: &[u8]) -> bool {
        line.trim_ascii_start().first() == Some(&b'{')
    }

    /// The things on the table after it; `None` when nothing changes.
    ///
    /// # Errors
    /// [`Problem`] with what was wrong; the table is not touched.
    pub fn things(
        &self,
        table: &Tabletop,
        lexicon: &Lexicon,
    ) -> Result<Option<Vec<large::Entity>>, Problem> {
        let mut things = table.scene().entities().to_vec();
        match self {
            Self::Show => return Ok(None),
            Self::Things(all) => {
                things.clear();
                for thing in all {
                    let entity = thing.onto(None, lexicon)?;
                    if place(&things, &entity).is_some() {
                        return Err(Problem::Twice(thing.name().to_owned()));
                    }
                    things.push(entity);
                }
            }
            Self::Change(thing) => {
                let (category, option) = thing.option(lexicon)?;
                let old = table.find(category, option);
                let entity = thing.onto(old, lexicon)?;
                match place(&things, &entity).and_then(|at| things.get_mut(at)) {
                    Some(old) => *old = entity,
                    None => things.push(entity),
                }
            }
            Self::Remove(thing) => {
                let (category, option) = thing.option(lexicon)?;
                if table.find(category, option).is_none() {
                    return Err(Problem::NotThere(thing.name().to_owned()));
                }
                things.retain(|e| (e.category, e.option) != (category, option));
            }
        }
        Ok(Some(things))
    }
}

/// Where among `things` the one is that `entity` speaks of.
fn place(things: &[large::Entity], entity: &large::Entity) -> Option<usize> {
    let same = |e: &large::Entity| (e.category, e.option) == (entity.category, entity.option);
    things.iter().position(same)
}

impl Thing {
    /// The thing as it is on the table.
    #[must_use]
    pub fn of(entity: &large::Entity, lexicon: &Lexicon) -> Self {
        let name = lexicon.option_name(entity.category, entity.option);
        let (object, storage) = if entity.category == Category::OBJECT {
            (Some(name), None)
        } else {
            (None, Some(name))
        };
        let features = lexicon.features().iter().zip(&entity.features);
        let named = features.filter(|(_, likelihood)| **likelihood > 0.0);
        Self {
            object,
            storage,
            position: Some(entity.position),
            features: named
                .map(|(name, likelihood)| (name.clone(), Likelihood::Some(*likelihood)))
                .collect(),
        }
    }

    fn name(&self) -> &str {
        let name = self.object.as_ref().or(self.storage.as_ref());
        name.map_or("", String::as_str)
    }

    fn option(&self, lexicon: &Lexicon) -> Result<(Category, u8), Problem> {
        let (category, called, name) = match (&self.object, &self.storage) {
            (Some(name), None) => (Category::OBJECT, "object", name),
            (None, Some(name)) => (Category::STORAGE, "storage", name),
            _ => return Err(Problem::Nameless),
        };
        let option = lexicon.option(category, name);
        let known = || lexicon.entries(category).iter().map(|e| e.name.clone());
        option
            .map(|option| (category, option))
            .ok_or_else(|| Problem::UnknownThing {
                category: called,
                name: name.clone(),
                known: known().collect(),
            })
    }

    /// The thing with what is said of it, and for the rest as it was.
    fn onto(
        &self,
        old: Option<&large::Entity>,
        lexicon: &Lexicon,
    ) -> Result<large::Entity, Problem> {
        let (category, option) = self.option(lexicon)?;
        let position = self.position.or(old.map(|e| e.position));
        let position = position.ok_or_else(|| Problem::NoPosition(self.name().to_owned()))?;
        let mut features = old.map(|e| e.features.clone()).unwrap_or_default();
        // A lexicon has no more features than the core holds.
        let _ = features.resize(lexicon.features().len(), 0.0);
        for (name, likelihood) in &self.features {
            let value = likelihood.value().map_err(Problem::BadLikelihood)?;
            let at = lexicon.feature(name);
            let at = at.ok_or_else(|| Problem::UnknownFeature {
                name: name.clone(),
                known: lexicon.features().to_vec(),
            })?;
            if let Some(f) = features.get_mut(at) {
                *f = value;
            }
        }
        Ok(large::Entity {
            category,
            option,
            position,
            features,
        })
    }
}
