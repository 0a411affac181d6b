//! The paper's simulated sets (Simulated datasets; METHOD, section 7), made anew: what is meant is
//! drawn first, then a scene in which it can be done, then what both modalities observe of it.
//!
//! These sets leak, as the published ones do: only what is meant meets the meant action's
//! requirements, and both modalities raise the same rivals. [`crate::free`] makes fairer ones.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::catalogue::Catalogue;
use crate::dataset::Set;
use crate::noise::{Level, Noise};
use crate::recipe::Recipe;
use crate::record::{CATEGORIES, MODALITIES, Record, Triple, Words};

mod scene;

pub use scene::{chosen, things_by_chance};

/// Which actions rival with the one that is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// None: both modalities follow the truth.
    Aligned,
    /// All with another number of parameters.
    Arity,
    /// All that cannot be done in the scene.
    Properties,
}

impl Kind {
    /// All, in the paper's order.
    pub const ALL: [Self; 3] = [Self::Aligned, Self::Arity, Self::Properties];

    /// What its sets are called.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Aligned => "D_A",
            Self::Arity => "D_arity",
            Self::Properties => "D_prop",
        }
    }
}

/// A set of `n` samples; the same for the same seed.
#[must_use]
pub fn set(
    catalogue: &Catalogue,
    recipe: &Recipe,
    kind: Kind,
    level: Level,
    n: usize,
    seed: u64,
) -> Set {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream((kind as u64) << 8 | level.number() as u64);
    Set {
        name: format!("{}_n{}", kind.name(), level.number()),
        records: (0..n)
            .map(|_| sample(catalogue, recipe, kind, level.into(), &mut rng))
            .collect(),
    }
}

fn sample(
    catalogue: &Catalogue,
    recipe: &Recipe,
    kind: Kind,
    noise: Noise,
    rng: &mut impl Rng,
) -> Record {
    let action = index(catalogue.count(0), rng);
    let mut parameter = |c: usize| {
        catalogue
            .takes(usize::from(action), c)
            .then(|| index(catalogue.count(c), rng))
    };
    let truth = Triple {
        action,
        object: parameter(1),
        storage: parameter(2),
    };
    let mut record = Record {
        objects: scene::around(catalogue, recipe, truth, 1, rng),
        storages: scene::around(catalogue, recipe, truth, 2, rng),
        words: Default::default(),
        truth,
    };
    let raised = raised(catalogue, kind, &record, usize::from(truth.action));
    record.words = std::array::from_fn(|m| words(catalogue, kind, m, truth, &raised, noise, rng));
    record
}

/// A number below `n`, which is at most 64.
pub(crate) fn index(n: usize, rng: &mut impl Rng) -> u8 {
    let n = u8::try_from(n).unwrap_or(u8::MAX);
    rng.random_range(0..n.max(1))
}

/// Which actions rival with `action` in this scene.
#[must_use]
pub fn raised(catalogue: &Catalogue, kind: Kind, record: &Record, action: usize) -> Vec<bool> {
    let arity = |a: usize| (1..CATEGORIES).filter(|&c| catalogue.takes(a, c)).count();
    (0..catalogue.count(0))
        .map(|other| match kind {
            Kind::Aligned => false,
            Kind::Arity => arity(other) != arity(action),
            Kind::Properties => !catalogue.possible(other, record),
        })
        .collect()
}

/// One modality's words in a sample of this kind: a row of its similarity table per category, rivals raised to the level of
/// what is meant, with errors.
#[must_use]
pub fn words(
    catalogue: &Catalogue,
    kind: Kind,
    modality: usize,
    truth: Triple,
    raised: &[bool],
    noise: Noise,
    rng: &mut impl Rng,
) -> Words {
    // Rivals that cannot be done in the scene share one error in the published sets.
    let shared = noise.draw(rng);
    let mut words = Words::default();
    for (c, meant) in truth.options().iter().enumerate() {
        let Some(meant) = meant.map(usize::from) else {
            continue;
        };
        let row = &catalogue.similarity[modality][c][meant];
        let word = row
            .iter()
            .enumerate()
            .map(|(i, &likelihood)| {
                let rival = c == 0 && raised[i];
                let level = f64::from(if rival { row[meant] } else { likelihood });
                let seen = if rival && kind == Kind::Properties {
                    (level + shared).clamp(0.0, 1.0)
                } else {
                    noise.observe(level, rng)
                };
                seen as f32
            })
            .collect();
        words[c] = Some(word);
    }
    words
}

const _: () = assert!(MODALITIES == 2, "the generator speaks and shows");
