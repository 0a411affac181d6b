//! The file in which the paper's authors published their table set-ups: JSON, one object per set-up.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use deictic_core::category::Category;
use deictic_core::large::Entity;
use serde::Deserialize;

use super::{Command, Setup, SetupsError};
use crate::scene::Tabletop;
use crate::vocabulary::Lexicon;

#[derive(Deserialize)]
struct Written {
    subset: String,
    run: u32,
    truth: Words,
    scene: Vec<Thing>,
    wrong_action: Words,
    wrong_object: Words,
}

#[derive(Deserialize)]
struct Words {
    action: String,
    object: Option<String>,
    storage: Option<String>,
}

#[derive(Deserialize)]
struct Thing {
    name: String,
    kind: String,
    features: BTreeMap<String, bool>,
}

/// Reads the set-ups of a file over a vocabulary.
///
/// # Errors
/// [`SetupsError`] with the set-up's place and what is wrong with it.
pub fn read(path: &Path, lexicon: &Lexicon) -> Result<Vec<Setup>, SetupsError> {
    let file = path.display().to_string();
    let text = fs::read_to_string(path).map_err(|cause| SetupsError::Unreadable {
        file: file.clone(),
        cause,
    })?;
    let written: Vec<Written> =
        serde_json::from_str(&text).map_err(|cause| SetupsError::Malformed {
            file: file.clone(),
            cause,
        })?;
    written
        .iter()
        .enumerate()
        .map(|(i, setup)| {
            understood(setup, lexicon).map_err(|what| SetupsError::Unknown {
                file: file.clone(),
                setup: i + 1,
                what,
            })
        })
        .collect()
}

fn understood(written: &Written, lexicon: &Lexicon) -> Result<Setup, String> {
    let things: Result<Vec<Entity>, String> = written
        .scene
        .iter()
        .enumerate()
        .map(|(i, thing)| entity(i, thing, lexicon))
        .collect();
    let table = Tabletop::new(things?, lexicon)
        .map_err(|error| crate::explain::scene_error(&error).what)?;
    Ok(Setup {
        name: format!("{} {}", written.subset, written.run),
        table,
        truth: command(&written.truth, lexicon)?,
        wrong_action: command(&written.wrong_action, lexicon)?,
        wrong_object: command(&written.wrong_object, lexicon)?,
    })
}

/// A thing, a hand's breadth beside the one before, as the file says nothing of places.
fn entity(place: usize, thing: &Thing, lexicon: &Lexicon) -> Result<Entity, String> {
    let category = lexicon
        .category(&thing.kind)
        .filter(|c| c.is_entity())
        .ok_or_else(|| format!("`{}` is neither object nor storage", thing.kind))?;
    let mut features = vec![0.0; lexicon.features().len()];
    for (name, holds) in &thing.features {
        let k = lexicon
            .feature(name)
            .ok_or_else(|| format!("no feature `{name}`"))?;
        if let Some(likelihood) = features.get_mut(k) {
            *likelihood = f32::from(u8::from(*holds));
        }
    }
    Ok(Entity {
        category,
        option: option(category, &thing.name, lexicon)?,
        position: [0.4, 0.1 * place as f32 - 0.2, 0.05],
        features: features.into_iter().collect(),
    })
}

fn command(words: &Words, lexicon: &Lexicon) -> Result<Command, String> {
    let named = |category, name: &Option<String>| {
        name.as_ref()
            .map(|name| option(category, name, lexicon))
            .transpose()
    };
    Ok(Command {
        action: option(Category::ACTION, &words.action, lexicon)?,
        object: named(Category::OBJECT, &words.object)?,
        storage: named(Category::STORAGE, &words.storage)?,
    })
}

fn option(category: Category, name: &str, lexicon: &Lexicon) -> Result<u8, String> {
    lexicon
        .option(category, &name.replace('_', "-"))
        .ok_or_else(|| {
            format!(
                "no {} `{name}` in the vocabulary",
                lexicon.category_name(category)
            )
        })
}
