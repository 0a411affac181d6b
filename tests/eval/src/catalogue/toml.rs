//! Vocabularies in TOML; `vocabularies/paper.toml` shows all there is.

use std::fs;
use std::path::Path;

use serde::Deserialize;

use super::{CATEGORY_NAMES, Catalogue, CatalogueError, NamedAction, NamedRequirement, resolve};
use crate::recipe::{Chance, Recipe};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct File {
    objects: Vec<String>,
    storages: Vec<String>,
    #[serde(default)]
    types: Vec<String>,
    scene: Scene,
    feature: Vec<Feature>,
    action: Vec<Action>,
    gesture: Tables,
    language: Tables,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Scene {
    objects: usize,
    storages: usize,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Feature {
    name: String,
    chance: Option<f64>,
    same_as: Option<String>,
    #[serde(default)]
    spoils: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Action {
    name: String,
    #[serde(default)]
    compulsory: Vec<String>,
    #[serde(default)]
    object: Vec<String>,
    #[serde(default)]
    storage: Vec<String>,
    storage_type: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Tables {
    action: Table,
    object: Table,
    storage: Table,
}

/// Rows of likelihoods, or one number for everything but what is meant.
#[derive(Deserialize)]
#[serde(untagged)]
enum Table {
    Others(f32),
    Rows(Vec<Vec<f32>>),
}

impl Table {
    fn rows(self, n: usize) -> super::Table {
        match self {
            Self::Rows(rows) => rows,
            Self::Others(others) => (0..n)
                .map(|i| (0..n).map(|j| if i == j { 1.0 } else { others }).collect())
                .collect(),
        }
    }
}

pub(super) fn read(path: &Path) -> Result<(Catalogue, Recipe), CatalogueError> {
    let file = path.display().to_string();
    let text = fs::read_to_string(path).map_err(|cause| CatalogueError::Read {
        file: file.clone(),
        cause,
    })?;
    parse(&text, &file)
}

pub(super) fn parse(text: &str, file: &str) -> Result<(Catalogue, Recipe), CatalogueError> {
    let raw: File = toml::from_str(text).map_err(|error| CatalogueError::Format {
        file: file.to_owned(),
        reason: error.to_string(),
    })?;
    let refuse = |reason| CatalogueError::Content {
        file: file.to_owned(),
        reason,
    };
    let features: Vec<String> = raw.feature.iter().map(|f| f.name.clone()).collect();
    let mut actions = Vec::new();
    for action in &raw.action {
        let split = |list: &[String]| {
            let (unwanted, wanted): (Vec<&String>, Vec<&String>) =
                list.iter().partition(|name| name.starts_with('!'));
            (
                wanted.into_iter().cloned().collect::<Vec<_>>(),
                unwanted
                    .into_iter()
                    .map(|name| name.trim_start_matches('!').to_owned())
                    .collect::<Vec<_>>(),
            )
        };
        let (object, storage) = (split(&action.object), split(&action.storage));
        let named = NamedAction {
            name: &action.name,
            takes: &action.compulsory,
            object: NamedRequirement {
                wanted: &object.0,
                unwanted: &object.1,
                kind: None,
            },
            storage: NamedRequirement {
                wanted: &storage.0,
                unwanted: &storage.1,
                kind: action.storage_type.as_deref(),
            },
        };
        actions.push(resolve(&named, &features, &raw.types).map_err(refuse)?);
    }
    let things = [0, raw.scene.objects, raw.scene.storages];
    let recipe = Recipe {
        things,
        chances: chances(&raw.feature).map_err(refuse)?,
    };
    let names = [
        raw.action.into_iter().map(|a| a.name).collect::<Vec<_>>(),
        raw.objects,
        raw.storages,
    ];
    for (c, &wanted) in things.iter().enumerate() {
        if wanted > names[c].len() {
            return Err(refuse(format!(
                "a scene of {wanted} {}s needs at least as many names",
                CATEGORY_NAMES[c]
            )));
        }
    }
    let similarity = [raw.gesture, raw.language].map(|tables| {
        [
            tables.action.rows(names[0].len()),
            tables.object.rows(names[1].len()),
            tables.storage.rows(names[2].len()),
        ]
    });
    let catalogue = Catalogue {
        names,
        features,
        types: raw.types,
        actions,
        similarity,
    }
    .check(file)?;
    Ok((catalogue, recipe))
}

fn chances(features: &[Feature]) -> Result<Vec<Chance>, String> {
    let chance = |f: &Feature| match (f.chance, &f.same_as) {
        (Some(p), None) if (0.0..=1.0).contains(&p) => Ok(Chance {
            probability: p,
            same_as: None,
            spoils: f.spoils,
        }),
        (None, Some(other)) => {
            let at = features
                .iter()
                .position(|g| &g.name == other && g.same_as.is_none())
                .ok_or_else(|| format!("feature `{}` is the same as an unknown one", f.name))?;
            Ok(Chance {
                probability: 0.0,
                same_as: Some(at),
                spoils: f.spoils,
            })
        }
        _ => Err(format!(
            "feature `{}` needs either a chance in 0..=1 or a same-as",
            f.name
        )),
    };
    features.iter().map(chance).collect()
}
