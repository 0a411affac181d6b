//! Sessions of made-up people, read by the unit's hand reader.

use deictic::hand::movement::GESTURES;
use deictic::hand::session::{Act, Session};
use deictic_core::board::{CATEGORIES, OPTIONS, Scene, Sentence, Vocabulary, WORDS};
use deictic_core::category::{Category, CategorySet};
use deictic_core::gesture::context::{Context, Event};
use deictic_core::gesture::frame::HandFrame;
use deictic_core::gesture::line::{FRAMED, SensorLine, send};
use deictic_core::gesture::mapping::{Gesture, Mapping};
use deictic_core::gesture::pointing::{Aim, Mount};
use deictic_core::gesture::reader::HandReader;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::stroke::Templates;
use deictic_core::gesture::stroke_table::NAMES;
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::scene::Entity;
use deictic_core::time::Micros;
use deictic_core::vocabulary::{Action, Signature};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

type Reader = HandReader<OPTIONS, CATEGORIES, WORDS>;

/// What a sample led to, and what was said by then.
type Happened = (Event, Option<Sentence>);

/// stop, put-into, pick, push.
const STOP: usize = 0;
const PUT: usize = 1;
const PICK: usize = 2;
const PUSH: usize = 3;

/// Three objects and two storages on a table behind the sensor, seen from the person.
const OBJECTS: [[f32; 3]; 3] = [[-0.45, -0.25, 0.05], [-0.5, 0.02, 0.05], [-0.45, 0.3, 0.05]];
const STORAGES: [[f32; 3]; 2] = [[-0.75, -0.45, 0.1], [-0.75, 0.5, 0.1]];

struct Bench {
    vocabulary: Vocabulary,
    scene: Scene,
    mapping: Mapping,
}

fn stroke(name: &str) -> Gesture {
    let at = NAMES.iter().position(|n| *n == name);
    Gesture::Stroke(at.map_or(u8::MAX, |at| at as u8))
}

impl Bench {
    fn new() -> Self {
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

    fn read(&self, reader: &mut Reader, samples: &[Sample]) -> Vec<Happened> {
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
    fn said(&self, acts: &[Act], seed: u64) -> Option<Sentence> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let samples = Session::new(Mount::DEFAULT, 0.03, &mut rng).perform(acts, 110.0);
        let events = self.read(&mut Reader::new(), &samples);
        events.into_iter().rev().find_map(|event| match event {
            (Event::Said, said) => said,
            _ => None,
        })
    }
}

fn separate() -> Act {
    Act::Show(Shape::Grab)
}

/// The category and likeliest option of every word.
fn words(sentence: &Sentence) -> Vec<(Option<Category>, usize)> {
    let best = |likelihoods: &[f32]| deictic_core::math::argmax(likelihoods).unwrap_or(usize::MAX);
    let words = sentence.words().iter();
    words
        .map(|w| (w.category(), best(w.likelihoods())))
        .collect()
}

/// Holds that 95 of 100 people's sessions say this.
fn holds(acts: &[Act], expected: &[(Category, usize)]) {
    let bench = Bench::new();
    let expected: Vec<_> = expected.iter().map(|(c, o)| (Some(*c), *o)).collect();
    let right = (1_000..1_100).filter(|seed| {
        let said = bench.said(acts, *seed);
        said.is_some_and(|s| s.check(&bench.vocabulary).is_ok() && words(&s) == expected)
    });
    let right = right.count();
    assert!(right >= 95, "{right} of 100 for {acts:?}");
}

fn object(option: usize) -> (Category, usize) {
    (Category::OBJECT, option)
}

fn storage(option: usize) -> (Category, usize) {
    (Category::STORAGE, option)
}

fn action(option: usize) -> (Category, usize) {
    (Category::ACTION, option)
}

#[test]
fn people_show_what_to_do_and_point_at_an_object_and_a_storage() {
    let acts = [
        Act::Show(Shape::ThumbsUp),
        separate(),
        Act::Point(OBJECTS[1]),
        separate(),
        Act::Point(STORAGES[0]),
    ];
    holds(&acts, &[action(PUT), object(1), storage(0)]);
    let acts = [Act::Show(Shape::Pinch), separate(), Act::Point(OBJECTS[1])];
    holds(&acts, &[action(PICK), object(1)]);
}

#[test]
fn people_point_and_then_show_what_to_do() {
    let acts = [Act::Point(OBJECTS[0]), separate(), Act::Show(Shape::Three)];
    holds(&acts, &[object(0), action(PUSH)]);
    let acts = [
        Act::Point(OBJECTS[0]),
        separate(),
        Act::Point(STORAGES[1]),
        separate(),
        Act::Show(Shape::ThumbsUp),
    ];
    holds(&acts, &[object(0), storage(1), action(PUT)]);
}

#[test]
fn people_only_point() {
    let acts = [Act::Point(OBJECTS[0]), separate(), Act::Point(STORAGES[1])];
    holds(&acts, &[object(0), storage(1)]);
}

#[test]
fn people_swipe_and_point() {
    let acts = [
        Act::Move("swipe-right".to_owned()),
        separate(),
        Act::Point(OBJECTS[2]),
        separate(),
        Act::Point(STORAGES[1]),
    ];
    holds(&acts, &[action(PUT), object(2), storage(1)]);
}

#[test]
fn the_stop_gesture_does_not_wait_for_the_hand_to_leave() {
    let bench = Bench::new();
    let mut in_time = 0;
    for seed in 0..40 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let acts = [Act::Point(OBJECTS[0]), separate(), Act::Show(Shape::Two)];
        let samples = Session::new(Mount::DEFAULT, 0.03, &mut rng).perform(&acts, 110.0);
        let events = bench.read(&mut Reader::new(), &samples);
        let stop = events.iter().find_map(|event| match event {
            (Event::Stop, said) => said.as_ref().map(words),
            _ => None,
        });
        in_time += usize::from(stop == Some(vec![(Some(Category::ACTION), STOP)]));
        assert!(
            !events
                .iter()
                .any(|e| matches!(e, (Event::Said, Some(s)) if s.words().len() > 1)),
            "what was said before the stop is void"
        );
    }
    assert!(in_time >= 38, "{in_time} of 40");
}

#[test]
fn a_hand_that_shows_nothing_says_nothing() {
    let bench = Bench::new();
    for seed in 0..20 {
        assert_eq!(bench.said(&[Act::Show(Shape::Five)], seed), None, "{seed}");
    }
}

#[test]
fn frames_over_the_wire_say_the_same() {
    let bench = Bench::new();
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let acts = [Act::Show(Shape::Pinch), separate(), Act::Point(OBJECTS[0])];
    let samples = Session::new(Mount::DEFAULT, 0.03, &mut rng).perform(&acts, 110.0);
    let mut line = SensorLine::new();
    let mut received = Vec::new();
    for sample in &samples {
        let mut out = Outbox::<FRAMED>::new();
        send(sample, &mut out).unwrap();
        received.extend(out.waiting().iter().filter_map(|byte| line.push(*byte)));
    }
    let received: Vec<Sample> = received.into_iter().collect::<Result<_, _>>().unwrap();
    assert_eq!(received.len(), samples.len());
    let direct = bench.read(&mut Reader::new(), &samples);
    let wired = bench.read(&mut Reader::new(), &received);
    assert_eq!(direct.len(), wired.len());
    assert!(matches!(wired.last(), Some((Event::Said, Some(s))) if words(s).len() == 2));
}

#[test]
fn a_sensor_that_stops_in_the_middle_says_nothing() {
    let bench = Bench::new();
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let acts = [Act::Show(Shape::Pinch), separate()];
    let mut samples = Session::new(Mount::DEFAULT, 0.03, &mut rng).perform(&acts, 110.0);
    samples.retain(|sample| matches!(sample, Sample::Hand(_)));
    let mut reader = Reader::new();
    let events = bench.read(&mut reader, &samples);
    assert!(
        events
            .iter()
            .all(|e| matches!(e, (Event::Opened(_) | Event::Closed(_), _)))
    );
    let wake = reader.next_wake();
    assert_eq!(reader.poll(wake), Some(Event::SensorLost));
    assert!(reader.words().is_empty());
    assert_eq!(reader.poll(Micros(u64::MAX)), None);
}

#[test]
fn whatever_the_frames_are_the_reader_survives() {
    let bench = Bench::new();
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let acts = [
        Act::Point(OBJECTS[0]),
        separate(),
        Act::Move(GESTURES[7].to_owned()),
    ];
    let samples = Session::new(Mount::DEFAULT, 0.1, &mut rng).perform(&acts, 110.0);
    let mut spoilt = Vec::new();
    for (i, sample) in samples.iter().enumerate() {
        let Sample::Hand(mut frame) = *sample else {
            spoilt.push(*sample);
            continue;
        };
        match i % 7 {
            0 => frame.fingers[i % 5] = None,
            1 => frame.palm[0] = f32::NAN,
            2 => frame.time = frame.time.wrapping_sub(50_000),
            3 => frame.velocity = [f32::INFINITY; 3],
            4 => {
                frame = HandFrame {
                    time: frame.time,
                    ..HandFrame::default()
                }
            }
            _ => {}
        }
        spoilt.push(Sample::Hand(frame));
    }
    let mut reader = Reader::new();
    for event in bench.read(&mut reader, &spoilt) {
        if let Some(sentence) = event.1 {
            assert_eq!(sentence.check(&bench.vocabulary), Ok(()));
        }
    }
    let counters = reader.counters();
    assert!(
        counters.unsound > 0 && counters.backwards > 0 && counters.shapeless > 0,
        "{counters:?}"
    );
}

#[test]
fn the_reader_fits_the_board() {
    let bytes = size_of::<Reader>();
    assert!(bytes <= 4096, "{bytes}");
}
