//! One of every message to a host.

use super::common::*;
use super::to_unit::{HEARTBEAT, HELLO, sentence};
use deictic_core::board::{ToHost, ToUnit};
use deictic_core::category::Category;
use deictic_core::decide::{Decision, Kind, Outcome, Question, Reason};
use deictic_core::gesture::counters::SampleCounters;
use deictic_core::gesture::frame::Side;
use deictic_core::gesture::mapping::{Gesture, MappingError};
use deictic_core::gesture::pointing::MountError;
use deictic_core::gesture::shape::SHAPES;
use deictic_core::gesture::wire::{Sample, encode};
use deictic_core::intent::{Intent, Parameter};
use deictic_core::joint::sensors::SensorError;
use deictic_core::profile::ProfileError;
use deictic_core::protocol::hand::*;
use deictic_core::protocol::link::Counters;
use deictic_core::protocol::message::*;
use deictic_core::scene::SceneError;
use deictic_core::sentence::{LANGUAGE, SentenceError};
use deictic_core::vocabulary::VocabularyError;

fn intent() -> Intent<8> {
    let parameter = |category, option, quantity| Parameter {
        category,
        option,
        quantity,
    };
    Intent {
        action: POUR,
        parameters: [
            parameter(Category::OBJECT, CAN, None),
            parameter(Category::DISTANCE, 0, Some(0.05)),
        ]
        .into_iter()
        .collect(),
    }
}

fn decided(outcome: Outcome<8>, best: Option<Intent<8>>) -> ToHost {
    ToHost::Decision(Decided {
        number: 7,
        vocabulary: 0xdec1_c71c,
        scene: 3,
        modalities: 0b11,
        questions_left: 1,
        decision: Decision { outcome, best },
    })
}

/// Of every message to a host that is about hands.
fn hand_to_host() -> Vec<(&'static str, ToHost)> {
    let guess = |number, p| Guess { number, p };
    let view = HandView {
        hand: Some(Side::Left),
        shapes: [0.125; SHAPES],
        shown: Some(2),
        strokes: [guess(5, 0.75), guess(23, 0.125)].into_iter().collect(),
        no_stroke: 0.125,
        pointed: [guess(1, 0.5), guess(0, 0.25)].into_iter().collect(),
        nothing: 0.25,
        words: [Glimpse {
            category: Category::ACTION,
            option: PUT,
            likelihood: 0.9,
        }]
        .into_iter()
        .collect(),
    };
    let samples = SampleCounters {
        used: 1,
        hurried: 2,
        backwards: 3,
        other_hand: 4,
        shapeless: 5,
        unsound: 6,
        damaged: 7,
        foreign: 8,
        unready: 9,
        silences: 10,
    };
    let ToUnit::Sentence(shown) = sentence(Some(7)) else {
        unreachable!("a sentence is one")
    };
    let statistics = HandStatistics {
        samples,
        learned: 64,
    };
    let whole = WhyWhole {
        number: 7,
        posterior: 0.75,
        confidence: 1.5,
        cut: Some(3.0),
    };
    vec![
        ("showing", ToHost::Showing(true)),
        ("shown", ToHost::Shown(shown)),
        ("hand-view", ToHost::Hand(view)),
        ("hand-statistics", ToHost::HandStatistics(statistics)),
        ("challenge", ToHost::Challenge(0x0102_0304_0506_0708)),
        ("proven", ToHost::Proven),
        (
            "relayed",
            ToHost::Sample(encode(&Sample::Nothing(5)).unwrap().into_iter().collect()),
        ),
        ("why-whole", ToHost::WhyWhole(whole)),
        (
            "withheld",
            ToHost::Withheld(Withheld {
                modalities: 0b1,
                confirms: true,
            }),
        ),
    ]
}

/// One of every message to a host, with every part of it in use.
pub fn to_host() -> Vec<(&'static str, ToHost)> {
    let link = Counters {
        received: 1,
        sent: 2,
        malformed: 3,
        corrupt: 4,
        oversized: 5,
        undecodable: 6,
        duplicated: 7,
        reordered: 8,
        missed: 9,
        unsent: 10,
        unauthentic: 11,
    };
    let three = |a: f32| [a, 0.5, 1.0].into_iter().collect();
    let question = Question {
        kind: Kind::Which,
        action: Some(POUR),
        category: Category::OBJECT,
        reason: Reason::Infeasible,
        candidates: [CAN, BOX].into_iter().collect(),
    };
    let confirm = Question {
        kind: Kind::Confirm,
        ..question.clone()
    };
    let why = Why {
        number: 7,
        category: Category::STORAGE,
        present: 1.0,
        merged: three(0.1),
        h: three(0.2),
        entropy: 0.9,
        threshold: 0.8,
        clear: 0b100,
    };
    let why_actions = WhyActions {
        number: 7,
        heard: three(0.1),
        alpha: three(0.2),
        beta: three(0.3),
    };
    let statistics = Statistics {
        link,
        executes: 1,
        asks: 2,
        repeats: 3,
        faults: 4,
    };
    let mut samples = vec![
        ("unit hello", ToHost::Hello(HELLO)),
        ("unit heartbeat", ToHost::Heartbeat(HEARTBEAT)),
        (
            "execute",
            decided(Outcome::Execute(intent()), Some(intent())),
        ),
        ("confirm", decided(Outcome::Ask(confirm), Some(intent()))),
        ("ask", decided(Outcome::Ask(question), Some(intent()))),
        ("repeat", decided(Outcome::Repeat, None)),
        ("give-up", decided(Outcome::GiveUp, Some(intent()))),
        ("why", ToHost::Why(why)),
        ("why-actions", ToHost::WhyActions(why_actions)),
        ("statistics", ToHost::Statistics(statistics)),
    ];
    for (name, what) in [
        ("loaded-vocabulary", Loaded::Vocabulary(0xdec1_c71c)),
        ("loaded-scene", Loaded::Scene(3)),
        ("loaded-configuration", Loaded::Configuration),
        ("loaded-meanings", Loaded::Meanings),
        ("loaded-hand", Loaded::Hand),
        ("loaded-templates", Loaded::Templates(64)),
        (
            "loaded-sensor",
            Loaded::Sensor {
                modality: LANGUAGE,
                category: Category::OBJECT,
            },
        ),
    ] {
        samples.push((name, ToHost::Loaded(what)));
    }
    samples.extend(hand_to_host());
    let error = SentenceError::BadLikelihood { word: 1 };
    for (name, fault) in [
        (
            "fault-schema",
            Fault::Schema {
                unit: (1, 2),
                host: (3, 4),
            },
        ),
        ("fault-no-hello", Fault::NoHello),
        ("fault-no-vocabulary", Fault::NoVocabulary),
        ("fault-no-scene", Fault::NoScene),
        (
            "fault-part-out-of-order",
            Fault::PartOutOfOrder {
                expected: 4,
                got: 8,
            },
        ),
        ("fault-old-scene", Fault::OldScene { held: 3, got: 2 }),
        (
            "fault-vocabulary",
            Fault::Vocabulary(VocabularyError::BadStop),
        ),
        (
            "fault-scene",
            Fault::Scene(SceneError::Duplicate { entity: 2 }),
        ),
        (
            "fault-sentence",
            Fault::Sentence {
                modality: LANGUAGE,
                error,
            },
        ),
        (
            "fault-configuration",
            Fault::Configuration(ProfileError::FixedThresholds),
        ),
        ("fault-no-question", Fault::NoQuestion { decision: 6 }),
        ("fault-answer", Fault::Answer { expected: 2 }),
        ("fault-host-lost", Fault::HostLost),
        ("fault-not-proven", Fault::NotProven),
        (
            "fault-sensor",
            Fault::Sensor(SensorError::TooLarge { capacity: 512 }),
        ),
        (
            "fault-meaning",
            Fault::Hand(HandFault::Meaning(MappingError::Reserved(Gesture::Shape(
                0,
            )))),
        ),
        (
            "fault-mount",
            Fault::Hand(HandFault::Mount(MountError::Origin)),
        ),
        ("fault-aim", Fault::Hand(HandFault::Aim)),
        (
            "fault-templates",
            Fault::Hand(HandFault::TooManyTemplates { capacity: 64 }),
        ),
        (
            "fault-template",
            Fault::Hand(HandFault::Template { template: 2 }),
        ),
        ("fault-scale", Fault::Hand(HandFault::Scale)),
        ("fault-sensor-lost", Fault::Hand(HandFault::SensorLost)),
    ] {
        samples.push((name, ToHost::Fault(fault)));
    }
    samples
}
