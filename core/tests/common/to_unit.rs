//! One of every message to a unit.

use super::common::*;
use deictic_core::board::{ToUnit, Word};
use deictic_core::category::Category;
use deictic_core::gesture::mapping::Gesture;
use deictic_core::gesture::stroke_table::SCALE;
use deictic_core::gesture::template::Template;
use deictic_core::gesture::wire::{Sample, encode};
use deictic_core::profile::{Profile, Threshold};
use deictic_core::protocol::hand::*;
use deictic_core::protocol::message::*;
use deictic_core::sentence::{GESTURE, LANGUAGE};
use deictic_core::time::Micros;

pub fn sentence(answers: Option<u32>) -> ToUnit {
    let uncertain = Word::new(&[0.1, 0.6, 0.3], &[0.0, 0.25, 0.5, 0.75, 1.0]).unwrap();
    let far = Word::certain(Category::DISTANCE, &[1.0])
        .unwrap()
        .with_quantity(0.05);
    let words = [uncertain, far].into_iter().collect();
    ToUnit::Sentence(SentencePart {
        modality: LANGUAGE,
        answers,
        total: 4,
        first: 2,
        words,
    })
}

/// One of every message to a unit, with every part of it in use.
pub fn to_unit() -> Vec<(&'static str, ToUnit)> {
    let actions = vocabulary().actions()[5..].iter().copied().collect();
    let fixed = Profile {
        threshold: Threshold::FIXED,
        ..Profile::PAPER
    };
    let vocabulary = VocabularyPart {
        fingerprint: 0xdec1_c71c,
        parameters: [5, 4, 1].into_iter().collect(),
        features: 10,
        stop: Some(STOP),
        total: 9,
        first: 5,
        actions,
    };
    let entities = things()[..2].iter().cloned().collect();
    let scene = ScenePart {
        version: 3,
        total: 4,
        first: 0,
        entities,
    };
    let configuration = Configuration {
        profile: fixed,
        ..Configuration::DEFAULT
    };
    let mut samples = vec![
        ("host hello", ToUnit::Hello(HELLO)),
        ("host heartbeat", ToUnit::Heartbeat(HEARTBEAT)),
        ("vocabulary", ToUnit::Vocabulary(vocabulary)),
        ("scene", ToUnit::Scene(scene)),
        ("configure", ToUnit::Configure(configuration)),
        ("sentence", sentence(None)),
        ("answer", sentence(Some(7))),
        ("ask-statistics", ToUnit::AskStatistics),
        (
            "yes-or-no",
            ToUnit::Answer(Answer {
                question: 7,
                likelihoods: [1.0, 0.25].into_iter().collect(),
            }),
        ),
    ];
    samples.extend(hand_to_unit());
    for (name, state) in [
        ("robot-running", RobotState::Running(40)),
        ("robot-done", RobotState::Done),
        ("robot-refused", RobotState::Refused),
        ("robot-stopped", RobotState::Stopped),
        ("robot-failed", RobotState::Failed),
    ] {
        samples.push((name, ToUnit::Robot(RobotStatus { decision: 7, state })));
    }
    samples
}

fn template(gesture: u8) -> Template {
    Template {
        gesture,
        tolerance: 24,
        direct: 250,
        points: std::array::from_fn(|i| [i as i8, -(i as i8), i8::MIN]),
        ln_length: 5.5,
        ln_seconds: -0.5,
    }
}

/// Of every message to a unit that is about hands.
fn hand_to_unit() -> Vec<(&'static str, ToUnit)> {
    let meaning = |gesture, action| Meaning { gesture, action };
    let meanings = [
        meaning(Gesture::Shape(7), PUT),
        meaning(Gesture::Stroke(23), STOP),
    ];
    let templates = TemplatesPart {
        total: 64,
        first: 3,
        known: true,
        scale: SCALE,
        templates: [template(8), template(9), template(23)]
            .into_iter()
            .collect(),
    };
    let sample = encode(&Sample::Nothing(0x0102_0304)).unwrap();
    vec![
        (
            "sample",
            ToUnit::Sample(SampleBytes::from_slice(&sample).unwrap()),
        ),
        ("meanings", ToUnit::Meanings(meanings.into_iter().collect())),
        ("hand", ToUnit::Hand(HandSettings::DEFAULT)),
        ("templates", ToUnit::Templates(templates)),
        ("ask-hand", ToUnit::AskHand),
        ("relay", ToUnit::Relay(true)),
        ("forbid", ToUnit::Forbid(LANGUAGE)),
        (
            "prove",
            ToUnit::Prove(Proof {
                nonce: 0x0102_0304_0506_0708,
                proof: [9, 8, 7, 6, 5, 4, 3, 2],
            }),
        ),
        (
            "sensor",
            ToUnit::Sensor(SensorPart::Row(SensorRow {
                modality: LANGUAGE,
                category: Category::OBJECT,
                meant: 1,
                likelihoods: [26, 255, 128].into_iter().collect(),
            })),
        ),
        (
            "sensor-likelihoods",
            ToUnit::Sensor(SensorPart::Likelihoods {
                modality: GESTURE,
                category: Category::ACTION,
            }),
        ),
    ]
}

pub const HELLO: Hello = Hello {
    version: 1,
    schema: 0x0102_0304,
    boot: 5,
    capacities: deictic_core::board::Unit::capacities(),
};

pub const HEARTBEAT: Heartbeat = Heartbeat {
    now: Micros(1_000_000),
    vocabulary: 0xdec1_c71c,
    scene: 3,
};
