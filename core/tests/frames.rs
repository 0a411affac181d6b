//! The bits of every message, held to `tests/expected/frames-v1.txt`, and the digest of them that
//! both ends exchange. `BLESS=1 cargo test -p deictic-core --test frames` writes the file anew.

mod common;

use common::*;
use deictic_core::board::{ToHost, ToUnit, Word};
use deictic_core::category::Category;
use deictic_core::decide::{Decision, Kind, Outcome, Question, Reason};
use deictic_core::gesture::counters::SampleCounters;
use deictic_core::gesture::frame::Side;
use deictic_core::gesture::mapping::{Gesture, MappingError};
use deictic_core::gesture::pointing::MountError;
use deictic_core::gesture::shape::SHAPES;
use deictic_core::gesture::stroke::Template;
use deictic_core::gesture::stroke_table::SCALE;
use deictic_core::gesture::wire::{Sample, encode};
use deictic_core::intent::{Intent, Parameter};
use deictic_core::joint::sensors::SensorError;
use deictic_core::profile::{Profile, ProfileError, Threshold};
use deictic_core::protocol::hand::*;
use deictic_core::protocol::link::{Counters, Link, Opening};
use deictic_core::protocol::message::*;
use deictic_core::protocol::seal::TAG;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::scene::SceneError;
use deictic_core::sentence::{GESTURE, LANGUAGE, SentenceError};
use deictic_core::time::Micros;
use deictic_core::vocabulary::VocabularyError;
use serde::{Serialize, de::DeserializeOwned};

const GOLDEN: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../tests/expected/frames-v1.txt"
);

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

fn sentence(answers: Option<u32>) -> ToUnit {
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
fn to_unit() -> Vec<(&'static str, ToUnit)> {
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
    ]
}

/// One of every message to a host, with every part of it in use.
fn to_host() -> Vec<(&'static str, ToHost)> {
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

const HELLO: Hello = Hello {
    version: 1,
    schema: 0x0102_0304,
    boot: 5,
    capacities: deictic_core::board::Unit::capacities(),
};

const HEARTBEAT: Heartbeat = Heartbeat {
    now: Micros(1_000_000),
    vocabulary: 0xdec1_c71c,
    scene: 3,
};

fn frame(message: &(impl Serialize + Opening)) -> Vec<u8> {
    let mut link = Link::<256>::new();
    let mut out = Outbox::<300>::new();
    assert!(link.send(message, &mut out), "a message does not fit");
    // A seal takes room for its tag in the receiver's buffer; stuffing adds two bytes and one for every 254.
    assert!(out.waiting().len() <= 256 - TAG, "no room for a tag");
    out.waiting().to_vec()
}

fn read<M: DeserializeOwned + Opening>(bytes: &[u8]) -> Option<M> {
    let mut link = Link::<256>::new();
    bytes
        .iter()
        .fold(None, |got, b| link.receive(*b).map(|r| r.message).or(got))
}

#[test]
fn every_message_has_its_golden_bits() {
    let mut text = String::new();
    let mut add = |name: &str, frame: Vec<u8>| {
        let hex: String = frame.iter().map(|b| format!("{b:02x}")).collect();
        text += &format!("{name} {hex}\n");
    };
    for (name, message) in to_unit() {
        add(name, frame(&message));
    }
    for (name, message) in to_host() {
        add(name, frame(&message));
    }
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(GOLDEN, &text).expect("the golden file can be written");
    }
    let golden = std::fs::read_to_string(GOLDEN).expect("tests/expected/frames-v1.txt is there");
    for (ours, theirs) in text.lines().zip(golden.lines()) {
        assert_eq!(
            ours, theirs,
            "a message has changed its form: raise VERSION, then bless"
        );
    }
    assert_eq!(text.lines().count(), golden.lines().count());
    let digest = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(golden.as_bytes());
    assert_eq!(SCHEMA, digest, "SCHEMA must be {digest:#010x}");
    assert_eq!(VERSION, 1);
}

#[test]
fn every_golden_frame_is_read_back_by_its_size_of_build_and_a_larger_one() {
    for (name, message) in to_unit() {
        let bytes = frame(&message);
        assert_eq!(read::<ToUnit>(&bytes), Some(message), "{name}");
        assert!(
            read::<deictic_core::large::ToUnit>(&bytes).is_some(),
            "{name}"
        );
    }
    for (name, message) in to_host() {
        let bytes = frame(&message);
        assert_eq!(read::<ToHost>(&bytes), Some(message), "{name}");
        assert!(
            read::<deictic_core::large::ToHost>(&bytes).is_some(),
            "{name}"
        );
    }
}

#[test]
fn the_largest_messages_fit_a_boards_frame() {
    let full = Word::new(&[0.125; 8], &[1.0; 16])
        .unwrap()
        .with_quantity(1.0);
    let words = [full.clone(), full].into_iter().collect();
    frame(&ToUnit::Sentence(SentencePart {
        modality: LANGUAGE,
        answers: Some(u32::MAX),
        total: u8::MAX,
        first: u8::MAX,
        words,
    }));
    let all = || [1.0; 16].into_iter().collect();
    frame(&ToHost::WhyActions(WhyActions {
        number: u32::MAX,
        heard: all(),
        alpha: all(),
        beta: all(),
    }));
    let all = || {
        let guess = |number| Guess { number, p: 1.0 };
        (0..8).map(guess).collect()
    };
    let glimpse = Glimpse {
        category: Category::STORAGE,
        option: u8::MAX,
        likelihood: 1.0,
    };
    frame(&ToHost::Hand(HandView {
        hand: Some(Side::Right),
        shown: Some(8),
        strokes: all(),
        pointed: all(),
        words: core::iter::repeat_n(glimpse, 8).collect(),
        ..HandView::default()
    }));
    let gesture = Gesture::Stroke(u8::MAX);
    let action = u8::MAX;
    let meanings = core::iter::repeat_n(Meaning { gesture, action }, MEANINGS);
    frame(&ToUnit::Meanings(meanings.collect()));
}
