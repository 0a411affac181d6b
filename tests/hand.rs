//! Hands in front of a unit: what a sensor sends becomes the gesture sentence, on a board as in this
//! process.

use std::time::{Duration, Instant};

use deictic::hand::session::Act;
use deictic::hand::source::recording::framed;
use deictic_core::board::{ToHost, ToUnit};
use deictic_core::category::Category;
use deictic_core::decide::Outcome;
use deictic_core::gesture::mapping::{Gesture, STROKES};
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::stroke::Likely;
use deictic_core::gesture::wire::{Sample, decode, encode};
use deictic_core::protocol::hand::SampleBytes;
use deictic_core::protocol::message::{Configuration, Heartbeat};
use deictic_core::sentence::LANGUAGE;
use deictic_core::time::Micros;
use deictic_tests::emulated::{Emulated, has_image};
use deictic_tests::gesturing::{OBJECTS, PICK, RATE, STOP, person, ready, separate, stroke};
use deictic_tests::sensing::{Table, all_executed, executed, expected, put};

#[test]
fn a_hand_on_the_sensor_line_becomes_a_decision() {
    let mut table = Table::new();
    table.sense_all(&person(3, &put()));
    let decisions = table.decisions();
    assert_eq!(all_executed(&decisions), [expected()]);
}

#[test]
fn samples_through_the_host_say_the_same() {
    let mut table = Table::new();
    for sample in person(3, &put()) {
        table.wait(Micros((1e6 / RATE) as u64));
        let bytes = encode(&sample).expect("a sound sample");
        let bytes = SampleBytes::from_slice(&bytes).expect("88 bytes");
        table.0.say(&ToUnit::Sample(bytes));
        table.0.hear();
    }
    let heard = table.0.heard();
    let words: usize = heard
        .iter()
        .map(|m| match m {
            ToHost::Shown(part) => part.words.len(),
            _ => 0,
        })
        .sum();
    assert_eq!(words, 3);
    let showing = heard.iter().filter(|m| matches!(m, ToHost::Showing(_)));
    let showing: Vec<bool> = showing.map(|m| *m == ToHost::Showing(true)).collect();
    assert_eq!(showing, [true, false]);
}

#[test]
fn the_stop_gesture_stops_at_once() {
    let mut table = Table::new();
    let acts = [Act::Point(OBJECTS[0]), separate(), Act::Show(Shape::Two)];
    let samples = person(4, &acts);
    let there = samples.iter().rposition(|s| matches!(s, Sample::Hand(_)));
    // The hand is still there when the unit has decided.
    let before = there.expect("a hand") - (RATE * 0.5) as usize;
    table.sense_all(&samples[..before]);
    let decisions = table.decisions();
    assert_eq!(all_executed(&decisions), [Some((STOP, vec![]))]);
    // What was pointed at before is void.
    table.sense_all(&samples[before..]);
    assert_eq!(table.decisions(), []);
}

#[test]
fn pointing_answers_the_question_which() {
    let mut table = Table::new();
    table.sense_all(&person(5, &[Act::Show(Shape::Pinch)]));
    let decisions = table.decisions();
    assert!(matches!(&decisions[..], [Outcome::Ask(q)] if q.category == Category::OBJECT));
    // Another moment, the same sensor.
    let mut samples = person(5, &[Act::Point(OBJECTS[2])]);
    for sample in &mut samples {
        match sample {
            Sample::Hand(frame) => frame.time += 20_000_000,
            Sample::Nothing(time) => *time += 20_000_000,
        }
    }
    table.sense_all(&samples);
    let decisions = table.decisions();
    let expected = Some((PICK, vec![(Category::OBJECT, 2)]));
    assert_eq!(all_executed(&decisions), [expected]);
}

#[test]
fn a_movement_that_a_sensor_recognised_by_itself_is_a_command() {
    let mut table = Table::new();
    let Gesture::Stroke(swipe) = stroke("swipe-right") else {
        unreachable!("a swipe is a stroke")
    };
    let mut likely = Likely {
        gestures: [0.0; STROKES],
        none: 0.1,
    };
    likely.gestures[usize::from(swipe)] = 0.9;
    table.0.wire.unit.recognise(&likely);
    let decisions = table.decisions();
    // Put what?
    assert!(matches!(&decisions[..], [Outcome::Ask(q)] if q.category == Category::OBJECT));
    likely.gestures = [0.0; STROKES];
    likely.none = 1.0;
    table.0.wire.unit.recognise(&likely);
    assert_eq!(table.decisions(), []);
}

#[test]
fn samples_on_the_sensor_line_are_passed_on_when_they_are_asked_for() {
    let mut table = Table::new();
    let samples = person(3, &put());
    let relayed = |table: &mut Table| -> Vec<Sample> {
        let heard = table.0.heard().into_iter();
        let bytes = heard.filter_map(|m| match m {
            ToHost::Sample(bytes) => Some(bytes),
            _ => None,
        });
        bytes.map(|b| decode(&b).expect("a sound sample")).collect()
    };
    let (first, rest) = samples.split_at(50);
    table.sense_all(first);
    assert_eq!(relayed(&mut table), []);
    table.0.say(&ToUnit::Relay(true));
    table.sense(&[0xff, 0xaa, 0]);
    table.sense_all(rest);
    // What was damaged on the way is not a sample; the others are passed on as the unit saw them.
    let seen: Vec<Sample> = rest
        .iter()
        .map(|sample| decode(&encode(sample).expect("a sound sample")).expect("the same"))
        .collect();
    let heard = table.0.heard();
    let passed = heard.iter().filter_map(|m| match m {
        ToHost::Sample(bytes) => decode(bytes).ok(),
        _ => None,
    });
    assert_eq!(passed.collect::<Vec<_>>(), seen);
    // They are read all the same.
    let decided = heard.iter().filter_map(|m| match m {
        ToHost::Decision(decided) => executed(&decided.decision.outcome),
        _ => None,
    });
    assert_eq!(decided.collect::<Vec<_>>(), [expected().expect("a deed")]);
    table.0.say(&ToUnit::Relay(false));
    table.sense_all(first);
    assert_eq!(relayed(&mut table), []);
}

#[test]
fn a_hand_that_is_seen_within_the_window_of_a_prohibition_is_held_back_to_its_end() {
    // In the middle of the sentence, and long before its end or just before its beginning; windows much shorter than
    // the sentence.
    let samples = person(3, &put());
    for at in [0, samples.len() / 2] {
        let mut table = Table::new();
        table.0.configure(Configuration {
            expected: 0b1,
            window: Micros::from_millis(if at == 0 { 1_000 } else { 1 }),
            ..Configuration::DEFAULT
        });
        let (before, after) = samples.split_at(at);
        table.sense_all(before);
        table.0.say(&ToUnit::Forbid(LANGUAGE));
        table.sense_all(after);
        let heard = table.0.heard();
        let decided = heard.iter().any(|m| matches!(m, ToHost::Decision(_)));
        let withheld = heard.iter().filter_map(|m| match m {
            ToHost::Withheld(withheld) => Some((withheld.modalities, withheld.confirms)),
            _ => None,
        });
        assert_eq!(withheld.collect::<Vec<_>>(), [(0, true), (1, false)]);
        assert!(!decided, "{heard:?}");
        // What the hand says next is a command again.
        table.wait(Micros::from_millis(1_500));
        let mut later = samples.clone();
        for sample in &mut later {
            match sample {
                Sample::Hand(frame) => frame.time += 20_000_000,
                Sample::Nothing(time) => *time += 20_000_000,
            }
        }
        table.sense_all(&later);
        assert_eq!(all_executed(&table.decisions()), [expected()]);
    }
}

/// What a unit says about hands and decisions.
fn told(message: &ToHost) -> Option<ToHost> {
    match message {
        ToHost::Shown(_) | ToHost::Decision(_) | ToHost::Fault(_) => Some(message.clone()),
        _ => None,
    }
}

#[test]
fn a_session_at_110_frames_a_second_on_the_boards_sensor_line_says_what_it_says_here() {
    if !has_image() {
        return;
    }
    for seed in [3, 11] {
        let samples = person(seed, &put());
        let mut table = Table::new();
        table.sense_all(&samples);
        let here: Vec<ToHost> = table.0.heard().iter().filter_map(told).collect();
        assert!(
            matches!(here.last(), Some(ToHost::Decision(d))
            if executed(&d.decision.outcome) == expected()),
            "{here:?}"
        );

        let mut host = ready(Emulated::boot_with_sensor());
        let began = Instant::now();
        for (i, sample) in (0_u32..).zip(&samples) {
            let due = Duration::from_secs_f64(f64::from(i) / RATE);
            std::thread::sleep(due.saturating_sub(began.elapsed()));
            host.wire.sense(&framed(sample));
            if i % 50 == 0 {
                let now = Micros(0);
                host.say(&ToUnit::Heartbeat(Heartbeat {
                    now,
                    vocabulary: 0,
                    scene: 0,
                }));
            }
            host.hear();
        }
        // The unit has read all of it when it answers; what it says by then is all there is.
        let there: Vec<ToHost> = (0..here.len()).map(|_| host.wait_for(told)).collect();
        host.say(&ToUnit::AskHand);
        let counted = host.wait_for(|m| match m {
            ToHost::HandStatistics(statistics) => Some(statistics.samples),
            _ => None,
        });
        let hands = samples
            .iter()
            .filter(|s| matches!(s, Sample::Hand(_)))
            .count();
        assert_eq!(
            (counted.used + counted.hurried) as usize,
            hands,
            "{counted:?}"
        );
        // Messages hold the very bits of every float.
        assert_eq!(format!("{there:?}"), format!("{here:?}"));
    }
}
