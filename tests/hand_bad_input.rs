//! Whatever a hand sensor sends is survived, counted and safe.

use deictic::hand::source::recording::framed;
use deictic_core::board::{ToHost, ToUnit};
use deictic_core::gesture::frame::Side;
use deictic_core::gesture::tracking::SILENT;
use deictic_core::gesture::wire::{Sample, encode};
use deictic_core::protocol::hand::{HandFault, SampleBytes};
use deictic_core::protocol::message::Fault;
use deictic_tests::gesturing::person;
use deictic_tests::sensing::{Table, all_executed, expected, put};

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
