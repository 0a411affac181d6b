//! The `vocab.json` of the reference's data sets.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::Deserialize;

use super::{Catalogue, CatalogueError, NamedAction, NamedRequirement, Table, resolve};

#[derive(Deserialize)]
struct File {
    actions: Vec<String>,
    objects: Vec<String>,
    storages: Vec<String>,
    features: Vec<String>,
    types: Vec<String>,
    action_requirements: BTreeMap<String, Needs>,
    sim_action_gesture: Table,
    sim_action_language: Table,
    sim_object_gesture: Table,
    sim_object_language: Table,
    sim_storage_gesture: Table,
    sim_storage_language: Table,
}

#[derive(Deserialize)]
struct Needs {
    compulsory: Vec<String>,
    object_positive: Vec<String>,
    object_negative: Vec<String>,
    storage_positive: Vec<String>,
    storage_negative: Vec<String>,
    storage_type: Vec<String>,
}

pub(super) fn read(path: &Path) -> Result<Catalogue, CatalogueError> {
    let file = path.display().to_string();
    let text = fs::read_to_string(path).map_err(|cause| CatalogueError::Read {
        file: file.clone(),
        cause,
    })?;
    let raw: File = serde_json::from_str(&text).map_err(|error| CatalogueError::Format {
        file: file.clone(),
        reason: error.to_string(),
    })?;
    let refuse = |reason| CatalogueError::Content {
        file: file.clone(),
        reason,
    };
    let mut actions = Vec::new();
    for name in &raw.actions {
        let needs = raw
            .action_requirements
            .get(name)
            .ok_or_else(|| refuse(format!("action `{name}` has no requirements")))?;
        if needs.storage_type.len() > 1 {
            return Err(refuse(format!(
                "action `{name}` needs a storage of several types at once"
            )));
        }
        let named = NamedAction {
            name,
            takes: &needs.compulsory,
            object: NamedRequirement {
                wanted: &needs.object_positive,
                unwanted: &needs.object_negative,
                kind: None,
            },
            storage: NamedRequirement {
                wanted: &needs.storage_positive,
                unwanted: &needs.storage_negative,
                kind: needs.storage_type.first().map(String::as_str),
            },
        };
        actions.push(resolve(&named, &raw.features, &raw.types).map_err(refuse)?);
    }
    Catalogue {
        names: [raw.actions, raw.objects, raw.storages],
        features: raw.features,
        types: raw.types,
        actions,
        similarity: [
            [
                raw.sim_action_gesture,
                raw.sim_object_gesture,
                raw.sim_storage_gesture,
            ],
            [
                raw.sim_action_language,
                raw.sim_object_language,
                raw.sim_storage_language,
            ],
        ],
    }
    .check(&file)
}
