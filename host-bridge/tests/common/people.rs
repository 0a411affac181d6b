//! A table that made-up people gesture at, and what the unit's hand reader makes of them.

use deictic::hand::session::{Act, Session};
use deictic_core::board::{CATEGORIES, OPTIONS, Scene, Sentence, Vocabulary, WORDS};
use deictic_core::category::{Category, CategorySet};
use deictic_core::gesture::context::{Context, Event};
use deictic_core::gesture::mapping::{Gesture, Mapping};
use deictic_core::gesture::pointing::{Aim, Mount};
use deictic_core::gesture::reader::HandReader;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::stroke::Templates;
use deictic_core::gesture::stroke_table::NAMES;
use deictic_core::gesture::wire::Sample;
use deictic_core::scene::Entity;
use deictic_core::time::Micros;
use deictic_core::vocabulary::{Action, Signature};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

pub type Reader = HandReader<OPTIONS, CATEGORIES, WORDS>;

/// What a sample led to, and what was said by then.
pub type Happened = (Event, Option<Sentence>);

/// stop, put-into, pick, push.
pub const STOP: usize = 0;
pub const PUT: usize = 1;
pub const PICK: usize = 2;
pub const PUSH: usize = 3;

/// Three objects and two storages on a table behind the sensor, seen from the person.
pub const OBJECTS: [[f32; 3]; 3] = [[-0.45, -0.25, 0.05], [-0.5, 0.02, 0.05], [-0.45, 0.3, 0.05]];
pub const STORAGES: [[f32; 3]; 2] = [[-0.75, -0.45, 0.1], [-0.75, 0.5, 0.1]];

pub struct Bench {
    pub vocabulary: Vocabulary,
    pub scene: Scene,
    pub mapping: Mapping,
}

pub fn stroke(name: &str) -> Gesture {
    let at = NAMES.iter().position(|n| *n == name);
    Gesture::Stroke(at.map_or(u8::MAX, |at| at as u8))
}

impl Bench {
    pub fn new() -> Self {
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
        let vocabulary = Vocabulary::new(&actions, &[3, 2], 0, Some(STOP as u8), 1).unwrap();
        let mut scene = Scene::new(1);
        let objects = OBJECTS.iter().map(|p| (Category::OBJECT, p));
        let storages = STORAGES.iter().map(|p| (Category::STORAGE, p));
        for (i, (category, position)) in objects.chain(storages).enumerate() {
            let entity = Entity {
                category,
                option: (i % 3) as u8,
                position: *position,
                features: heapless::Vec::new(),
            };
            scene.push(entity, &vocabulary).unwrap();
        }
        let mut mapping = Mapping::new();
        for (gesture, action) in [
            (stroke("swipe-right"), PUT),
            (Gesture::Shape(Shape::ThumbsUp as u8), PUT),
            (Gesture::Shape(Shape::Pinch as u8), PICK),
            (Gesture::Shape(Shape::Three as u8), PUSH),
            (stroke("wave"), STOP),
            (Gesture::Shape(Shape::Two as u8), STOP),
        ] {
            mapping.set(gesture, action as u8, actions.len()).unwrap();
        }
        Self {
            vocabulary,
            scene,
            mapping,
        }
    }

    pub fn read(&self, reader: &mut Reader, samples: &[Sample]) -> Vec<Happened> {
        let context = Context {
            vocabulary: &self.vocabulary,
            scene: &self.scene,
            mapping: &self.mapping,
            templates: Templates::KNOWN,
            mount: &Mount::DEFAULT,
            aim: &Aim::DEFAULT,
        };
        let mut events = Vec::new();
        for (sample, i) in samples.iter().zip(0..) {
            let Some(event) = reader.take(Micros(i * 9_000), sample, &context) else {
                continue;
            };
            let said = matches!(event, Event::Said | Event::Stop).then(|| reader.said().clone());
            events.push((event, said));
        }
        events
    }

    /// What a session says in the end.
    pub fn said(&self, acts: &[Act], seed: u64) -> Option<Sentence> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let samples = Session::new(Mount::DEFAULT, 0.03, &mut rng).perform(acts, 110.0);
        let events = self.read(&mut Reader::new(), &samples);
        events.into_iter().rev().find_map(|event| match event {
            (Event::Said, said) => said,
            _ => None,
        })
    }
}

pub fn separate() -> Act {
    Act::Show(Shape::Grab)
}

/// The category and likeliest option of every word.
pub fn words(sentence: &Sentence) -> Vec<(Option<Category>, usize)> {
    let best = |likelihoods: &[f32]| deictic_core::math::argmax(likelihoods).unwrap_or(usize::MAX);
    let words = sentence.words().iter();
    words
        .map(|w| (w.category(), best(w.likelihoods())))
        .collect()
}

/// Holds that 95 of 100 people's sessions say this.
pub fn holds(acts: &[Act], expected: &[(Category, usize)]) {
    let bench = Bench::new();
    let expected: Vec<_> = expected.iter().map(|(c, o)| (Some(*c), *o)).collect();
    let right = (1_000..1_100).filter(|seed| {
        let said = bench.said(acts, *seed);
        said.is_some_and(|s| s.check(&bench.vocabulary).is_ok() && words(&s) == expected)
    });
    let right = right.count();
    assert!(right >= 95, "{right} of 100 for {acts:?}");
}

pub fn object(option: usize) -> (Category, usize) {
    (Category::OBJECT, option)
}

pub fn storage(option: usize) -> (Category, usize) {
    (Category::STORAGE, option)
}

pub fn action(option: usize) -> (Category, usize) {
    (Category::ACTION, option)
}
