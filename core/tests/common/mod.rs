//! The paper's tabletop in core types: nine actions, five objects, four storages, ten features.
#![allow(dead_code, reason = "every test uses a part of it")]

use deictic_core::board::{Entity, Observations, Scene, Sentence, Trace, Vocabulary, Word};
use deictic_core::category::{BitSet, Category};
use deictic_core::decide::{Decision, Outcome};
use deictic_core::fuse::{Situation, fuse};
use deictic_core::joint::Tables;
use deictic_core::profile::{Profile, ProfileError};
use deictic_core::vocabulary::{Action, Requirement, Signature};

pub const MOVE_UP: u8 = 0;
pub const RELEASE: u8 = 1;
pub const STOP: u8 = 2;
pub const PICK: u8 = 3;
pub const PUSH: u8 = 4;
pub const UNGLUE: u8 = 5;
pub const POUR: u8 = 6;
pub const PUT: u8 = 7;
pub const STACK: u8 = 8;

pub const CAN: u8 = 0;
pub const CUP: u8 = 1;
pub const BOX: u8 = 3;
pub const DRAWER: u8 = 0;
pub const BOWL: u8 = 3;

const GLUED: usize = 0;
const PICKABLE: usize = 1;
const REACHABLE: usize = 2;
const STACKABLE: usize = 3;
const PUSHABLE: usize = 4;
const LIQUID_CONTAINER: usize = 5;
const CONTAINER: usize = 6;
const FULL_STACK: usize = 7;
const FULL_LIQUID: usize = 8;
const FULL: usize = 9;

fn set(members: &[usize]) -> BitSet {
    members.iter().fold(BitSet::EMPTY, |s, m| s.with(*m))
}

fn action(compulsory: &[Category], object: [&[usize]; 2], storage: [&[usize]; 2]) -> Action {
    let requirement = |[wanted, unwanted]: [&[usize]; 2]| Requirement {
        wanted: set(wanted),
        unwanted: set(unwanted),
    };
    Action {
        signature: Signature {
            compulsory: compulsory.iter().copied().collect(),
            voluntary: BitSet::EMPTY,
        },
        object: requirement(object),
        storage: requirement(storage),
    }
}

pub fn vocabulary() -> Vocabulary {
    let (o, s) = (Category::OBJECT, Category::STORAGE);
    let free = [&[][..], &[][..]];
    let movable = [&[PICKABLE, REACHABLE][..], &[GLUED, FULL_STACK][..]];
    let mut pour = action(
        &[o, s],
        [&[PICKABLE, REACHABLE, FULL_LIQUID], &[GLUED, FULL_STACK]],
        [
            &[REACHABLE, LIQUID_CONTAINER],
            &[FULL_STACK, FULL_LIQUID, FULL],
        ],
    );
    pour.signature.voluntary = [Category::DISTANCE].into_iter().collect();
    let actions = [
        action(&[], free, free),
        action(&[], free, free),
        action(&[], free, free),
        action(&[o], movable, free),
        action(&[o], [&[PUSHABLE, REACHABLE], &[GLUED, FULL_STACK]], free),
        action(&[o], [&[GLUED], &[]], free),
        pour,
        action(
            &[o, s],
            movable,
            [&[REACHABLE, CONTAINER], &[FULL_STACK, FULL_LIQUID, FULL]],
        ),
        action(&[o, s], movable, [&[REACHABLE, STACKABLE], &[FULL_STACK]]),
    ];
    Vocabulary::new(&actions, &[5, 4, 1], 10, Some(STOP), 0xdec1_c71c).unwrap()
}

pub fn entity(category: Category, option: u8, features: &[usize]) -> Entity {
    let mut likelihoods = [0.0; 10];
    features.iter().for_each(|f| likelihoods[*f] = 1.0);
    Entity {
        category,
        option,
        position: [0.4, 0.1 * f32::from(option), 0.0],
        features: likelihoods.into_iter().collect(),
    }
}

/// A can full of water, a box that is glued, a drawer and a bowl; no cup.
pub fn things() -> [Entity; 4] {
    [
        entity(Category::OBJECT, BOX, &[GLUED, PUSHABLE, REACHABLE]),
        entity(
            Category::OBJECT,
            CAN,
            &[PICKABLE, REACHABLE, PUSHABLE, FULL_LIQUID],
        ),
        entity(
            Category::STORAGE,
            BOWL,
            &[REACHABLE, LIQUID_CONTAINER, CONTAINER],
        ),
        entity(Category::STORAGE, DRAWER, &[REACHABLE, CONTAINER]),
    ]
}

pub fn scene() -> Scene {
    let mut scene = Scene::new(1);
    for thing in things() {
        scene.push(thing, &vocabulary()).unwrap();
    }
    scene
}

/// A word that says `option` at 0.9 and everything else at 0.2.
pub fn word(category: Category, option: u8) -> Word {
    let options = vocabulary().options_of(category);
    let mut likelihoods = vec![0.2; options];
    likelihoods[usize::from(option)] = 0.9;
    Word::certain(category, &likelihoods).unwrap()
}

pub fn sentence(modality: u8, words: &[Word]) -> Sentence {
    let mut s = Sentence::new(modality);
    for w in words {
        s.push(w.clone()).unwrap();
    }
    s
}

pub fn command(modality: u8, action: u8, object: Option<u8>, storage: Option<u8>) -> Sentence {
    let mut words = vec![word(Category::ACTION, action)];
    words.extend(object.map(|o| word(Category::OBJECT, o)));
    words.extend(storage.map(|s| word(Category::STORAGE, s)));
    sentence(modality, &words)
}

pub fn decide(sentences: &[Sentence], profile: &Profile) -> Result<Decision<8>, ProfileError> {
    decide_in(&scene(), sentences, profile).0
}

pub fn decide_in(
    scene: &Scene,
    sentences: &[Sentence],
    profile: &Profile,
) -> (Result<Decision<8>, ProfileError>, Trace) {
    let mut trace = Trace::new();
    (decide_again(scene, sentences, profile, &mut trace), trace)
}

/// Decides with a trace that may have been used before.
pub fn decide_again(
    scene: &Scene,
    sentences: &[Sentence],
    profile: &Profile,
    trace: &mut Trace,
) -> Result<Decision<8>, ProfileError> {
    let mut observations = Observations::new();
    for s in sentences {
        observations.insert(s.clone(), &vocabulary()).unwrap();
    }
    let vocabulary = vocabulary();
    let situation = Situation {
        vocabulary: &vocabulary,
        scene,
        observations: &observations,
        sensors: Tables::NONE,
    };
    fuse(situation, profile, trace)
}

/// (action, object, storage) of what is to be executed.
pub fn executed(decision: &Decision<8>) -> Option<(u8, Option<u8>, Option<u8>)> {
    match &decision.outcome {
        Outcome::Execute(i) => Some((
            i.action,
            i.option(Category::OBJECT),
            i.option(Category::STORAGE),
        )),
        _ => None,
    }
}
