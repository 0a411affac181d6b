//! Sessions of made-up people, read by the unit's hand reader.

use deictic::hand::movement::GESTURES;
use deictic::hand::session::{Act, made_up};
use deictic_core::category::Category;
use deictic_core::gesture::context::Event;
use deictic_core::gesture::frame::HandFrame;
use deictic_core::gesture::line::{FRAMED, SensorLine, send};
use deictic_core::gesture::pointing::Mount;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::time::Micros;
use deictic_tests::gesturing::{OBJECTS, PICK, PUSH, PUT, RATE, STOP, STORAGES, person, separate};
use deictic_tests::people::{Bench, Named, Reader, words};
use deictic_tests::sensing::put;

/// Holds that 95 of 100 people's sessions say this.
fn holds(acts: &[Act], expected: &[Named]) {
    let bench = Bench::new();
    let right = (1_000..1_100).filter(|seed| {
        let said = bench.said(acts, *seed);
        said.is_some_and(|s| s.check(&bench.vocabulary).is_ok() && words(&s) == expected)
    });
    let right = right.count();
    assert!(right >= 95, "{right} of 100 for {acts:?}");
}

fn object(option: usize) -> Named {
    (Category::OBJECT, option)
}

fn storage(option: usize) -> Named {
    (Category::STORAGE, option)
}

fn action(option: u8) -> Named {
    (Category::ACTION, usize::from(option))
}

#[test]
fn people_show_what_to_do_and_point_at_an_object_and_a_storage() {
    holds(&put(), &[action(PUT), object(1), storage(0)]);
    let acts = [Act::Show(Shape::Pinch), separate(), Act::Point(OBJECTS[1])];
    holds(&acts, &[action(PICK), object(1)]);
}

#[test]
fn people_point_and_then_show_what_to_do() {
    let acts = [Act::Point(OBJECTS[0]), separate(), Act::Show(Shape::Three)];
    holds(&acts, &[object(0), action(PUSH)]);
    let acts = [
        Act::Point(OBJECTS[0]),
        separate(),
        Act::Point(STORAGES[1]),
        separate(),
        Act::Show(Shape::ThumbsUp),
    ];
    holds(&acts, &[object(0), storage(1), action(PUT)]);
}

#[test]
fn people_only_point() {
    let acts = [Act::Point(OBJECTS[0]), separate(), Act::Point(STORAGES[1])];
    holds(&acts, &[object(0), storage(1)]);
}

#[test]
fn people_swipe_and_point() {
    let acts = [
        Act::Move("swipe-right".to_owned()),
        separate(),
        Act::Point(OBJECTS[2]),
        separate(),
        Act::Point(STORAGES[1]),
    ];
    holds(&acts, &[action(PUT), object(2), storage(1)]);
}

#[test]
fn the_stop_gesture_does_not_wait_for_the_hand_to_leave() {
    let bench = Bench::new();
    let mut in_time = 0;
    for seed in 0..40 {
        let acts = [Act::Point(OBJECTS[0]), separate(), Act::Show(Shape::Two)];
        let samples = person(seed, &acts);
        let events = bench.read(&mut Reader::new(), &samples);
        let stop = events.iter().find_map(|event| match event {
            (Event::Stop, said) => said.as_ref().map(words),
            _ => None,
        });
        in_time += usize::from(stop == Some(vec![action(STOP)]));
        assert!(
            !events
                .iter()
                .any(|e| matches!(e, (Event::Said, Some(s)) if s.words().len() > 1)),
            "what was said before the stop is void"
        );
    }
    assert!(in_time >= 38, "{in_time} of 40");
}

#[test]
fn a_hand_that_shows_nothing_says_nothing() {
    let bench = Bench::new();
    for seed in 0..20 {
        assert_eq!(bench.said(&[Act::Show(Shape::Five)], seed), None, "{seed}");
    }
}

#[test]
fn frames_over_the_wire_say_the_same() {
    let bench = Bench::new();
    let acts = [Act::Show(Shape::Pinch), separate(), Act::Point(OBJECTS[0])];
    let samples = person(5, &acts);
    let mut line = SensorLine::new();
    let mut received = Vec::new();
    for sample in &samples {
        let mut out = Outbox::<FRAMED>::new();
        send(sample, &mut out).unwrap();
        received.extend(out.waiting().iter().filter_map(|byte| line.push(*byte)));
    }
    let received: Vec<Sample> = received.into_iter().collect::<Result<_, _>>().unwrap();
    assert_eq!(received.len(), samples.len());
    let direct = bench.read(&mut Reader::new(), &samples);
    let wired = bench.read(&mut Reader::new(), &received);
    assert_eq!(direct.len(), wired.len());
    assert!(matches!(wired.last(), Some((Event::Said, Some(s))) if words(s).len() == 2));
}

#[test]
fn a_sensor_that_stops_in_the_middle_says_nothing() {
    let bench = Bench::new();
    let acts = [Act::Show(Shape::Pinch), separate()];
    let mut samples = person(6, &acts);
    samples.retain(|sample| matches!(sample, Sample::Hand(_)));
    let mut reader = Reader::new();
    let events = bench.read(&mut reader, &samples);
    assert!(
        events
            .iter()
            .all(|e| matches!(e, (Event::Opened(_) | Event::Closed(_), _)))
    );
    let wake = reader.next_wake();
    assert_eq!(reader.poll(wake), Some(Event::SensorLost));
    assert!(reader.words().is_empty());
    assert_eq!(reader.poll(Micros(u64::MAX)), None);
}

#[test]
fn whatever_the_frames_are_the_reader_survives() {
    let bench = Bench::new();
    let acts = [
        Act::Point(OBJECTS[0]),
        separate(),
        Act::Move(GESTURES[7].to_owned()),
    ];
    let samples = made_up(7, Mount::DEFAULT, 0.1, &acts, RATE);
    let mut spoilt = Vec::new();
    for (i, sample) in samples.iter().enumerate() {
        let Sample::Hand(mut frame) = *sample else {
            spoilt.push(*sample);
            continue;
        };
        match i % 7 {
            0 => frame.fingers[i % 5] = None,
            1 => frame.palm[0] = f32::NAN,
            2 => frame.time = frame.time.wrapping_sub(50_000),
            3 => frame.velocity = [f32::INFINITY; 3],
            4 => {
                frame = HandFrame {
                    time: frame.time,
                    ..HandFrame::default()
                }
            }
            _ => {}
        }
        spoilt.push(Sample::Hand(frame));
    }
    let mut reader = Reader::new();
    for event in bench.read(&mut reader, &spoilt) {
        if let Some(sentence) = event.1 {
            assert_eq!(sentence.check(&bench.vocabulary), Ok(()));
        }
    }
    let counters = reader.counters();
    assert!(
        counters.unsound > 0 && counters.backwards > 0 && counters.shapeless > 0,
        "{counters:?}"
    );
}

#[test]
fn the_reader_fits_the_board() {
    let bytes = size_of::<Reader>();
    assert!(bytes <= 4096, "{bytes}");
}
