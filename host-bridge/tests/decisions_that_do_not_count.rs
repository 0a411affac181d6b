//! Not every decision that arrives is carried out: one after lost frames, one that comes twice, or one
//! that a stop has overrun.

mod common;

use std::time::Duration;

use common::*;
use deictic::robot::Event;
use deictic::session::Happening;
use deictic::showing::showing;
use deictic::unit::Distrust;
use deictic_core::large::{ToHost, ToUnit};

fn is_decision(message: &ToHost) -> bool {
    matches!(message, ToHost::Decision(_))
}

fn lost(h: &Happening) -> bool {
    matches!(h, Happening::Lost(_))
}

#[test]
fn a_decision_after_lost_frames_is_not_carried_out() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    let mut swallowed = false;
    cable.with(|line| {
        line.filter = Some(Box::new(move |message, frame| {
            if !swallowed && matches!(message, ToHost::Heartbeat(_)) {
                swallowed = true;
                return Vec::new();
            }
            // No other frame may tell of the gap before the decision does.
            if is_decision(message) {
                frame.to_vec()
            } else {
                Vec::new()
            }
        }));
    });
    for _ in 0..700 {
        session.turn(Duration::from_millis(1));
    }
    session
        .observe(showing("pick can", &lexicon).unwrap())
        .unwrap();
    let happened = until(&mut session, |h| {
        matches!(h, Happening::Distrusted(_) | Happening::Lost(_))
    });
    assert!(
        happened
            .iter()
            .any(|h| matches!(h, Happening::Distrusted(Distrust::AfterGap { .. }))),
        "{happened:#?}"
    );
    assert!(!moved(&happened));
}

#[test]
fn a_frame_that_comes_twice_is_done_once() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    cable.with(|line| {
        line.filter = Some(Box::new(|_, frame| [frame, frame].concat()));
    });
    session
        .observe(showing("push cube", &lexicon).unwrap())
        .unwrap();
    let mut happened = settle(&mut session);
    for _ in 0..200 {
        happened.extend(session.turn(Duration::from_millis(1)));
    }
    assert_eq!(
        happened
            .iter()
            .filter(|h| matches!(h, Happening::Accepted(_)))
            .count(),
        1
    );
    assert_eq!(happened.iter().filter(|h| is_done(h)).count(), 1);
}

#[test]
fn a_stop_overrules_what_was_said_before_it_even_when_the_unit_never_hears_of_it() {
    for swallowed in [false, true] {
        let (cable, lexicon) = (Cable::new(), lexicon());
        let mut session = open(&cable, &lexicon, 1.0);
        session
            .observe(showing("pick can", &lexicon).unwrap())
            .unwrap();
        if swallowed {
            cable.with(|line| line.swallow = Some(|said| matches!(said, ToUnit::Sentence(_))));
        }
        session.stop();
        let mut happened = Vec::new();
        if swallowed {
            happened.extend(until(&mut session, |h| *h == Happening::Overruled));
            happened.extend(until(&mut session, lost));
            cable.with(|line| line.swallow = None);
        }
        happened.extend(settle(&mut session));
        let begun = |h: &Happening| matches!(h, Happening::Robot(Event::Begun { .. }));
        assert!(!happened.iter().any(begun), "{swallowed}: {happened:#?}");
        // What is said after the stop counts again.
        session
            .observe(showing("pick can", &lexicon).unwrap())
            .unwrap();
        until(&mut session, begun);
    }
}
