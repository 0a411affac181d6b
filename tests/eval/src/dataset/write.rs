//! Writing data sets in the format that [`super::read`] reads.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::{Map, Value, json};

use super::Set;
use crate::catalogue::{CATEGORY_NAMES, Catalogue, MODALITY_NAMES};
use crate::record::{Record, Thing};

/// Writes a set as gzipped JSON lines, likelihoods to six digits.
///
/// # Errors
/// The system's.
pub fn set(path: &Path, set: &Set, catalogue: &Catalogue) -> std::io::Result<()> {
    let packer = GzEncoder::new(File::create(path)?, Compression::default());
    let mut out = BufWriter::new(packer);
    for (i, record) in set.records.iter().enumerate() {
        writeln!(out, "{}", line(i, record, catalogue))?;
    }
    out.into_inner()
        .map_err(std::io::IntoInnerError::into_error)?
        .finish()?;
    Ok(())
}

/// Writes the `vocab.json` that belongs to the sets in a folder.
///
/// # Errors
/// The system's.
pub fn vocabulary(path: &Path, catalogue: &Catalogue) -> std::io::Result<()> {
    let mut needs = Map::new();
    for (name, action) in catalogue.names[0].iter().zip(&catalogue.actions) {
        let features = |set: deictic_core::category::FeatureSet| -> Vec<&str> {
            set.iter()
                .filter_map(|k| catalogue.features.get(k).map(String::as_str))
                .collect()
        };
        let types: Vec<&str> = action
            .storage
            .wanted
            .iter()
            .filter_map(|k| k.checked_sub(catalogue.features.len()))
            .filter_map(|t| catalogue.types.get(t).map(String::as_str))
            .collect();
        let mut compulsory = vec!["action"];
        for q in action.signature.compulsory.iter() {
            compulsory.extend(CATEGORY_NAMES.get(q));
        }
        let entry = json!({
            "compulsory": compulsory,
            "object_positive": features(action.object.wanted),
            "object_negative": features(action.object.unwanted),
            "storage_positive": features(action.storage.wanted),
            "storage_negative": features(action.storage.unwanted),
            "storage_type": types,
        });
        needs.insert(name.clone(), entry);
    }
    let mut whole = Map::new();
    for (names, key) in catalogue
        .names
        .iter()
        .zip(["actions", "objects", "storages"])
    {
        whole.insert(key.to_owned(), json!(names));
    }
    whole.insert("features".to_owned(), json!(catalogue.features));
    whole.insert("types".to_owned(), json!(catalogue.types));
    whole.insert("action_requirements".to_owned(), Value::Object(needs));
    for (tables, modality) in catalogue.similarity.iter().zip(MODALITY_NAMES) {
        for (table, category) in tables.iter().zip(CATEGORY_NAMES) {
            let rows: Vec<Vec<f64>> = table
                .iter()
                .map(|row| row.iter().map(|&x| rounded(x)).collect())
                .collect();
            whole.insert(format!("sim_{category}_{modality}"), json!(rows));
        }
    }
    let mut out = BufWriter::new(File::create(path)?);
    serde_json::to_writer_pretty(&mut out, &whole)?;
    out.flush()
}

fn line(i: usize, record: &Record, catalogue: &Catalogue) -> Value {
    let name = |c: usize, option: u8| catalogue.names[c][usize::from(option)].as_str();
    let things = |c: usize| -> Vec<Value> {
        let entry = |thing: &Thing| {
            let kinds: Vec<&str> = thing
                .kind
                .iter()
                .map(|&t| catalogue.types[usize::from(t)].as_str())
                .collect();
            let features: Vec<Value> = thing
                .features
                .iter()
                .map(|f| json!([rounded(f.likelihood), u8::from(f.holds)]))
                .collect();
            json!([name(c, thing.option), kinds, features])
        };
        record.things(c).iter().map(entry).collect()
    };
    let sentence = |m: usize| {
        let mut words = Map::new();
        for (word, category) in record.words[m].iter().zip(CATEGORY_NAMES) {
            let likelihoods: Vec<f64> = word.iter().flatten().map(|&x| rounded(x)).collect();
            words.insert(category.to_owned(), json!(likelihoods));
        }
        words
    };
    let feasible: Map<String, Value> = (0..catalogue.count(0))
        .map(|a| {
            (
                catalogue.names[0][a].clone(),
                feasible(a, record, catalogue),
            )
        })
        .collect();
    json!({
        "i": i,
        "objects": things(1),
        "storages": things(2),
        "gesture": sentence(0),
        "language": sentence(1),
        "truth": {
            "action": name(0, record.truth.action),
            "object": record.truth.object.map(|o| name(1, o)),
            "storage": record.truth.storage.map(|s| name(2, s)),
        },
        "feas": feasible,
    })
}

/// `[1]` for an action without parameters, else the places in the scene of what it can be done to.
fn feasible(action: usize, record: &Record, catalogue: &Catalogue) -> Value {
    let fit = |c: usize| -> Vec<usize> {
        let things = record.things(c).iter().enumerate();
        things
            .filter(|(_, thing)| catalogue.meets(action, c, thing))
            .map(|(at, _)| at)
            .collect()
    };
    match (catalogue.takes(action, 1), catalogue.takes(action, 2)) {
        (false, false) => json!([1]),
        (true, false) => json!(fit(1)),
        (false, true) => json!(fit(2)),
        (true, true) => {
            let storages = fit(2);
            let pairs: Vec<[usize; 2]> = fit(1)
                .into_iter()
                .flat_map(|o| storages.iter().map(move |&s| [o, s]))
                .collect();
            json!(pairs)
        }
    }
}

fn rounded(x: f32) -> f64 {
    (f64::from(x) * 1e6).round() / 1e6
}
