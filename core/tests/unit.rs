//! A whole unit over its link: loading, pairing, questions and stops.

#[path = "common/bench.rs"]
mod bench;
mod common;

use bench::*;
use common::*;
use deictic_core::board::{Sentence, ToHost, ToUnit};
use deictic_core::category::Category;
use deictic_core::decide::{Outcome, Reason};
use deictic_core::profile::Profile;
use deictic_core::protocol::message::*;
use deictic_core::sentence::{GESTURE, LANGUAGE};
use deictic_core::unit::HEARTBEAT;

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
    assert!(!heard.iter().any(|m| matches!(m, ToHost::WhyWhole(_))));
}

#[test]
fn the_joint_model_tells_how_sure_it_is_and_must_be() {
    let mut bench = Bench::ready();
    let configuration = Configuration {
        explain: true,
        expected: 0b10,
        profile: Profile::JOINT,
        ..Configuration::DEFAULT
    };
    bench.say(&ToUnit::Configure(configuration));
    let heard = bench.tell(&said());
    let whole = heard.iter().find_map(|m| match m {
        ToHost::WhyWhole(why) => Some(*why),
        _ => None,
    });
    let whole = whole.expect("it tells how sure it is");
    let executed = heard.iter().any(|m| match m {
        ToHost::Decision(decided) => matches!(decided.decision.outcome, Outcome::Execute(_)),
        _ => false,
    });
    assert!(whole.posterior > 0.5, "{whole:?}");
    let cut = whole.cut.expect("a risk has a cut");
    assert_eq!(whole.confidence >= cut, executed, "{whole:?}");
}
