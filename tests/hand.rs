//! Hands in front of a unit: what a sensor sends becomes the gesture sentence, on a board as in this
//! process; and whatever a sensor sends is survived, counted and safe.

use std::time::{Duration, Instant};

use deictic::hand::session::Act;
use deictic::hand::source::recording::framed;
use deictic_core::board::{ToHost, ToUnit, Unit};
use deictic_core::category::Category;
use deictic_core::decide::Outcome;
use deictic_core::gesture::counters::SampleCounters;
use deictic_core::gesture::frame::Side;
use deictic_core::gesture::mapping::{Gesture, STROKES};
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::stroke::Likely;
use deictic_core::gesture::tracking::SILENT;
use deictic_core::gesture::wire::{Sample, encode};
use deictic_core::intent::Intent;
use deictic_core::protocol::hand::{HandFault, SampleBytes};
use deictic_core::protocol::message::{Fault, Heartbeat};
use deictic_core::time::Micros;
use deictic_tests::emulated::{Emulated, has_image};
use deictic_tests::gesturing::{
    OBJECTS, PICK, PUT, RATE, STOP, STORAGES, person, ready, separate, stroke,
};
use deictic_tests::host::{Host, Wire};

/// A unit in this process whose clock is the test's.
struct Clocked {
    unit: Box<Unit>,
    now: Micros,
}

impl Default for Clocked {
    fn default() -> Self {
        Self {
            unit: Box::new(Unit::new(1)),
            now: Micros(1),
        }
    }
}

impl Wire for Clocked {
    fn write(&mut self, bytes: &[u8]) {
        self.unit.receive(self.now, bytes);
    }

    fn read(&mut self, _: Duration) -> Vec<u8> {
        self.unit.poll(self.now);
        let bytes = self.unit.outgoing().to_vec();
        self.unit.sent(bytes.len());
        bytes
    }
}

/// A host with a unit in this process, and samples at the sensor's pace.
struct Table(Host<Clocked>);

impl Table {
    fn new() -> Self {
        Self(ready(Clocked::default()))
    }

    fn wait(&mut self, span: Micros) {
        let wire = &mut self.0.wire;
        wire.now = wire.now.after(span);
        wire.unit.poll(wire.now);
    }

    /// Bytes on the unit's sensor line, 9 ms after those before; the host lives all the while.
    fn sense(&mut self, bytes: &[u8]) {
        self.wait(Micros((1e6 / RATE) as u64));
        let beat = Heartbeat {
            now: Micros(0),
            vocabulary: 0,
            scene: 0,
        };
        self.0.say(&ToUnit::Heartbeat(beat));
        let wire = &mut self.0.wire;
        wire.unit.sense(wire.now, bytes);
    }

    fn sense_all(&mut self, samples: &[Sample]) {
        for sample in samples {
            self.sense(&framed(sample));
            // What the unit says is taken from it in time.
            self.0.hear();
        }
    }

    /// What has become of samples. What was said before and not looked at is dropped.
    fn counted(&mut self) -> SampleCounters {
        self.0.say(&ToUnit::AskHand);
        self.0.wait_for(|m| match m {
            ToHost::HandStatistics(statistics) => Some(statistics.samples),
            _ => None,
        })
    }

    /// What the unit has decided to do so far.
    fn decisions(&mut self) -> Vec<Outcome<8>> {
        let heard = self.0.heard();
        let outcome = |m: ToHost| match m {
            ToHost::Decision(decided) => Some(decided.decision.outcome),
            _ => None,
        };
        heard.into_iter().filter_map(outcome).collect()
    }
}

/// Thumb up, an object, a storage.
fn put() -> [Act; 5] {
    [
        Act::Show(Shape::ThumbsUp),
        separate(),
        Act::Point(OBJECTS[1]),
        separate(),
        Act::Point(STORAGES[0]),
    ]
}

/// An action and its parameters.
type Deed = (u8, Vec<(Category, u8)>);

fn executed(outcome: &Outcome<8>) -> Option<Deed> {
    let Outcome::Execute(Intent { action, parameters }) = outcome else {
        return None;
    };
    let parameters = parameters.iter().map(|p| (p.category, p.option));
    Some((*action, parameters.collect()))
}

fn all_executed(outcomes: &[Outcome<8>]) -> Vec<Option<Deed>> {
    outcomes.iter().map(executed).collect()
}

fn expected() -> Option<Deed> {
    Some((PUT, vec![(Category::OBJECT, 1), (Category::STORAGE, 0)]))
}

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
    let wire = &mut table.0.wire;
    wire.unit.recognise(wire.now, &likely);
    let decisions = table.decisions();
    // Put what?
    assert!(matches!(&decisions[..], [Outcome::Ask(q)] if q.category == Category::OBJECT));
    likely.gestures = [0.0; STROKES];
    likely.none = 1.0;
    let wire = &mut table.0.wire;
    wire.unit.recognise(wire.now, &likely);
    assert_eq!(table.decisions(), []);
}

#[test]
fn missing_fingers_are_counted_and_say_nothing() {
    let mut table = Table::new();
    let mut samples = person(3, &put());
    for sample in &mut samples {
        if let Sample::Hand(frame) = sample {
            frame.fingers[1] = None;
        }
    }
    table.sense_all(&samples);
    let counted = table.counted();
    assert!(
        counted.shapeless > 300 && counted.shapeless == counted.used,
        "{counted:?}"
    );
    assert_eq!(table.decisions(), []);
}

#[test]
fn a_hand_lost_for_moments_still_says_what_it_says() {
    let mut table = Table::new();
    let mut samples = person(3, &put());
    // Every second, 150 ms without a hand.
    let time = |s: &Sample| match s {
        Sample::Hand(frame) => frame.time,
        Sample::Nothing(time) => *time,
    };
    for sample in &mut samples {
        let time = time(sample);
        if time % 1_000_000 < 150_000 {
            *sample = Sample::Nothing(time);
        }
    }
    table.sense_all(&samples);
    let decisions = table.decisions();
    assert_eq!(all_executed(&decisions), [expected()]);
}

#[test]
fn a_second_hand_is_counted_and_not_followed() {
    let mut table = Table::new();
    for sample in person(3, &put()) {
        table.sense(&framed(&sample));
        if let Sample::Hand(mut frame) = sample {
            frame.side = match frame.side {
                Side::Left => Side::Right,
                Side::Right => Side::Left,
            };
            table.sense(&framed(&Sample::Hand(frame)));
        }
        table.0.hear();
    }
    let decisions = table.decisions();
    assert_eq!(all_executed(&decisions), [expected()]);
    assert!(table.counted().other_hand > 300);
}

#[test]
fn time_that_runs_backwards_is_counted_and_left_out() {
    let mut table = Table::new();
    for (i, sample) in person(3, &put()).into_iter().enumerate() {
        table.sense(&framed(&sample));
        if let (Sample::Hand(mut frame), 0) = (sample, i % 5) {
            frame.time = frame.time.wrapping_sub(80_000);
            table.sense(&framed(&Sample::Hand(frame)));
        }
        table.0.hear();
    }
    let decisions = table.decisions();
    assert_eq!(all_executed(&decisions), [expected()]);
    assert!(table.counted().backwards > 100);
}

#[test]
fn numbers_that_cannot_be_are_counted_and_left_out() {
    let mut table = Table::new();
    for sample in person(3, &put()) {
        table.sense(&framed(&sample));
        // The wire has no NaN; a direction of length 0 is what it can do.
        let mut bytes = encode(&sample).expect("a sound sample");
        if matches!(sample, Sample::Hand(_)) {
            bytes[20..26].fill(0);
            let bytes = SampleBytes::from_slice(&bytes).expect("88 bytes");
            table.0.say(&ToUnit::Sample(bytes));
        }
        table.0.say(&ToUnit::Sample(
            SampleBytes::from_slice(&[0x80; 12]).expect("12 bytes"),
        ));
        table.0.say(&ToUnit::Sample(
            SampleBytes::from_slice(&[0x12; 88]).expect("88 bytes"),
        ));
        table.0.hear();
    }
    let decisions = table.decisions();
    assert_eq!(all_executed(&decisions), [expected()]);
    let counted = table.counted();
    assert!(
        counted.unsound > 300 && counted.damaged > 300 && counted.foreign > 300,
        "{counted:?}"
    );
}

#[test]
fn two_thousand_frames_a_second_are_used_as_far_as_they_help() {
    let mut table = Table::new();
    for sample in person(3, &put()) {
        // Each frame eighteen times, half a millisecond apart.
        for i in 0..18 {
            let mut sample = sample;
            match &mut sample {
                Sample::Hand(frame) => frame.time += i * 500,
                Sample::Nothing(time) => *time += i * 500,
            }
            let wire = &mut table.0.wire;
            wire.unit.sense(wire.now, &framed(&sample));
        }
        table.sense(&[]);
        table.0.hear();
    }
    let decisions = table.decisions();
    assert_eq!(all_executed(&decisions), [expected()]);
    let counted = table.counted();
    assert!(counted.hurried > 5 * counted.used, "{counted:?}");
}

#[test]
fn a_sensor_that_stops_is_told_once_and_nothing_is_done() {
    let mut table = Table::new();
    let samples = person(3, &put());
    table.sense_all(&samples[..samples.len() / 2]);
    table.wait(SILENT);
    table.wait(SILENT);
    let heard = table.0.heard();
    let lost = ToHost::Fault(Fault::Hand(HandFault::SensorLost));
    assert_eq!(heard.iter().filter(|m| **m == lost).count(), 1);
    let mut showing = heard.iter().filter(|m| matches!(m, ToHost::Showing(_)));
    assert_eq!(showing.next_back(), Some(&ToHost::Showing(false)));
    assert_eq!(table.counted().silences, 1);
    assert_eq!(table.decisions(), []);
}

#[test]
fn noise_on_the_sensor_line_is_counted_and_says_nothing() {
    let mut table = Table::new();
    let noise: Vec<u8> = (0..20_000_u32)
        .map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8)
        .collect();
    for chunk in noise.chunks(90) {
        table.sense(chunk);
    }
    let counted = table.counted();
    assert!(counted.damaged > 20 && counted.used == 0, "{counted:?}");
    table.sense(&[0]);
    table.sense_all(&person(3, &put()));
    let decisions = table.decisions();
    assert_eq!(all_executed(&decisions), [expected()]);
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
