//! Under full load - a hand at 125 frames a second, a person who talks, a table that changes 25 times a second, a line
//! full of noise, a bus on which there is never silence - an arm that is told to stop stands still within
//! two of its control periods, and one that hears nothing any more within the stated bound. Periods are counted in
//! simulated time.

use deictic::unit::UNIT_LOST;
use deictic_core::command::HOST_LOST;
use deictic_tests::stillness::{
    Ends, PERIOD, Setting, Stillness, loses_its_host, loses_its_unit, stops,
};

/// Persons, each of whom points about for another while and otherwise.
const PERSONS: u64 = 8;

/// The promise.
const PERIODS: u64 = 2;

fn worst(found: impl Iterator<Item = Stillness>) -> Stillness {
    found.fold(
        Stillness {
            under_way: 0,
            moved: 0,
        },
        |worst, next| Stillness {
            under_way: worst.under_way.max(next.under_way),
            moved: worst.moved.max(next.moved),
        },
    )
}

#[test]
fn a_stop_by_the_unit_is_obeyed_within_two_control_periods() {
    let setting = Setting::default();
    let near = worst((0..PERSONS).map(|seed| stops(&setting, Ends::Near, seed)));
    eprintln!("in this process: {near:?}");
    assert!(near.moved <= PERIODS, "{near:?}");
}

#[test]
fn a_stop_that_comes_over_a_full_bus_is_obeyed_within_two_control_periods() {
    let setting = Setting::default();
    let far = worst((0..PERSONS).map(|seed| stops(&setting, Ends::Far, seed)));
    eprintln!("behind a bus: {far:?}");
    assert!(far.moved <= PERIODS, "{far:?}");
    // One frame of somebody else, which nothing interrupts, and what the bridge itself had begun to send.
    assert!(far.under_way <= 10, "{far:?}");
}

#[test]
fn an_arm_whose_unit_falls_silent_stands_still_within_the_bound() {
    let setting = Setting::default();
    let bound = UNIT_LOST.as_micros() as u64 / PERIOD.0 + PERIODS;
    for ends in [Ends::Near, Ends::Far] {
        let found = loses_its_unit(&setting, ends, 1);
        eprintln!("{ends:?}: {found:?} of {bound}");
        let slack = if ends == Ends::Far { 10 } else { 0 };
        assert!(found.moved > 0 && found.moved <= bound + slack, "{found:?}");
    }
}

#[test]
fn an_arm_whose_host_hangs_stands_still_within_the_bound() {
    let setting = Setting::default();
    let bound = HOST_LOST.0 / PERIOD.0 + PERIODS;
    let found = worst((0..PERSONS).map(|seed| loses_its_host(&setting, seed)));
    eprintln!("{found:?} of {bound}");
    assert!(found.moved > 0 && found.moved <= bound, "{found:?}");
}
