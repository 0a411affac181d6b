//! Situations made from a number.

use deictic_core::board;
use deictic_core::category::{BitSet, Category, CategorySet};
use deictic_core::sentence::{GESTURE, LANGUAGE};
use deictic_core::vocabulary::{Action, Requirement, Signature};

use crate::random::Random;

const OBJECTS: u8 = 7;
const STORAGES: u8 = 4;
const FEATURES: u8 = 8;

const NOTHING: CategorySet = CategorySet::EMPTY;
const OBJECT: CategorySet = NOTHING.with(Category::OBJECT.index());
const BOTH: CategorySet = OBJECT.with(Category::STORAGE.index());

const fn action(compulsory: CategorySet, object: Requirement, storage: Requirement) -> Action {
    Action {
        signature: Signature {
            compulsory,
            voluntary: CategorySet::EMPTY,
        },
        object,
        storage,
    }
}

const fn need(wanted: u32, unwanted: u32) -> Requirement {
    Requirement {
        wanted: BitSet(wanted),
        unwanted: BitSet(unwanted),
    }
}

const ANY: Requirement = need(0, 0);
const GLUED: u32 = 1;
const PICKABLE: u32 = 1 << 1;
const REACHABLE: u32 = 1 << 2;
const STACKABLE: u32 = 1 << 3;
const PUSHABLE: u32 = 1 << 4;
const FULL_STACK: u32 = 1 << 5;
const FULL_LIQUID: u32 = 1 << 6;
const FULL_CONTAINER: u32 = 1 << 7;
const IN_HAND: Requirement = need(PICKABLE | REACHABLE, GLUED | FULL_STACK);
const EMPTY: Requirement = need(REACHABLE, FULL_STACK | FULL_LIQUID | FULL_CONTAINER);

/// The paper's actions (Set of actions and objects): move up, release, stop, pick, push, unglue,
/// pour, put into, stack.
pub const ACTIONS: [Action; 9] = [
    action(NOTHING, ANY, ANY),
    action(NOTHING, ANY, ANY),
    action(NOTHING, ANY, ANY),
    action(OBJECT, IN_HAND, ANY),
    action(OBJECT, need(PUSHABLE | REACHABLE, GLUED | FULL_STACK), ANY),
    action(OBJECT, need(GLUED, 0), ANY),
    action(
        BOTH,
        need(PICKABLE | REACHABLE | FULL_LIQUID, GLUED | FULL_STACK),
        EMPTY,
    ),
    action(BOTH, IN_HAND, EMPTY),
    action(BOTH, IN_HAND, need(REACHABLE | STACKABLE, FULL_STACK)),
];

/// How one word is made.
#[derive(Clone, Copy)]
enum Shape {
    Likely,
    OneHot,
    Clipped,
    Faint,
}

/// Makes sample `i`: every second with a vocabulary of its own, all with missing words, words of
/// uncertain category, clipped and one-hot likelihoods; some with an empty table, nothing said, a
/// third modality or a quantity.
pub fn fill(
    i: u32,
    vocabulary: &mut board::Vocabulary,
    scene: &mut board::Scene,
    observations: &mut board::Observations,
) {
    let mut random = Random::new(u64::from(i));
    *vocabulary = if i.is_multiple_of(2) {
        papers()
    } else {
        invented(&mut random)
    };
    let crowded = !random.one_in(64);
    let sure = random.one_in(2);
    furnish(scene, vocabulary, &mut random, crowded, sure);
    observations.clear();
    if random.one_in(32) {
        return;
    }
    say(observations, vocabulary, GESTURE, &mut random, false);
    say(observations, vocabulary, LANGUAGE, &mut random, false);
    if random.one_in(8) {
        say(observations, vocabulary, 2, &mut random, false);
    }
}

/// Makes the situation of the instruction budget.
pub fn m3_case(
    vocabulary: &mut board::Vocabulary,
    scene: &mut board::Scene,
    observations: &mut board::Observations,
) {
    let mut random = Random::new(0x0070_6170_6572);
    *vocabulary = papers();
    furnish(scene, vocabulary, &mut random, true, false);
    observations.clear();
    say(observations, vocabulary, GESTURE, &mut random, true);
    say(observations, vocabulary, LANGUAGE, &mut random, true);
}

fn papers() -> board::Vocabulary {
    board::Vocabulary::new(&ACTIONS, &[OBJECTS, STORAGES], FEATURES, Some(2), 0).unwrap_or_default()
}

/// Nine actions with signatures and requirements by chance, and a distance as a third parameter,
/// which has one option and carries a quantity.
fn invented(random: &mut Random) -> board::Vocabulary {
    let mut actions = [Action::default(); 9];
    for action in &mut actions {
        for category in [Category::OBJECT, Category::STORAGE, Category::DISTANCE] {
            let signature = &mut action.signature;
            match random.below(4) {
                0 => signature.voluntary = signature.voluntary.with(category.index()),
                1 | 2 => signature.compulsory = signature.compulsory.with(category.index()),
                _ => {}
            }
        }
        action.object = requirement(random);
        action.storage = requirement(random);
    }
    board::Vocabulary::new(&actions, &[OBJECTS, STORAGES, 1], FEATURES, None, 0).unwrap_or_default()
}

fn requirement(random: &mut Random) -> Requirement {
    let mask = (1 << FEATURES) - 1;
    let wanted = (random.next() & random.next()) as u32 & mask;
    let unwanted = (random.next() & random.next()) as u32 & mask & !wanted;
    need(wanted, unwanted)
}

/// Five of the objects and three of the storages.
fn furnish(
    scene: &mut board::Scene,
    vocabulary: &board::Vocabulary,
    random: &mut Random,
    crowded: bool,
    sure: bool,
) {
    *scene = board::Scene::new(1);
    if !crowded {
        return;
    }
    for (category, options, wanted) in [
        (Category::OBJECT, OBJECTS, 5_u8),
        (Category::STORAGE, STORAGES, 3),
    ] {
        let first = random.below(u32::from(options)) as u8;
        for k in 0..wanted {
            let mut features = heapless::Vec::new();
            for _ in 0..FEATURES {
                let f = random.unit();
                let f = if sure {
                    f32::from(u8::from(f > 0.5))
                } else {
                    f
                };
                let _ = features.push(f);
            }
            let entity = board::Entity {
                category,
                option: first.wrapping_add(k).checked_rem(options).unwrap_or(0),
                position: [0.0; 3],
                features,
            };
            // Options, features and their number fit the vocabulary by the constants above.
            let _ = scene.push(entity, vocabulary);
        }
    }
}

/// One modality's sentence; `whole` has every word, each of certain category.
fn say(
    observations: &mut board::Observations,
    vocabulary: &board::Vocabulary,
    modality: u8,
    random: &mut Random,
    whole: bool,
) {
    let mut sentence = board::Sentence::new(modality);
    for (q, &options) in vocabulary.options().iter().enumerate() {
        if !whole && random.one_in(6) {
            continue;
        }
        let shape = match random.below(8) {
            _ if whole => Shape::Likely,
            0 => Shape::OneHot,
            1 | 2 => Shape::Clipped,
            3 => Shape::Faint,
            _ => Shape::Likely,
        };
        let mut likelihoods = [0.0_f32; board::OPTIONS];
        let used = likelihoods
            .get_mut(..usize::from(options))
            .unwrap_or_default();
        draw(used, shape, random);
        let mut categories = [0.0_f32; board::CATEGORIES];
        let sureness = if whole || random.one_in(2) {
            1.0
        } else {
            0.5 + 0.5 * random.unit()
        };
        for (k, p) in categories.iter_mut().enumerate() {
            if k == q {
                *p = sureness;
            } else if k == (q ^ 1) {
                *p = (1.0 - sureness) * 0.5;
            }
        }
        let known = categories
            .get(..vocabulary.options().len())
            .unwrap_or_default();
        let Ok(mut word) = board::Word::new(known, used) else {
            continue;
        };
        if options == 1 {
            word = word.with_quantity(random.unit());
        }
        // A board's sentence holds six words, more than there are categories here.
        let _ = sentence.push(word);
    }
    // What is made here fits the vocabulary it was made for.
    let _ = observations.insert(sentence, vocabulary);
}

fn draw(likelihoods: &mut [f32], shape: Shape, random: &mut Random) {
    let hot = random.below(u32::try_from(likelihoods.len()).unwrap_or(1)) as usize;
    for (k, w) in likelihoods.iter_mut().enumerate() {
        let u = random.unit();
        *w = match shape {
            Shape::Likely => u,
            Shape::OneHot => f32::from(u8::from(k == hot)),
            Shape::Clipped => (2.0 * u - 0.5).clamp(0.0, 1.0),
            Shape::Faint => u / 512.0,
        };
    }
}
