//! What a person tells the robot past the unit: hold, resume, home, clear.

mod common;

use std::time::Duration;

use common::*;
use deictic::clock::Simulated;
use deictic::robot::{Event, Refusal};
use deictic::session::journal::{Became, Journal};
use deictic::session::{Happening, Order, Session};

fn begun(h: &Happening) -> bool {
    matches!(h, Happening::Robot(Event::Begun { number: 2, .. }))
}

/// A session whose robot is held in the middle of picking the can.
fn held<'a>(cable: &Cable, lexicon: &'a deictic::vocabulary::Lexicon) -> Session<'a> {
    let mut session = open(cable, lexicon, 5.0);
    session.observe(surely_said("pick can", lexicon)).unwrap();
    until(&mut session, begun);
    session.order(Order::Hold).unwrap();
    until(&mut session, |h| {
        matches!(h, Happening::Robot(Event::Held(_)))
    });
    assert!(session.is_held());
    session
}

#[test]
fn a_text_is_an_order_only_word_for_word() {
    for (text, order) in [
        ("hold", Some(Order::Hold)),
        ("Go on!", Some(Order::Resume)),
        ("home.", Some(Order::Home)),
        ("clear", Some(Order::Clear)),
        ("hold the can", None),
        ("put it home", None),
        ("", None),
    ] {
        assert_eq!(Order::of(text), order, "{text}");
    }
}

#[test]
fn a_held_robot_does_not_count_as_hanging_and_goes_on() {
    let clock = Simulated::start();
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 5.0);
    session.observe(surely_said("pick can", &lexicon)).unwrap();
    let turn = |session: &mut Session<'_>, times: usize| {
        let mut all = Vec::new();
        for _ in 0..times {
            all.extend(session.turn(Duration::from_millis(1)));
            clock.advance(Duration::from_millis(10));
        }
        all
    };
    let mut happened = Vec::new();
    while !happened.iter().any(begun) {
        happened.extend(turn(&mut session, 1));
    }
    session.order(Order::Hold).unwrap();
    for _ in 0..300 {
        let quiet = turn(&mut session, 1);
        assert!(!quiet.iter().any(|h| matches!(h, Happening::Hanging(_))));
        clock.advance(Duration::from_secs(1));
    }
    assert!(session.is_held());
    session.order(Order::Resume).unwrap();
    let happened = turn(&mut session, 2_000);
    assert!(happened.iter().any(is_done), "{happened:#?}");
    assert!(session.is_idle());
}

#[test]
fn what_is_held_goes_on_only_on_the_table_that_it_was_held_on() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = held(&cable, &lexicon);
    let mut things = session.table().scene().entities().to_vec();
    things.pop();
    session.lay(things).unwrap();
    assert_eq!(session.order(Order::Resume), Err(Refusal::Relaid));
    session.stop();
    let happened = settle(&mut session);
    let stopped = |h: &Happening| matches!(h, Happening::Robot(Event::Stopped { .. }));
    assert!(happened.iter().any(stopped), "{happened:#?}");
    assert!(!session.is_held());
}

#[test]
fn a_lost_unit_stops_a_held_robot() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = held(&cable, &lexicon);
    cable.with(|line| line.cut = true);
    let stopped = |h: &Happening| matches!(h, Happening::Robot(Event::Stopped { .. }));
    until(&mut session, stopped);
    assert_eq!(session.order(Order::Resume), Err(Refusal::NotHeld));
}

#[test]
fn the_way_home_is_a_command_on_record() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    let ready = session.posture().unwrap();
    session.observe(surely_said("move-up", &lexicon)).unwrap();
    settle(&mut session);
    assert_ne!(session.posture().unwrap(), ready);
    session.order(Order::Home).unwrap();
    assert_eq!(session.order(Order::Home), Err(Refusal::Busy));
    let (mut journal, mut records) = (Journal::default(), Vec::new());
    for happening in settle(&mut session) {
        records.extend(journal.hear(&happening, &lexicon));
    }
    let apart = session
        .posture()
        .unwrap()
        .joints
        .into_iter()
        .zip(ready.joints);
    assert!(apart.into_iter().all(|(a, b)| (a - b).abs() < 1e-3));
    let [record] = &records[..] else {
        panic!("{records:?}");
    };
    assert_eq!((record.became, record.steps), (Became::Done, 1));
    assert_eq!(record.intent.action, "home");
    assert_eq!(record.decision, None);
}

#[test]
fn what_makes_no_sense_is_refused_with_a_reason() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 5.0);
    assert_eq!(session.order(Order::Hold), Err(Refusal::Idle));
    assert_eq!(session.order(Order::Resume), Err(Refusal::NotHeld));
    assert_eq!(session.order(Order::Clear), Ok(()));
    session.observe(surely_said("pick can", &lexicon)).unwrap();
    until(&mut session, begun);
    assert_eq!(session.order(Order::Clear), Err(Refusal::Busy));
    assert_eq!(session.order(Order::Home), Err(Refusal::Busy));
}

#[test]
fn the_program_takes_orders_as_typed_lines() {
    use std::io::{BufRead, BufReader, Write};
    use std::process::{Command, Stdio};
    let mut program = Command::new(env!("CARGO_BIN_EXE_deictic"))
        .args([
            "run", "--board", "inside", "--haste", "2", "--window", "50", "--json",
        ])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = program.stdin.take().unwrap();
    let mut lines = BufReader::new(program.stdout.take().unwrap()).lines();
    let mut until = |event: &str| {
        let wanted = format!("\"event\":\"{event}\"");
        let found = lines
            .by_ref()
            .map_while(Result::ok)
            .find(|l| l.contains(&wanted));
        found.unwrap_or_else(|| panic!("no {event}"))
    };
    input.write_all(b"pick the can\n").unwrap();
    until("step");
    input.write_all(b"hold\n").unwrap();
    until("held");
    input.write_all(b"go on\n").unwrap();
    until("resumed");
    until("done");
    input.write_all(b"resume\n").unwrap();
    assert!(until("declined").contains("not held"));
    input.write_all(b"home\n").unwrap();
    until("homing");
    until("done");
    drop(input);
    assert!(program.wait().unwrap().success());
}
