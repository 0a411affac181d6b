//! The table set-ups of the paper's user study (Real datasets), with likelihoods drawn in place of
//! recordings, which are not public: the aligned command, and the four in which one modality names
//! a wrong action or a wrong object.

use std::collections::BTreeMap;
use std::path::Path;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Deserialize;

use crate::catalogue::{CATEGORY_NAMES, Catalogue, CatalogueError, Table};
use crate::dataset::Set;
use crate::noise::Noise;
use crate::phonetic;
use crate::record::{CATEGORIES, Feature, MODALITIES, Record, Thing, Triple, Words};

#[derive(Deserialize)]
struct Setup {
    truth: Sentence,
    scene: Vec<Entry>,
    correct: Sentence,
    wrong_action: Sentence,
    wrong_object: Sentence,
}

#[derive(Deserialize)]
struct Entry {
    name: String,
    kind: String,
    features: BTreeMap<String, bool>,
}

#[derive(Clone, Deserialize)]
struct Sentence {
    action: String,
    object: Option<String>,
    storage: Option<String>,
}

/// What one modality says in place of the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrong {
    /// Nothing: the command is aligned.
    Nothing,
    /// Another action.
    Action,
    /// Another object.
    Object,
}

/// The set-ups, to draw samples from.
pub struct Setups {
    /// Their vocabulary.
    pub catalogue: Catalogue,
    setups: Vec<(Record, [Said; 3])>,
}

/// The options that a sentence names.
type Said = [Option<u8>; CATEGORIES];

impl Setups {
    /// Reads the published list.
    ///
    /// # Errors
    /// [`CatalogueError`] naming the file and what is wrong in it.
    pub fn read(path: &Path) -> Result<Self, CatalogueError> {
        let file = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|cause| CatalogueError::Read {
            file: file.clone(),
            cause,
        })?;
        let raw: Vec<Setup> = serde_json::from_str(&text).map_err(|e| CatalogueError::Format {
            file: file.clone(),
            reason: e.to_string(),
        })?;
        Self::from_raw(&raw).map_err(|reason| CatalogueError::Content { file, reason })
    }

    fn from_raw(raw: &[Setup]) -> Result<Self, String> {
        let catalogue = catalogue(raw);
        let place = |c: usize, name: &str| {
            catalogue.names[c]
                .iter()
                .position(|known| known == name)
                .and_then(|at| u8::try_from(at).ok())
                .ok_or_else(|| format!("unknown {} `{name}`", CATEGORY_NAMES[c]))
        };
        let said = |s: &Sentence| -> Result<Said, String> {
            let parameter = |c: usize, name: &Option<String>| {
                name.as_deref().map(|name| place(c, name)).transpose()
            };
            Ok([
                Some(place(0, &s.action)?),
                parameter(1, &s.object)?,
                parameter(2, &s.storage)?,
            ])
        };
        let mut setups = Vec::new();
        for setup in raw {
            let things = |c: usize| -> Result<Vec<Thing>, String> {
                let entries = setup.scene.iter().filter(|e| e.kind == CATEGORY_NAMES[c]);
                entries
                    .map(|entry| {
                        Ok(Thing {
                            option: place(c, &entry.name)?,
                            kind: None,
                            features: features(entry, &catalogue)?,
                        })
                    })
                    .collect()
            };
            let [action, object, storage] = said(&setup.truth)?;
            let record = Record {
                objects: things(1)?,
                storages: things(2)?,
                words: Default::default(),
                truth: Triple {
                    action: action.unwrap_or(0),
                    object,
                    storage,
                },
            };
            let sentences = [
                said(&setup.correct)?,
                said(&setup.wrong_action)?,
                said(&setup.wrong_object)?,
            ];
            setups.push((record, sentences));
        }
        Ok(Self { catalogue, setups })
    }

    /// `draws` samples of every set-up, with what is `wrong` in one modality.
    #[must_use]
    pub fn draw(
        &self,
        wrong: Wrong,
        modality: usize,
        noise: Noise,
        draws: usize,
        seed: u64,
    ) -> Set {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(0xea1 << 8 | (wrong as u64) << 4 | modality as u64);
        let mut records = Vec::new();
        for (setup, sentences) in &self.setups {
            for _ in 0..draws {
                let mut record = setup.clone();
                record.words = std::array::from_fn(|m| {
                    let which = if m == modality { wrong as usize } else { 0 };
                    self.words(m, sentences[which], noise, &mut rng)
                });
                records.push(record);
            }
        }
        let name = match (wrong, modality) {
            (Wrong::Nothing, _) => "real_aligned",
            (Wrong::Action, 0) => "real_wrong_action_in_gesture",
            (Wrong::Action, _) => "real_wrong_action_in_language",
            (Wrong::Object, 0) => "real_wrong_object_in_gesture",
            (Wrong::Object, _) => "real_wrong_object_in_language",
        };
        Set {
            name: name.to_owned(),
            records,
        }
    }

    /// All five kinds of command.
    #[must_use]
    pub fn all(&self, noise: Noise, draws: usize, seed: u64) -> Vec<Set> {
        let mut sets = vec![self.draw(Wrong::Nothing, 0, noise, draws, seed)];
        for wrong in [Wrong::Action, Wrong::Object] {
            for modality in 0..MODALITIES {
                sets.push(self.draw(wrong, modality, noise, draws, seed));
            }
        }
        sets
    }

    fn words(&self, m: usize, said: Said, noise: Noise, rng: &mut impl Rng) -> Words {
        let mut words = Words::default();
        for (c, option) in said.iter().enumerate() {
            let Some(option) = option else { continue };
            let row = &self.catalogue.similarity[m][c][usize::from(*option)];
            let word = row
                .iter()
                .map(|&x| noise.observe(f64::from(x), rng) as f32)
                .collect();
            words[c] = Some(word);
        }
        words
    }
}

/// The paper's actions and features with the things of these scenes; in language all names are as
/// alike as they sound. What kind a thing is of is a
/// feature like others here, as a bowl is both a container and a liquid container.
fn catalogue(raw: &[Setup]) -> Catalogue {
    let (mut catalogue, _) = Catalogue::papers();
    phonetic::correct(&mut catalogue);
    catalogue.features.append(&mut catalogue.types);
    for (c, category) in CATEGORY_NAMES.iter().enumerate().skip(1) {
        let entries = raw.iter().flat_map(|setup| &setup.scene);
        let names = entries.filter(|entry| entry.kind == *category);
        let mut names: Vec<String> = names.map(|entry| entry.name.clone()).collect();
        names.sort();
        names.dedup();
        let others = catalogue.similarity[0][c]
            .first()
            .and_then(|row| row.get(1))
            .copied();
        let flat = |i: usize, j: usize| if i == j { 1.0 } else { others.unwrap_or(0.0) };
        let table: Table = (0..names.len())
            .map(|i| (0..names.len()).map(|j| flat(i, j)).collect())
            .collect();
        catalogue.similarity[0][c] = table.clone();
        catalogue.similarity[1][c] = if c == 1 {
            phonetic::table(&names)
        } else {
            table
        };
        catalogue.names[c] = names;
    }
    catalogue
}

fn features(entry: &Entry, catalogue: &Catalogue) -> Result<Vec<Feature>, String> {
    if let Some(unknown) = entry
        .features
        .keys()
        .find(|name| !catalogue.features.contains(name))
    {
        return Err(format!(
            "`{}` has the unknown feature `{unknown}`",
            entry.name
        ));
    }
    let holds = |name: &String| entry.features.get(name).copied().unwrap_or(false);
    Ok(catalogue
        .features
        .iter()
        .map(|name| Feature::sure(holds(name)))
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Level;

    const ONE: &str = r#"[{
        "truth": {"action": "pour", "object": "can", "storage": "bowl"},
        "scene": [
            {"name": "bowl", "kind": "storage",
             "features": {"reachable": true, "liquid-container": true, "container": true}},
            {"name": "can", "kind": "object",
             "features": {"reachable": true, "pickable": true, "full-liquid": true}},
            {"name": "cup", "kind": "object", "features": {"glued": true}}
        ],
        "correct": {"action": "pour", "object": "can", "storage": "bowl"},
        "wrong_action": {"action": "stop", "object": "can", "storage": "bowl"},
        "wrong_object": {"action": "pour", "object": "cup", "storage": "bowl"}
    }]"#;

    #[test]
    fn each_modality_says_what_it_is_made_to_say() {
        let raw: Vec<Setup> = serde_json::from_str(ONE).unwrap();
        let setups = Setups::from_raw(&raw).unwrap();
        let sets = setups.all(Level::N0.into(), 2, 1);
        let best = |set: &Set, m: usize, c: usize| {
            let word = set.records[0].words[m][c].as_ref().unwrap();
            let top = word.iter().position(|&x| x == 1.0).unwrap();
            setups.catalogue.names[c][top].clone()
        };
        let said = |set: &Set, c: usize| [best(set, 0, c), best(set, 1, c)];
        assert_eq!(said(&sets[0], 0), ["pour", "pour"]);
        assert_eq!(said(&sets[1], 0), ["stop", "pour"]);
        assert_eq!(said(&sets[2], 0), ["pour", "stop"]);
        assert_eq!(said(&sets[3], 1), ["cup", "can"]);
        assert_eq!(said(&sets[4], 1), ["can", "cup"]);
        let record = &sets[0].records[0];
        assert!(
            setups
                .catalogue
                .possible(usize::from(record.truth.action), record)
        );
        assert_eq!(sets[0].records.len(), 2);
    }

    #[test]
    fn unknown_names_are_refused() {
        let wrong = ONE.replace("\"glued\"", "\"sticky\"");
        let raw: Vec<Setup> = serde_json::from_str(&wrong).unwrap();
        let error = Setups::from_raw(&raw).err().unwrap();
        assert!(error.contains("cup") && error.contains("sticky"), "{error}");
    }
}
