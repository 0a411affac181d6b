//! The vocabulary file as written: TOML tables with the place of everything that can be wrong.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use toml::Spanned;

/// A name with its place in the file.
pub type Name = Spanned<String>;

/// A vocabulary file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    pub name: String,
    pub language: Option<Name>,
    #[serde(default)]
    pub features: Vec<Name>,
    pub stop: Option<Name>,
    #[serde(default)]
    pub fillers: Vec<String>,
    #[serde(default)]
    pub action: Vec<Action>,
    #[serde(default)]
    pub object: Vec<Spanned<Choice>>,
    #[serde(default)]
    pub storage: Vec<Spanned<Choice>>,
    #[serde(default)]
    pub parameter: Vec<Parameter>,
    #[serde(default)]
    pub similarity: Similarity,
}

/// `[[action]]`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Action {
    pub name: Name,
    #[serde(default)]
    pub words: Vec<Name>,
    #[serde(default)]
    pub gestures: Vec<Name>,
    pub motion: Option<Name>,
    #[serde(default)]
    pub compulsory: Vec<Name>,
    #[serde(default)]
    pub voluntary: Vec<Name>,
    #[serde(default)]
    pub object: Vec<Name>,
    #[serde(default)]
    pub storage: Vec<Name>,
}

/// `[[object]]`, `[[storage]]` or an option of a `[[parameter]]`: a name alone or a table.
#[derive(Debug)]
pub struct Choice {
    pub name: String,
    /// Where the name is, if it is not all there is.
    pub place: Option<Range<usize>>,
    pub words: Vec<Name>,
    pub gestures: Vec<Name>,
}

/// `[[parameter]]`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    pub category: Name,
    #[serde(default)]
    pub options: Vec<Spanned<Choice>>,
}

/// `[similarity]`: per modality, per category.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Similarity {
    #[serde(default)]
    pub gesture: BTreeMap<String, Spanned<Table>>,
    #[serde(default)]
    pub language: BTreeMap<String, Spanned<Table>>,
}

/// How alike a sensor finds the options of a category.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub enum Table {
    /// 1 for the option itself, this for all others.
    Others(f32),
    /// A row per true option.
    Rows(Vec<Vec<f32>>),
}

impl<'de> Deserialize<'de> for Choice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Full {
            name: Name,
            #[serde(default)]
            words: Vec<Name>,
            #[serde(default)]
            gestures: Vec<Name>,
        }

        struct NameOrTable;
        impl<'de> Visitor<'de> for NameOrTable {
            type Value = Choice;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a name, or a table with `name`, `words` and `gestures`")
            }

            fn visit_str<E: Error>(self, name: &str) -> Result<Choice, E> {
                Ok(Choice {
                    name: name.to_owned(),
                    place: None,
                    words: Vec::new(),
                    gestures: Vec::new(),
                })
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Choice, A::Error> {
                let full = Full::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Choice {
                    place: Some(full.name.span()),
                    name: full.name.into_inner(),
                    words: full.words,
                    gestures: full.gestures,
                })
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}
