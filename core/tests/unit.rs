//! A whole unit over its link: loading, pairing, questions, stops, and everything that can go wrong
//! between two ends.

#[path = "common/bench.rs"]
mod bench;
mod common;

use bench::*;
use common::*;
use deictic_core::board::{Sentence, ToHost, ToUnit, Unit, Word};
use deictic_core::category::Category;
use deictic_core::decide::{Outcome, Reason};
use deictic_core::protocol::link::Link;
use deictic_core::protocol::message::*;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::sentence::{GESTURE, LANGUAGE, SentenceError};
use deictic_core::time::Micros;
use deictic_core::unit::{HEARTBEAT, HOST_LOST};

fn said() -> Sentence {
    command(LANGUAGE, PUT, Some(CAN), Some(DRAWER))
}

fn shown() -> Sentence {
    command(GESTURE, PUT, Some(CAN), Some(DRAWER))
}

#[test]
fn two_modalities_are_decided_as_soon_as_both_are_there() {
    let mut bench = Bench::ready();
    assert_eq!(bench.decision(said()), None);
    let decided = bench.decision(shown()).unwrap();
    assert_eq!(
        (decided.number, decided.scene, decided.modalities),
        (1, 1, 0b11)
    );
    assert_eq!(
        executed(&decided.decision),
        Some((PUT, Some(CAN), Some(DRAWER)))
    );
}

#[test]
fn a_unit_that_is_restarted_is_as_new() {
    let conversation = |bench: &mut Bench| {
        let mut heard = bench.say(&hello());
        heard.extend(bench.all(vocabulary_parts()));
        heard.extend(bench.all(scene_parts(1)));
        heard.extend(bench.tell(&said()));
        heard.extend(bench.tell(&shown()));
        heard.extend(bench.say(&ToUnit::AskStatistics));
        heard
    };
    let mut used = Bench::ready();
    used.tell(&said());
    used.tell(&shown());
    used.bytes(&[1, 2, 3]);
    used.unit.restart(42);
    let mut bench = Bench {
        unit: used.unit,
        ..Bench::new()
    };
    let mut fresh = Bench::new();
    let again = conversation(&mut bench);
    assert_eq!(
        format!("{again:?}"),
        format!("{:?}", conversation(&mut fresh))
    );
    assert_eq!(again.len(), 5);
}

#[test]
fn one_modality_is_decided_when_the_window_closes() {
    let mut bench = Bench::ready();
    assert_eq!(bench.decision(said()), None);
    assert!(
        !bench
            .wait(400)
            .iter()
            .any(|m| matches!(m, ToHost::Decision(_)))
    );
    let wake = bench.unit.next_wake();
    assert!(wake <= bench.now.after(HEARTBEAT));
    let heard = bench.wait(700);
    let decided = heard.iter().find_map(|m| match m {
        ToHost::Decision(d) => Some(d),
        _ => None,
    });
    assert_eq!(decided.unwrap().modalities, 0b10);
}

#[test]
fn the_same_modality_again_begins_a_new_command() {
    let mut bench = Bench::ready();
    assert_eq!(bench.decision(said()), None);
    let first = bench
        .decision(command(LANGUAGE, PICK, Some(CAN), None))
        .unwrap();
    assert_eq!(
        executed(&first.decision),
        Some((PUT, Some(CAN), Some(DRAWER)))
    );
    let second = bench
        .decision(command(GESTURE, PICK, Some(CAN), None))
        .unwrap();
    assert_eq!(executed(&second.decision), Some((PICK, Some(CAN), None)));
    assert_eq!(second.number, 2);
}

#[test]
fn a_bare_stop_is_told_at_once_whatever_waits() {
    let mut bench = Bench::ready();
    assert_eq!(bench.decision(said()), None);
    let stop = bench.decision(command(GESTURE, STOP, None, None)).unwrap();
    assert_eq!(executed(&stop.decision), Some((STOP, None, None)));
    // What waited before the stop is gone.
    assert!(
        !bench
            .wait(1_500)
            .iter()
            .any(|m| matches!(m, ToHost::Decision(_)))
    );
}

#[test]
fn a_stop_among_other_words_stops_a_moving_robot_only() {
    let mut bench = Bench::ready();
    let stop_the_can = || command(LANGUAGE, STOP, Some(CAN), None);
    assert_eq!(bench.decision(stop_the_can()), None);
    bench.wait(1_100);
    let state = RobotState::Running(10);
    bench.say(&ToUnit::Robot(RobotStatus { decision: 1, state }));
    let stop = bench.decision(stop_the_can()).unwrap();
    assert_eq!(executed(&stop.decision), Some((STOP, None, None)));
}

#[test]
fn a_stop_needs_no_scene() {
    let mut bench = Bench::new();
    bench.say(&hello());
    for part in vocabulary_parts() {
        bench.say(&part);
    }
    let stop = bench.decision(command(LANGUAGE, STOP, None, None)).unwrap();
    assert_eq!(executed(&stop.decision), Some((STOP, None, None)));
}

#[test]
fn an_answer_completes_what_was_asked() {
    let mut bench = Bench::ready();
    bench.say(&ToUnit::Configure(Configuration {
        expected: 0b10,
        ..Configuration::DEFAULT
    }));
    let asked = bench.decision(command(LANGUAGE, PICK, None, None)).unwrap();
    let Outcome::Ask(question) = &asked.decision.outcome else {
        panic!("{asked:?}")
    };
    assert_eq!(
        (question.category, question.reason),
        (Category::OBJECT, Reason::Missing)
    );
    let reply = |decision| {
        let sentence = sentence(LANGUAGE, &[word(Category::OBJECT, CAN)]);
        sentence_parts(&sentence, Some(decision))
    };
    let wrong = bench.all(reply(asked.number + 1));
    assert_eq!(
        faults(&wrong),
        [Fault::NoQuestion {
            decision: asked.number + 1
        }]
    );
    let heard = bench.all(reply(asked.number));
    let Some(ToHost::Decision(decided)) = heard.first() else {
        panic!("{heard:?}")
    };
    assert_eq!(executed(&decided.decision), Some((PICK, Some(CAN), None)));
    assert_eq!(decided.modalities, 0b1010);
    // The question is closed.
    let late = bench.all(reply(asked.number));
    assert_eq!(
        faults(&late),
        [Fault::NoQuestion {
            decision: asked.number
        }]
    );
}

#[test]
fn why_is_told_when_wanted() {
    let mut bench = Bench::ready();
    let configuration = Configuration {
        explain: true,
        expected: 0b10,
        ..Configuration::DEFAULT
    };
    bench.say(&ToUnit::Configure(configuration));
    let heard = bench.tell(&said());
    let actions = heard.iter().find_map(|m| match m {
        ToHost::WhyActions(why) => Some(why.alpha.len()),
        _ => None,
    });
    assert_eq!(actions, Some(9));
    let categories = heard.iter().filter(|m| matches!(m, ToHost::Why(_))).count();
    assert_eq!(categories, 3);
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
