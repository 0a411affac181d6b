//! The scene file as written, and what it says in a vocabulary's terms.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use deictic_core::category::Category;
use deictic_core::large;
use deictic_core::scene::SceneError;
use serde::{Deserialize, Serialize};
use toml::Spanned;

use super::error::SceneProblem as Problem;
use super::sensor::Sensor;
use super::{Measures, TABLE, Tabletop};
use crate::diagnose::FileError;
use crate::vocabulary::Lexicon;

/// A [`Problem`] with its place in a scene file.
pub type SceneFileError = FileError<Problem>;

type Found<T> = Result<T, (Option<Range<usize>>, Problem)>;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    vocabulary: Option<Spanned<PathBuf>>,
    sensor: Option<Spanned<Sensor>>,
    #[serde(default)]
    object: Vec<Spanned<Thing>>,
    #[serde(default)]
    storage: Vec<Spanned<Thing>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Thing {
    name: Spanned<String>,
    position: [f32; 3],
    #[serde(default)]
    features: BTreeMap<Spanned<String>, Spanned<Likelihood>>,
    mass: Option<f32>,
    holds: Option<f32>,
    liquid: Option<f32>,
}

impl Thing {
    fn measures(&self) -> Measures {
        Measures {
            mass: self.mass,
            holds: self.holds,
            liquid: self.liquid,
        }
    }
}

/// How likely a feature is, as people write it.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
#[serde(
    untagged,
    expecting = "a feature's likelihood is a number from 0 to 1, or true or false"
)]
pub enum Likelihood {
    /// `true` or `false`.
    Certain(bool),
    /// A number in 0..=1.
    Some(f32),
}

impl Likelihood {
    /// The number.
    ///
    /// # Errors
    /// The number itself when it is not in 0..=1.
    pub fn value(self) -> Result<f32, f32> {
        match self {
            Self::Certain(true) => Ok(1.0),
            Self::Certain(false) => Ok(0.0),
            Self::Some(x) if (0.0..=1.0).contains(&x) => Ok(x),
            Self::Some(x) => Err(x),
        }
    }
}

/// A scene file that was read but not yet compared with a vocabulary, as it may name the vocabulary
/// it is to be read with.
#[derive(Debug)]
pub struct SceneFile {
    name: String,
    text: String,
    written: Written,
}

impl SceneFile {
    /// Reads a scene file.
    ///
    /// # Errors
    /// [`SceneFileError`] when it cannot be read or is not of a scene's shape.
    pub fn read(path: &Path) -> Result<Self, SceneFileError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|e| FileError::new(&name, "", None, Problem::Unreadable(e)))?;
        Self::parse(&name, &text)
    }

    /// The scene that comes with the program.
    ///
    /// # Errors
    /// As [`SceneFile::parse`]; a test holds that there is none.
    pub fn table() -> Result<Self, SceneFileError> {
        Self::parse("table.toml", TABLE)
    }

    /// A scene file called `name` with this `text`.
    ///
    /// # Errors
    /// [`SceneFileError`] when it is not of a scene's shape.
    pub fn parse(name: &str, text: &str) -> Result<Self, SceneFileError> {
        let written = toml::from_str(text).map_err(|e| {
            FileError::new(
                name,
                text,
                e.span(),
                Problem::Syntax(e.message().to_owned()),
            )
        })?;
        Ok(Self {
            name: name.to_owned(),
            text: text.to_owned(),
            written,
        })
    }

    /// The vocabulary file it names, relative to itself.
    #[must_use]
    pub fn vocabulary(&self) -> Option<PathBuf> {
        let named = self.written.vocabulary.as_ref()?.as_ref();
        Some(match Path::new(&self.name).parent() {
            Some(folder) => folder.join(named),
            None => named.clone(),
        })
    }

    /// That the vocabulary file it names is not there, for this reason, at the line that names it.
    #[must_use]
    pub fn without_vocabulary(&self, why: String) -> SceneFileError {
        let place = self.written.vocabulary.as_ref().map(Spanned::span);
        let path = self.vocabulary().unwrap_or_default();
        FileError::new(
            &self.name,
            &self.text,
            place,
            Problem::NoVocabulary { path, why },
        )
    }

    /// The things it describes, in a vocabulary's terms.
    ///
    /// # Errors
    /// [`SceneFileError`] with the place of the first thing that is wrong.
    pub fn things(&self, lexicon: &Lexicon) -> Result<Vec<large::Entity>, SceneFileError> {
        let mut checked = large::Scene::new(1);
        let lists = [
            (Category::OBJECT, "object", &self.written.object),
            (Category::STORAGE, "storage", &self.written.storage),
        ];
        for (category, called, things) in lists {
            for thing in things {
                entity(category, called, thing.as_ref(), lexicon)
                    .and_then(|e| {
                        let pushed = checked.push(e, lexicon.vocabulary());
                        pushed.map_err(|e| (Some(place_of(&e, thing)), refused(e, thing)))
                    })
                    .map_err(|(place, problem)| {
                        FileError::new(&self.name, &self.text, place, problem)
                    })?;
            }
        }
        Ok(checked.entities().to_vec())
    }

    /// What the things it describes weigh and hold; a thing that is object and storage alike has what either says.
    fn measures(&self) -> Result<BTreeMap<String, Measures>, SceneFileError> {
        let mut all = BTreeMap::<String, Measures>::new();
        for thing in self.written.object.iter().chain(&self.written.storage) {
            let Measures {
                mass,
                holds,
                liquid,
            } = thing.as_ref().measures();
            let known = all.entry(thing.as_ref().name.as_ref().clone()).or_default();
            *known = Measures {
                mass: mass.or(known.mass),
                holds: holds.or(known.holds),
                liquid: liquid.or(known.liquid),
            };
            known.check().map_err(|(measure, value)| {
                let problem = Problem::BadMeasure { measure, value };
                FileError::new(&self.name, &self.text, Some(thing.span()), problem)
            })?;
        }
        all.retain(|_, measures| *measures != Measures::default());
        Ok(all)
    }

    /// The table it describes.
    ///
    /// # Errors
    /// [`SceneFileError`] with the place of the first thing that is wrong.
    pub fn tabletop(&self, lexicon: &Lexicon) -> Result<Tabletop, SceneFileError> {
        let table = Tabletop::new(self.things(lexicon)?, lexicon)
            .map_err(|e| FileError::new(&self.name, &self.text, None, Problem::Refused(e)))?
            .with_measures(self.measures()?);
        Ok(match &self.written.sensor {
            None => table,
            Some(sensor) => table.with_hand(sensor.as_ref().settings().map_err(|problem| {
                FileError::new(&self.name, &self.text, Some(sensor.span()), problem)
            })?),
        })
    }
}

fn place_of(error: &SceneError, thing: &Spanned<Thing>) -> Range<usize> {
    match error {
        SceneError::BadPosition { .. } => thing.span(),
        _ => thing.as_ref().name.span(),
    }
}

/// What the core refused, by name where a name says it.
fn refused(error: SceneError, thing: &Spanned<Thing>) -> Problem {
    match error {
        SceneError::Duplicate { .. } => Problem::Twice(thing.as_ref().name.as_ref().clone()),
        _ => Problem::Refused(error),
    }
}

fn entity(
    category: Category,
    called: &'static str,
    thing: &Thing,
    lexicon: &Lexicon,
) -> Found<large::Entity> {
    let name = thing.name.as_ref();
    let Some(option) = lexicon.option(category, name) else {
        let problem = Problem::UnknownThing {
            category: called,
            name: name.clone(),
            known: lexicon
                .entries(category)
                .iter()
                .map(|e| e.name.clone())
                .collect(),
        };
        return Err((Some(thing.name.span()), problem));
    };
    let mut features = heapless::Vec::new();
    // A lexicon has no more features than the core holds.
    let _ = features.resize(lexicon.features().len(), 0.0);
    for (feature, likelihood) in &thing.features {
        let Some(at) = lexicon.feature(feature.as_ref()) else {
            let problem = Problem::UnknownFeature {
                name: feature.as_ref().clone(),
                known: lexicon.features().to_vec(),
            };
            return Err((Some(feature.span()), problem));
        };
        let value = likelihood.as_ref().value();
        let value = value.map_err(|x| (Some(likelihood.span()), Problem::BadLikelihood(x)))?;
        if let Some(f) = features.get_mut(at) {
            *f = value;
        }
    }
    Ok(large::Entity {
        category,
        option,
        position: thing.position,
        features,
    })
}
