//! Everything that can go wrong between a unit and its host: each is answered with a fault of its own, and changes nothing.

#[path = "common/bench.rs"]
mod bench;
mod common;

use bench::*;
use common::*;
use deictic_core::board::{Sentence, ToHost, ToUnit, Unit, Word};
use deictic_core::category::Category;
use deictic_core::protocol::link::Link;
use deictic_core::protocol::message::*;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::sentence::{GESTURE, LANGUAGE, SentenceError};
use deictic_core::time::Micros;
use deictic_core::unit::HOST_LOST;

fn said() -> Sentence {
    command(LANGUAGE, PUT, Some(CAN), Some(DRAWER))
}

fn shown() -> Sentence {
    command(GESTURE, PUT, Some(CAN), Some(DRAWER))
}

#[test]
fn another_schema_is_named_and_nothing_is_done() {
    let mut bench = Bench::new();
    let capacities = Unit::capacities();
    let old = Hello {
        version: 0,
        schema: 7,
        boot: 1,
        capacities,
    };
    let heard = bench.say(&ToUnit::Hello(old));
    let fault = Fault::Schema {
        unit: (VERSION, SCHEMA),
        host: (0, 7),
    };
    assert_eq!(faults(&heard), [fault]);
    assert_eq!(faults(&bench.say(&ToUnit::AskStatistics)), [Fault::NoHello]);
}

#[test]
fn words_before_their_time_are_refused() {
    let mut bench = Bench::new();
    assert_eq!(faults(&bench.say(&scene_parts(1)[0])), [Fault::NoHello]);
    bench.say(&hello());
    assert_eq!(
        faults(&bench.say(&scene_parts(1)[0])),
        [Fault::NoVocabulary]
    );
    assert_eq!(faults(&bench.tell(&said())), [Fault::NoVocabulary]);
    for part in vocabulary_parts() {
        bench.say(&part);
    }
    assert_eq!(faults(&bench.tell(&said())), [Fault::NoScene]);
}

#[test]
fn parts_out_of_order_leave_the_old_in_force() {
    let mut bench = Bench::ready();
    let parts = vocabulary_parts();
    bench.say(&parts[0]);
    let fault = Fault::PartOutOfOrder {
        expected: 4,
        got: 8,
    };
    assert_eq!(faults(&bench.say(&parts[2])), [fault]);
    bench.decision(said());
    assert!(bench.decision(shown()).is_some());
    // From the first part on it can be sent again.
    let heard: Vec<ToHost> = parts.iter().flat_map(|p| bench.say(p)).collect();
    assert_eq!(heard, [ToHost::Loaded(Loaded::Vocabulary(0xdec1_c71c))]);
}

#[test]
fn a_scene_that_was_begun_under_another_vocabulary_is_begun_anew() {
    let mut bench = Bench::ready();
    let parts = scene_parts(9);
    assert!(faults(&bench.say(&parts[0])).is_empty());
    for part in vocabulary_parts() {
        assert!(faults(&bench.say(&part)).is_empty());
    }
    // Its first things were held against the vocabulary before.
    let heard = bench.say(&parts[1]);
    assert!(
        matches!(
            faults(&heard)[..],
            [Fault::PartOutOfOrder { expected: 0, .. }]
        ),
        "{heard:?}"
    );
    let heard: Vec<_> = parts.iter().flat_map(|part| bench.say(part)).collect();
    assert!(
        heard.contains(&ToHost::Loaded(Loaded::Scene(9))),
        "{heard:?}"
    );
}

#[test]
fn a_scene_that_is_not_newer_is_refused() {
    let mut bench = Bench::ready();
    let heard = bench.say(&scene_parts(1)[0]);
    assert_eq!(faults(&heard), [Fault::OldScene { held: 1, got: 1 }]);
    assert_eq!(
        bench.all(scene_parts(2)),
        [ToHost::Loaded(Loaded::Scene(2))]
    );
    let empty = ScenePart {
        version: 3,
        total: 0,
        first: 0,
        entities: heapless::Vec::new(),
    };
    assert_eq!(
        bench.say(&ToUnit::Scene(empty)),
        [ToHost::Loaded(Loaded::Scene(3))]
    );
    bench.decision(said());
    let decided = bench.decision(shown()).unwrap();
    assert_eq!((decided.scene, executed(&decided.decision)), (3, None));
}

#[test]
fn a_sentence_that_cannot_be_is_refused_with_its_place() {
    let mut bench = Bench::ready();
    let bad = Word::certain(Category::OBJECT, &[f32::NAN; 5]).unwrap();
    let heard = bench.tell(&sentence(LANGUAGE, &[Word::ABSENT, bad]));
    let error = SentenceError::BadLikelihood { word: 1 };
    assert_eq!(
        faults(&heard),
        [Fault::Sentence {
            modality: LANGUAGE,
            error
        }]
    );
    let heard = bench.tell(&command(9, PICK, Some(CAN), None));
    let error = SentenceError::UnknownModality { capacity: 4 };
    assert_eq!(faults(&heard), [Fault::Sentence { modality: 9, error }]);
}

#[test]
fn a_sentence_that_lost_a_part_is_refused_and_can_be_said_again() {
    let mut bench = Bench::ready();
    let parts = sentence_parts(&said(), None);
    let fault = Fault::PartOutOfOrder {
        expected: 0,
        got: 2,
    };
    assert_eq!(faults(&bench.say(&parts[1])), [fault]);
    bench.say(&parts[0]);
    let other = sentence_parts(&shown(), None);
    assert_eq!(faults(&bench.say(&other[1])), [fault]);
    assert_eq!(bench.decision(said()), None);
    assert!(bench.decision(shown()).is_some());
}

#[test]
fn a_unit_does_not_take_what_units_say() {
    let mut bench = Bench::ready();
    let mut out = Outbox::<64>::new();
    bench
        .link
        .send(&ToHost::Loaded(Loaded::Configuration), &mut out);
    assert!(bench.bytes(out.waiting()).is_empty());
    assert_eq!(bench.unit.statistics().link.undecodable, 1);
}

#[test]
fn damaged_frames_are_counted_and_the_next_sound_one_is_taken() {
    let mut bench = Bench::ready();
    // A command of two words, which is one frame.
    let pick = command(LANGUAGE, PICK, Some(CAN), None);
    let good = bench.frame(&sentence_parts(&pick, None)[0]);
    for at in 0..good.len() - 1 {
        let mut bad = good.clone();
        bad[at] ^= 0x10;
        assert!(bench.bytes(&bad).is_empty(), "byte {at}");
        let mut cut = good[..at].to_vec();
        cut.push(0);
        assert!(bench.bytes(&cut).is_empty(), "cut at {at}");
    }
    assert!(bench.bytes(&[0x55; 3000]).is_empty());
    bench.bytes(&[0]);
    bench.bytes(&good);
    assert!(bench.decision(shown()).is_some());
    let link = bench.unit.statistics().link;
    assert!(link.corrupt > 0 && link.malformed > 0 && link.oversized == 1);
}

#[test]
fn duplicated_and_reordered_frames_are_not_taken_twice() {
    let mut bench = Bench::ready();
    let pick = |modality| sentence_parts(&command(modality, PICK, Some(CAN), None), None);
    let first = bench.frame(&pick(LANGUAGE)[0]);
    let second = bench.frame(&pick(GESTURE)[0]);
    assert!(bench.bytes(&first).is_empty());
    assert!(bench.bytes(&first).is_empty());
    assert_eq!(bench.bytes(&second).len(), 1);
    assert!(bench.bytes(&second).is_empty());
    assert!(bench.bytes(&first).is_empty());
    assert!(bench.wait(400).is_empty());
    let link = bench.unit.statistics().link;
    assert_eq!((link.duplicated, link.reordered), (2, 1));
    assert_eq!(bench.unit.statistics().executes, 1);
}

#[test]
fn a_silent_host_is_given_up_and_what_waited_is_forgotten() {
    let mut bench = Bench::ready();
    let configuration = Configuration {
        window: Micros::from_millis(10_000),
        ..Configuration::DEFAULT
    };
    bench.say(&ToUnit::Configure(configuration));
    bench.decision(said());
    let heard = bench.wait(HOST_LOST.0 / 1_000);
    assert_eq!(faults(&heard), [Fault::HostLost]);
    assert!(bench.wait(20_000).is_empty());
    assert_eq!(bench.unit.next_wake(), Micros::NEVER);
    assert_eq!(faults(&bench.say(&ToUnit::AskStatistics)), [Fault::NoHello]);
}

#[test]
fn a_new_hello_empties_the_unit() {
    let mut bench = Bench::ready();
    bench.decision(said());
    bench.link = Link::new();
    assert!(matches!(
        bench.say(&hello())[..],
        [ToHost::Hello(Hello { boot: 42, .. })]
    ));
    assert_eq!(faults(&bench.tell(&shown())), [Fault::NoVocabulary]);
}

#[test]
fn heartbeats_tell_what_is_held() {
    let mut bench = Bench::ready();
    let heard = bench.wait(500);
    let beat = Heartbeat {
        now: bench.now,
        vocabulary: 0xdec1_c71c,
        scene: 1,
    };
    assert_eq!(heard, [ToHost::Heartbeat(beat)]);
    assert!(bench.wait(499).is_empty());
    assert_eq!(bench.wait(1).len(), 1);
}

#[test]
fn too_much_is_refused_by_capacity() {
    let mut bench = Bench::new();
    bench.say(&hello());
    let part = |first: u8| {
        ToUnit::Vocabulary(VocabularyPart {
            fingerprint: 1,
            parameters: heapless::Vec::new(),
            features: 0,
            stop: None,
            total: 20,
            first,
            actions: [Default::default(); ACTIONS_PART].into_iter().collect(),
        })
    };
    let heard: Vec<ToHost> = (0..5).flat_map(|i| bench.say(&part(i * 4))).collect();
    let error = deictic_core::vocabulary::VocabularyError::TooManyActions { capacity: 16 };
    assert_eq!(faults(&heard), [Fault::Vocabulary(error)]);
}
