//! "Don't": what a hand shows with it is not done, whichever comes first; and what comes after is.

#[path = "common/bench.rs"]
mod bench;
mod common;

use bench::*;
use common::*;
use deictic_core::board::{Sentence, ToHost, ToUnit};
use deictic_core::decide::Outcome;
use deictic_core::protocol::message::*;
use deictic_core::sentence::{GESTURE, LANGUAGE, MODALITIES, SentenceError};
use proptest::prelude::*;

/// The default pairing window, in milliseconds.
const WINDOW: u64 = 1_000;

fn shown() -> Sentence {
    command(GESTURE, PICK, Some(CUP), None)
}

fn withheld(heard: &[ToHost]) -> Vec<Withheld> {
    let told = heard.iter().filter_map(|m| match m {
        ToHost::Withheld(withheld) => Some(*withheld),
        _ => None,
    });
    told.collect()
}

fn decisions(heard: &[ToHost]) -> usize {
    let decided = heard.iter().filter(|m| matches!(m, ToHost::Decision(_)));
    decided.count()
}

const fn told(modalities: u8, confirms: bool) -> Withheld {
    Withheld {
        modalities,
        confirms,
    }
}

#[test]
fn what_was_shown_before_is_dropped() {
    let mut bench = Bench::ready();
    assert_eq!(bench.decision(shown()), None);
    bench.wait(400);
    let heard = bench.say(&ToUnit::Forbid(LANGUAGE));
    assert_eq!(withheld(&heard), [told(0b01, true)]);
    assert_eq!(decisions(&bench.wait(1_500)), 0);
}

#[test]
fn what_is_shown_after_is_not_taken() {
    let mut bench = Bench::ready();
    let heard = bench.say(&ToUnit::Forbid(LANGUAGE));
    assert_eq!(withheld(&heard), [told(0, true)]);
    bench.wait(400);
    let heard = bench.tell(&shown());
    assert_eq!(withheld(&heard), [told(0b01, false)]);
    assert_eq!(decisions(&bench.wait(1_500)), 0);
}

#[test]
fn what_was_said_before_is_dropped_too() {
    let mut bench = Bench::ready();
    assert_eq!(
        bench.decision(command(LANGUAGE, PICK, Some(CUP), None)),
        None
    );
    let heard = bench.say(&ToUnit::Forbid(LANGUAGE));
    assert_eq!(withheld(&heard), [told(0b10, true)]);
    assert_eq!(decisions(&bench.wait(1_500)), 0);
}

#[test]
fn a_command_lifts_it() {
    let mut bench = Bench::ready();
    bench.say(&ToUnit::Forbid(LANGUAGE));
    bench.wait(200);
    assert_eq!(
        bench.decision(command(LANGUAGE, PICK, Some(CAN), None)),
        None
    );
    bench.wait(200);
    let pick = bench.decision(command(GESTURE, PICK, Some(CAN), None));
    assert_eq!(
        executed(&pick.unwrap().decision),
        Some((PICK, Some(CAN), None))
    );
}

#[test]
fn it_is_over_with_the_window() {
    let mut bench = Bench::ready();
    bench.say(&ToUnit::Forbid(LANGUAGE));
    bench.wait(WINDOW);
    assert_eq!(withheld(&bench.tell(&shown())), []);
    assert_eq!(decisions(&bench.wait(1_500)), 1);
}

#[test]
fn a_stop_is_never_held_back() {
    let mut bench = Bench::ready();
    bench.say(&ToUnit::Forbid(LANGUAGE));
    let stop = bench.decision(command(GESTURE, STOP, None, None)).unwrap();
    assert_eq!(executed(&stop.decision), Some((STOP, None, None)));
}

#[test]
fn it_closes_the_question_that_is_open() {
    let mut bench = Bench::ready();
    bench.tell(&command(GESTURE, PICK, None, None));
    let heard = bench.tell(&command(LANGUAGE, PICK, None, None));
    let asked = heard.iter().find_map(|m| match m {
        ToHost::Decision(d) if matches!(d.decision.outcome, Outcome::Ask(_)) => Some(d.number),
        _ => None,
    });
    bench.say(&ToUnit::Forbid(LANGUAGE));
    let decision = asked.unwrap();
    let answer = sentence_parts(&command(LANGUAGE, PICK, Some(CUP), None), Some(decision));
    let heard = bench.all(answer);
    assert_eq!(faults(&heard), [Fault::NoQuestion { decision }]);
}

#[test]
fn a_host_that_begins_anew_has_forbidden_nothing() {
    let mut bench = Bench::ready();
    bench.say(&ToUnit::Forbid(LANGUAGE));
    bench.say(&hello());
    bench.all(vocabulary_parts());
    bench.all(scene_parts(1));
    assert_eq!(withheld(&bench.tell(&shown())), []);
}

#[test]
fn nobody_of_whom_there_is_no_room_forbids() {
    let mut bench = Bench::ready();
    bench.tell(&shown());
    let modality = MODALITIES as u8;
    let heard = bench.say(&ToUnit::Forbid(modality));
    let error = SentenceError::UnknownModality { capacity: modality };
    assert_eq!(faults(&heard), [Fault::Sentence { modality, error }]);
    assert_eq!(decisions(&bench.wait(1_500)), 1);
}

/// Something that is said, shown or forbidden.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Deed {
    Show,
    Forbid,
    Ask,
}

fn deeds() -> impl Strategy<Value = Vec<(u64, Deed)>> {
    let deed = prop_oneof![
        4 => Just(Deed::Show),
        2 => Just(Deed::Forbid),
        1 => Just(Deed::Ask),
    ];
    proptest::collection::vec((0_u64..1_200, deed), 1..12)
}

proptest! {
    /// Gestures and prohibitions in any order: what is decided on waits at that moment, as no prohibition has come since it was
    /// shown, and was shown a window or more after the last one before it.
    #[test]
    fn nothing_is_executed_that_was_shown_within_the_window_of_a_prohibition(
        deeds in deeds(), step in 1_u64..90,
    ) {
        let mut bench = Bench::ready();
        let mut forbidden: Vec<u64> = Vec::new();
        let mut executed: Vec<u64> = Vec::new();
        let mut shown_at: Option<u64> = None;
        let now = |bench: &Bench| bench.now.0 / 1_000;
        for (pause, deed) in deeds.into_iter().chain([(2_500, Deed::Ask)]) {
            // Time passes in steps, as a loop that polls sees it; the host lives.
            let mut left = pause;
            while left > 0 {
                let span = left.min(step);
                left -= span;
                bench.say(&ToUnit::Heartbeat(Heartbeat { now: bench.now, vocabulary: 0, scene: 0 }));
                for _ in 0..decisions(&bench.wait(span)) {
                    prop_assert!(shown_at.is_some(), "what was forbidden is decided on");
                    executed.extend(shown_at.take());
                }
            }
            let heard = match deed {
                Deed::Show => bench.tell(&shown()),
                Deed::Forbid => {
                    forbidden.push(now(&bench));
                    bench.say(&ToUnit::Forbid(LANGUAGE))
                }
                Deed::Ask => bench.say(&ToUnit::AskStatistics),
            };
            // A second gesture has the first decided, which had waited.
            for _ in 0..decisions(&heard) {
                prop_assert!(shown_at.is_some(), "what was forbidden is decided on");
                executed.extend(shown_at.take());
            }
            match deed {
                Deed::Show if withheld(&heard).is_empty() => shown_at = Some(now(&bench)),
                Deed::Forbid => shown_at = None,
                _ => {}
            }
        }
        for at in executed {
            let near = forbidden.iter().find(|f| **f <= at && at < **f + WINDOW);
            prop_assert_eq!(near, None, "shown at {}", at);
        }
    }
}
