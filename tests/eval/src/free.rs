//! A fairer data set than the published ones, called D_free: what is meant is drawn after the scene,
//! from all that can be done in it, so that neither the scene nor the presence of words gives it
//! away.
//!
//! * At least three actions with parameters are possible in every scene; lists are shuffled.
//! * Each modality has rivals of its own, in object and storage words too.
//! * Words go missing, and words are heard that are not there (an object word taken for a storage
//!   word), in each modality on its own.
//! * Features are graded: likelihoods on the right side of one half.
//! * A hand is noisier and a voice cleaner than the level says.

use rand::seq::IndexedRandom;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::catalogue::Catalogue;
use crate::dataset::Set;
use crate::generate::{chosen, index, things_by_chance};
use crate::noise::{Level, Noise};
use crate::recipe::{Chance, Recipe};
use crate::record::{CATEGORIES, Feature, MODALITIES, Record, Thing, Triple, Words};

/// How often an action, object or storage word has a rival, raised to the level of what is meant.
pub const RIVAL: [f64; CATEGORIES] = [0.3, 0.2, 0.2];

/// How often a word goes missing.
pub const MISSING: f64 = 0.1;

/// How often a word of a category is heard that what is meant does not have.
pub const CONFUSED: f64 = 0.05;

/// By how much errors are larger than the level's: of a hand, of a voice.
pub const SCALE: [f64; MODALITIES] = [1.3, 0.7];

/// How far a feature's likelihood can be from 0 or 1.
const GREY: f32 = 0.45;

/// How many actions with parameters are possible at least.
const POSSIBLE: usize = 3;

/// How often a thing has a feature that spoils it for most actions, and any other.
const CHANCES: [f64; 2] = [0.3, 0.7];

/// The noise of a modality.
#[must_use]
pub fn noise(level: Level, modality: usize) -> Noise {
    Noise {
        level,
        scale: SCALE[modality],
    }
}

/// A set of `n` samples; the same for the same seed.
#[must_use]
pub fn set(catalogue: &Catalogue, recipe: &Recipe, level: Level, n: usize, seed: u64) -> Set {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(0xf00 | level.number() as u64);
    let recipe = favourable(recipe);
    Set {
        name: format!("D_free_n{}", level.number()),
        records: (0..n)
            .map(|_| sample(catalogue, &recipe, level, &mut rng))
            .collect(),
    }
}

fn favourable(recipe: &Recipe) -> Recipe {
    let [spoils, other] = CHANCES;
    let chances = recipe.chances.iter().map(|chance| Chance {
        probability: if chance.spoils { spoils } else { other },
        ..*chance
    });
    Recipe {
        things: recipe.things,
        chances: chances.collect(),
    }
}

fn sample(catalogue: &Catalogue, recipe: &Recipe, level: Level, rng: &mut impl Rng) -> Record {
    loop {
        let mut record = Record {
            objects: things(catalogue, recipe, 1, rng),
            storages: things(catalogue, recipe, 2, rng),
            words: Default::default(),
            truth: Triple {
                action: 0,
                object: None,
                storage: None,
            },
        };
        let can: Vec<u8> = (0_u8..)
            .take(catalogue.count(0))
            .filter(|&a| catalogue.possible(usize::from(a), &record))
            .collect();
        let with_parameters = can
            .iter()
            .filter(|&&a| (1..CATEGORIES).any(|c| catalogue.takes(usize::from(a), c)))
            .count();
        let Some(&action) = can.choose(rng) else {
            continue;
        };
        if with_parameters < POSSIBLE {
            continue;
        }
        let mut parameter = |c: usize| {
            let fit: Vec<u8> = fit(catalogue, &record, usize::from(action), c);
            fit.choose(rng).copied()
        };
        record.truth = Triple {
            action,
            object: parameter(1),
            storage: parameter(2),
        };
        record.words = std::array::from_fn(|m| words(catalogue, m, record.truth, level, rng));
        return record;
    }
}

/// What of a category an action can be done to in a scene; nothing when it takes none.
#[must_use]
pub fn fit(catalogue: &Catalogue, record: &Record, action: usize, category: usize) -> Vec<u8> {
    if !catalogue.takes(action, category) {
        return Vec::new();
    }
    let things = record.things(category).iter();
    things
        .filter(|thing| catalogue.meets(action, category, thing))
        .map(|thing| thing.option)
        .collect()
}

fn things(
    catalogue: &Catalogue,
    recipe: &Recipe,
    category: usize,
    rng: &mut impl Rng,
) -> Vec<Thing> {
    let options = chosen(
        recipe.things[category],
        catalogue.count(category),
        None,
        rng,
    );
    let thing = |option| {
        let features = things_by_chance(recipe, rng);
        let features = features.into_iter().map(|holds| {
            let off = GREY * rng.random::<f32>();
            Feature {
                likelihood: if holds { 1.0 - off } else { off },
                holds,
            }
        });
        let features = features.collect();
        let kind = index(catalogue.types.len() + 1, rng);
        Thing {
            option,
            kind: kind.checked_sub(1),
            features,
        }
    };
    options.into_iter().map(thing).collect()
}

/// What a modality observes of what is meant.
#[must_use]
pub fn words(
    catalogue: &Catalogue,
    modality: usize,
    truth: Triple,
    level: Level,
    rng: &mut impl Rng,
) -> Words {
    let noise = noise(level, modality);
    let mut words = Words::default();
    for (c, meant) in truth.options().iter().enumerate() {
        let n = catalogue.count(c);
        let (heard, rivalled) = match meant {
            Some(_) if rng.random_bool(MISSING) => continue,
            Some(meant) => (usize::from(*meant), rng.random_bool(RIVAL[c])),
            None if rng.random_bool(CONFUSED) => (usize::from(index(n, rng)), false),
            None => continue,
        };
        let rival = if rivalled && n > 1 {
            (heard + 1 + usize::from(index(n - 1, rng))) % n
        } else {
            heard
        };
        let row = &catalogue.similarity[modality][c][heard];
        let word = row.iter().enumerate().map(|(i, &likelihood)| {
            let level = if i == rival { row[heard] } else { likelihood };
            noise.observe(f64::from(level), rng) as f32
        });
        words[c] = Some(word.collect());
    }
    words
}
