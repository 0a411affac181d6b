//! The bits of every message, held to `tests/expected/frames-v1.txt`, and the digest of them that
//! both ends exchange. `BLESS=1 cargo test -p deictic-core --test frames` writes the file anew.

mod common;

use common::*;
use deictic_core::board::{Message, Word};
use deictic_core::category::Category;
use deictic_core::decide::{Decision, Outcome, Question, Reason};
use deictic_core::fuse::FuseError;
use deictic_core::intent::{Intent, Parameter};
use deictic_core::profile::{Profile, Threshold};
use deictic_core::protocol::link::{Counters, Link};
use deictic_core::protocol::message::*;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::scene::SceneError;
use deictic_core::sentence::{LANGUAGE, SentenceError};
use deictic_core::time::Micros;
use deictic_core::vocabulary::VocabularyError;

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

fn decided(outcome: Outcome<8>, best: Option<Intent<8>>) -> Message {
    Message::Decision(Decided {
        number: 7,
        vocabulary: 0xdec1_c71c,
        scene: 3,
        modalities: 0b11,
        decision: Decision { outcome, best },
    })
}

fn sentence_with_everything() -> deictic_core::board::Sentence {
    let uncertain = Word::new(&[0.1, 0.6, 0.3], &[0.0, 0.25, 0.5, 0.75, 1.0]).unwrap();
    let far = Word::certain(Category::DISTANCE, &[1.0])
        .unwrap()
        .with_quantity(0.05);
    sentence(
        LANGUAGE,
        &[word(Category::ACTION, PUT), Word::ABSENT, uncertain, far],
    )
}

/// One of every message, with every part of it in use.
fn samples() -> Vec<(&'static str, Message)> {
    let actions = vocabulary().actions()[..3].iter().copied().collect();
    let counters = Counters {
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
    };
    let three = |a: f32| [a, 0.5, 1.0].into_iter().collect();
    let question = Question {
        category: Category::OBJECT,
        reason: Reason::Infeasible,
        candidates: [CAN, BOX].into_iter().collect(),
    };
    let fixed = Profile {
        threshold: Threshold::FIXED,
        ..Profile::PAPER
    };
    let mut samples = vec![
        (
            "hello",
            Message::Hello(Hello {
                version: 1,
                schema: 0x0102_0304,
                boot: 5,
                capacities: deictic_core::board::Unit::capacities(),
            }),
        ),
        (
            "heartbeat",
            Message::Heartbeat(Heartbeat {
                now: Micros(1_000_000),
                vocabulary: 0xdec1_c71c,
                scene: 3,
            }),
        ),
        (
            "vocabulary",
            Message::Vocabulary(VocabularyPart {
                fingerprint: 0xdec1_c71c,
                parameters: [5, 4, 1].into_iter().collect(),
                features: 10,
                stop: Some(STOP),
                total: 9,
                first: 6,
                actions,
            }),
        ),
        (
            "scene",
            Message::Scene(ScenePart {
                version: 3,
                total: 4,
                first: 0,
                entities: things().into_iter().collect(),
            }),
        ),
        (
            "configure",
            Message::Configure(Configuration {
                profile: fixed,
                ..Configuration::DEFAULT
            }),
        ),
        ("sentence", Message::Sentence(sentence_with_everything())),
        (
            "answer",
            Message::Answer(Answer {
                decision: 7,
                sentence: sentence_with_everything(),
            }),
        ),
        ("ask-statistics", Message::AskStatistics),
        (
            "execute",
            decided(Outcome::Execute(intent()), Some(intent())),
        ),
        ("ask", decided(Outcome::Ask(question), Some(intent()))),
        ("repeat", decided(Outcome::Repeat, None)),
        (
            "why",
            Message::Why(Why {
                number: 7,
                category: Category::STORAGE,
                present: 1.0,
                merged: three(0.1),
                h: three(0.2),
                entropy: 0.9,
                threshold: 0.8,
                clear: 0b100,
            }),
        ),
        (
            "why-actions",
            Message::WhyActions(WhyActions {
                number: 7,
                heard: three(0.1),
                alpha: three(0.2),
                beta: three(0.3),
            }),
        ),
        (
            "statistics",
            Message::Statistics(Statistics {
                link: counters,
                executes: 1,
                asks: 2,
                repeats: 3,
                faults: 4,
            }),
        ),
    ];
    for (name, state) in [
        ("robot-running", RobotState::Running(40)),
        ("robot-done", RobotState::Done),
        ("robot-refused", RobotState::Refused),
        ("robot-stopped", RobotState::Stopped),
        ("robot-failed", RobotState::Failed),
    ] {
        samples.push((name, Message::Robot(RobotStatus { decision: 7, state })));
    }
    for (name, what) in [
        ("loaded-vocabulary", Loaded::Vocabulary(0xdec1_c71c)),
        ("loaded-scene", Loaded::Scene(3)),
        ("loaded-configuration", Loaded::Configuration),
    ] {
        samples.push((name, Message::Loaded(what)));
    }
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
            Fault::Configuration(deictic_core::profile::ProfileError::FixedThresholds),
        ),
        (
            "fault-decision",
            Fault::Decision(FuseError::Sentence {
                modality: LANGUAGE,
                error,
            }),
        ),
        ("fault-no-question", Fault::NoQuestion { decision: 6 }),
        ("fault-not-for-unit", Fault::NotForUnit),
        ("fault-host-lost", Fault::HostLost),
    ] {
        samples.push((name, Message::Fault(fault)));
    }
    samples
}

fn frame(message: &Message) -> Vec<u8> {
    let mut link = Link::<768>::new();
    let mut out = Outbox::<1024>::new();
    assert!(link.send(message, &mut out), "{message:?} does not fit");
    out.waiting().to_vec()
}

#[test]
fn every_message_has_its_golden_bits() {
    let mut text = String::new();
    for (name, message) in samples() {
        let hex: String = frame(&message).iter().map(|b| format!("{b:02x}")).collect();
        text += &format!("{name} {hex}\n");
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
fn every_golden_frame_is_read_back() {
    for (name, message) in samples() {
        let mut link = Link::<768>::new();
        let mut got = None;
        for byte in frame(&message) {
            got = link.receive::<Message>(byte).or(got);
        }
        assert_eq!(got.map(|r| r.message), Some(message), "{name}");
    }
}

#[test]
fn a_larger_build_reads_the_same_frames() {
    for (name, message) in samples() {
        let mut link = deictic_core::large::Link::new();
        let mut got = None;
        for byte in frame(&message) {
            got = link.receive::<deictic_core::large::Message>(byte).or(got);
        }
        assert!(got.is_some(), "{name}");
    }
}
