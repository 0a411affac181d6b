//! The board-independent loop with a unit and links in memory: what a slow, stuck or broken link must not change.

mod common;

use common::board::Table;
use deictic_core::board::{ToHost, ToUnit};
use deictic_core::gesture::line::{FRAMED, send};
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::unit::HEARTBEAT;
use deictic_firmware::{Turn, turn};

#[test]
fn a_host_is_answered_over_a_link_of_any_width() {
    for room in [1, 7, 64, 4096] {
        let mut table = Table::new(room);
        table.say_hello();
        let turns = table.settle();
        assert!(table.hears_hello(), "{room} bytes per turn");
        assert_eq!(table.board.fed, turns + 1, "the watchdog is fed every turn");
    }
}

#[test]
fn a_stuck_link_loses_nothing_and_does_not_hold_the_loop() {
    let mut table = Table::new(0);
    table.say_hello();
    table.settle();
    assert!(table.board.link.outgoing.is_empty());
    table.board.link.room = 16;
    table.settle();
    assert!(table.hears_hello());
}

#[test]
fn a_broken_link_moves_nothing_until_it_is_whole_again() {
    let mut table = Table::new(64);
    table.say_hello();
    table.board.link.broken = true;
    assert_eq!(turn(&mut table.board, &mut table.unit), Turn::default());
    table.board.link.broken = false;
    table.settle();
    assert!(table.hears_hello());
}

#[test]
fn a_noisy_link_does_not_keep_the_unit_from_its_timers() {
    let mut table = Table::new(4096);
    table.say_hello();
    table.settle();
    table.heard();
    table.board.link.incoming.extend([0x55].repeat(100_000));
    table.board.now = table.board.now.after(HEARTBEAT);
    turn(&mut table.board, &mut table.unit);
    assert!(!table.board.link.incoming.is_empty());
    let heartbeat = |message: &ToHost| matches!(message, ToHost::Heartbeat(_));
    assert!(table.heard().iter().any(heartbeat));
}

#[test]
fn the_sensors_bytes_reach_the_unit() {
    let mut table = Table::new(4096);
    table.say_hello();
    table.settle();
    let mut bytes = vec![0xaa; 100];
    bytes.push(0);
    let mut frame = Outbox::<FRAMED>::new();
    send(&Sample::Nothing(5), &mut frame).expect("a sample fits");
    bytes.extend(frame.waiting());
    table.board.sensor.incoming.extend(&bytes);
    let mut sensed = 0;
    while !table.board.sensor.incoming.is_empty() {
        sensed += turn(&mut table.board, &mut table.unit).sensed;
    }
    assert_eq!(sensed, bytes.len());
    table.say(&ToUnit::AskHand);
    table.settle();
    let statistics = table.heard().into_iter().find_map(|message| match message {
        ToHost::HandStatistics(statistics) => Some(statistics.samples),
        _ => None,
    });
    // Noise, and a sample before there is a vocabulary.
    let counted = statistics.map(|samples| (samples.damaged, samples.unready));
    assert_eq!(counted, Some((1, 1)));
}
