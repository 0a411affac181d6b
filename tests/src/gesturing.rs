//! A table with gestures: a small vocabulary, things to point at, and made-up people in front of it.

use deictic::hand::session::{Act, made_up};
use deictic_core::board::{Entity, Scene, ToHost, ToUnit, Vocabulary};
use deictic_core::category::{Category, CategorySet};
use deictic_core::gesture::mapping::Gesture;
use deictic_core::gesture::pointing::Mount;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::stroke_table::NAMES;
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::hand::{Meaning, Meanings};
use deictic_core::protocol::message::{Configuration, Loaded};
use deictic_core::time::Micros;
use deictic_core::vocabulary::{Action, Signature};

use crate::host::{Host, Wire};

/// Stands still.
pub const STOP: u8 = 0;
/// Needs an object and a storage.
pub const PUT: u8 = 1;
/// Needs an object.
pub const PICK: u8 = 2;
/// Needs an object.
pub const PUSH: u8 = 3;

/// Where the three objects are.
pub const OBJECTS: [[f32; 3]; 3] = [[-0.45, -0.25, 0.05], [-0.5, 0.02, 0.05], [-0.45, 0.3, 0.05]];
/// Where the two storages are.
pub const STORAGES: [[f32; 3]; 2] = [[-0.75, -0.45, 0.1], [-0.75, 0.5, 0.1]];

/// Frames per second.
pub const RATE: f64 = 110.0;

/// Stop, put, pick and push.
///
/// # Panics
/// Never.
#[must_use]
pub fn vocabulary() -> Vocabulary {
    let needs = |categories: &[Category]| Action {
        signature: Signature {
            compulsory: categories.iter().copied().collect(),
            voluntary: CategorySet::EMPTY,
        },
        ..Action::default()
    };
    let actions = [
        needs(&[]),
        needs(&[Category::OBJECT, Category::STORAGE]),
        needs(&[Category::OBJECT]),
        needs(&[Category::OBJECT]),
    ];
    Vocabulary::new(&actions, &[3, 2], 0, Some(STOP), 1).expect("a sound vocabulary")
}

/// The things on the table.
///
/// # Panics
/// Never.
#[must_use]
pub fn scene() -> Scene {
    let mut scene = Scene::new(1);
    let objects = OBJECTS.iter().map(|p| (Category::OBJECT, p));
    let storages = STORAGES.iter().map(|p| (Category::STORAGE, p));
    for ((category, position), i) in objects.chain(storages).zip(0_u8..) {
        let entity = Entity {
            category,
            option: i % 3,
            position: *position,
            features: heapless::Vec::new(),
        };
        scene.push(entity, &vocabulary()).expect("a sound scene");
    }
    scene
}

/// The gesture of this name.
///
/// # Panics
/// When there is none.
#[must_use]
pub fn stroke(name: &str) -> Gesture {
    let at = NAMES.iter().position(|n| *n == name);
    Gesture::Stroke(u8::try_from(at.expect("a known gesture")).expect("fewer than 256"))
}

/// Which gestures stand for which actions.
#[must_use]
pub fn meanings() -> Meanings {
    let shape = |shape: Shape| Gesture::Shape(shape as u8);
    [
        (shape(Shape::ThumbsUp), PUT),
        (stroke("swipe-right"), PUT),
        (shape(Shape::Pinch), PICK),
        (shape(Shape::Three), PUSH),
        (stroke("wave"), STOP),
        (shape(Shape::Two), STOP),
    ]
    .into_iter()
    .map(|(gesture, action)| Meaning { gesture, action })
    .collect()
}

/// A host that has told a unit all of that. The unit decides on gestures alone.
pub fn ready<W: Wire>(wire: W) -> Host<W> {
    let mut host = Host::new(wire);
    host.hello();
    host.load_vocabulary(&vocabulary());
    host.load_scene(1, &scene());
    host.configure(Configuration {
        expected: 0b1,
        window: Micros::from_millis(60_000),
        ..Configuration::DEFAULT
    });
    host.say(&ToUnit::Meanings(meanings()));
    host.wait_for(|m| (*m == ToHost::Loaded(Loaded::Meanings)).then_some(()));
    host
}

/// The samples of a made-up person who does all that.
#[must_use]
pub fn person(seed: u64, acts: &[Act]) -> Vec<Sample> {
    made_up(seed, Mount::DEFAULT, 0.03, acts, RATE)
}

/// A closed hand.
#[must_use]
pub fn separate() -> Act {
    Act::Show(Shape::Grab)
}
