//! Situations of any size, to see how the cost of a decision grows: one size at a time is varied, the others are those
//! of a table of middle size.

use deictic_core::board::{self, CATEGORIES, ENTITIES, OPTIONS, WORDS};
use deictic_core::category::{BitSet, Category, CategorySet};
use deictic_core::sentence::MODALITIES;
use deictic_core::vocabulary::{Action, Requirement, Signature};

use crate::random::Random;

/// Features of every thing.
const FEATURES: u8 = 8;

/// Storages, all of which are there.
const STORAGES: u8 = 4;

/// Options of every further category.
const FURTHER: u8 = 4;

/// Situations of every size, over which the cost is averaged.
pub const DRAWS: u64 = 8;

/// How large a situation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Actions of the vocabulary.
    pub actions: u8,
    /// Objects of the vocabulary, each of which is there.
    pub objects: u8,
    /// Who speaks.
    pub modalities: u8,
    /// Words in each of their sentences: action, object, storage, and further categories.
    pub words: u8,
}

impl Size {
    /// What the others are while one is varied.
    pub const MIDDLE: Self = Self {
        actions: 8,
        objects: 6,
        modalities: 2,
        words: 3,
    };

    /// Every size in every direction: its name and the sizes from the smallest to the largest that a board's capacity
    /// holds.
    pub fn directions() -> impl Iterator<Item = (&'static str, Self)> {
        let middle = Self::MIDDLE;
        let actions = (2..=OPTIONS as u8).step_by(2);
        let objects = (2..=ENTITIES as u8 - STORAGES).step_by(2);
        let modalities = 1..=MODALITIES as u8;
        let words = 1..=WORDS as u8;
        let actions = actions.map(move |actions| ("actions", Self { actions, ..middle }));
        let objects = objects.map(move |objects| ("objects", Self { objects, ..middle }));
        let modalities = modalities.map(move |modalities| {
            (
                "modalities",
                Self {
                    modalities,
                    ..middle
                },
            )
        });
        let words = words.map(move |words| ("words", Self { words, ..middle }));
        actions.chain(objects).chain(modalities).chain(words)
    }

    /// The size in a direction.
    #[must_use]
    pub fn along(self, direction: &str) -> u8 {
        match direction {
            "actions" => self.actions,
            "objects" => self.objects,
            "modalities" => self.modalities,
            _ => self.words,
        }
    }
}

/// Numbers that belong to a place, whatever else there is: a larger situation holds the smaller one.
fn at(draw: u64, place: [u8; 4]) -> Random {
    Random::new((draw << 32) | u64::from(u32::from_le_bytes(place)))
}

/// Makes the situation.
pub fn fill(
    size: Size,
    draw: u64,
    vocabulary: &mut board::Vocabulary,
    scene: &mut board::Scene,
    observations: &mut board::Observations,
) {
    let mut actions = [Action::default(); OPTIONS];
    for (action, k) in actions.iter_mut().zip(0_u8..) {
        *action = takes_both(&mut at(draw, [1, k, 0, 0]));
    }
    let actions = actions.get(..usize::from(size.actions)).unwrap_or_default();
    let mut options = [FURTHER; CATEGORIES - 1];
    for (options, count) in options.iter_mut().zip([size.objects, STORAGES]) {
        *options = count;
    }
    let options = options.get(..WORDS - 1).unwrap_or_default();
    *vocabulary = board::Vocabulary::new(actions, options, FEATURES, None, 0).unwrap_or_default();
    *scene = board::Scene::new(1);
    let things = [
        (Category::OBJECT, size.objects),
        (Category::STORAGE, STORAGES),
    ];
    for (category, count) in things {
        for option in 0..count {
            let mut random = at(draw, [2, category.index() as u8, option, 0]);
            let entity = board::Entity {
                category,
                option,
                position: [0.0; 3],
                features: (0..FEATURES).map(|_| random.unit()).collect(),
            };
            // It fits by the constants above.
            let _ = scene.push(entity, vocabulary);
        }
    }
    observations.clear();
    for modality in 0..size.modalities {
        let mut sentence = board::Sentence::new(modality);
        for q in 0..size.words {
            if let Some(word) = word(draw, modality, q, vocabulary) {
                // As many words fit as there are.
                let _ = sentence.push(word);
            }
        }
        // What is made here fits the vocabulary it was made for.
        let _ = observations.insert(&sentence, vocabulary);
    }
}

/// An action that takes an object and a storage, so that every thing counts for every action.
fn takes_both(random: &mut Random) -> Action {
    let mut need = || {
        let mask = (1 << FEATURES) - 1;
        let wanted = (random.next() & random.next()) as u32 & mask;
        let unwanted = (random.next() & random.next()) as u32 & mask & !wanted;
        Requirement {
            wanted: BitSet(wanted),
            unwanted: BitSet(unwanted),
        }
    };
    Action {
        signature: Signature {
            compulsory: [Category::OBJECT, Category::STORAGE].into_iter().collect(),
            voluntary: CategorySet::EMPTY,
        },
        object: need(),
        storage: need(),
    }
}

/// A word of certain category.
fn word(draw: u64, modality: u8, q: u8, vocabulary: &board::Vocabulary) -> Option<board::Word> {
    let category = Category::from_index(usize::from(q))?;
    let mut likelihoods = [0.0; OPTIONS];
    for (k, w) in (0_u8..).zip(likelihoods.iter_mut()) {
        *w = at(draw, [3, modality, q, k]).unit();
    }
    let likelihoods = likelihoods.get(..vocabulary.options_of(category))?;
    board::Word::certain(category, likelihoods).ok()
}
