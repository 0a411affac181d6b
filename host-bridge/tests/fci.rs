//! The arm's own network interface: intents become joint motions at a thousand commands a second, a
//! stop comes to rest on the way, a hold too and goes on, nothing is done twice. Against FCI version 5
//! on loopback; `cargo xtask fci` does version 10.

#[path = "common/lab.rs"]
mod lab;

use std::time::Duration;

use deictic::robot::{CommandId, Event, Refusal, Robot};
use deictic::scene::Measures;
use lab::bench::O;
use lab::{Lab, NOW};

#[test]
fn a_pick_ends_where_it_should_within_the_limits_of_speed() {
    let mut lab = Lab::new();
    assert_eq!(lab.fer.state().collision_behaviour, 1);
    lab.begin("pick", &[(O, "can")]).unwrap();
    assert_eq!(lab.ending(), Event::Done(CommandId { run: 1, number: 1 }));
    assert!(lab.hand_is_off([0.45, 0.10, 0.21]) < 5e-3);
    assert_eq!(lab.fci.holding(), Some("can"));
    assert!(lab.bench.is_at("can", [0.45, 0.10, 0.21]));
    let fastest = lab.fer.state().fastest * 1e3;
    assert!(fastest > 0.05 && fastest < 2.175, "{fastest} rad/s");
}

#[test]
fn a_command_that_comes_twice_is_done_once() {
    let mut lab = Lab::new();
    let up = lab.bench.intent("move-up", &[]);
    lab.give(1, up.clone()).unwrap();
    assert_eq!(lab.give(1, up.clone()), Err(Refusal::Repeated));
    let busy = lab.give(2, up.clone());
    assert_eq!(busy, Err(Refusal::Busy));
    assert!(matches!(lab.ending(), Event::Done(_)));
    assert_eq!(lab.give(1, up), Err(Refusal::Repeated));
    assert!(lab.hand_is_off([0.307, 0.0, 0.587]) < 5e-3);
}

#[test]
fn a_stop_comes_to_rest_on_the_way() {
    let mut lab = Lab::new();
    lab.begin("move-up", &[]).unwrap();
    lab.until(|e| matches!(e, Event::Begun { .. }));
    while lab.fer.state().cycles < 300 {
        std::thread::sleep(Duration::from_millis(1));
    }
    lab.begin("stop", &[]).unwrap();
    let stop = CommandId { run: 1, number: 2 };
    let events = lab.until(|e| *e == Event::Done(stop));
    let stopped = |e: &Event| matches!(e, Event::Stopped { id, .. } if id.number == 1);
    assert!(events.iter().any(stopped), "stands before it is done");
    let rest = lab.fer.state().q;
    assert!(lab.hand_is_off([0.307, 0.0, 0.587]) > 5e-3, "on the way");
    std::thread::sleep(Duration::from_millis(50));
    assert_eq!(lab.fer.state().q, rest);
    lab.begin("move-up", &[]).unwrap();
    assert!(matches!(lab.ending(), Event::Done(_)));
}

/// An arm with mass cannot stand still at once. Counted in its own control periods, each of which has a state with a
/// number and a command that answers it, it stands 250 after the stop, and two for what was under way.
#[test]
fn an_arm_that_is_stopped_stands_after_a_quarter_of_a_second() {
    let mut lab = Lab::new();
    lab.begin("move-up", &[]).unwrap();
    while lab.fer.state().strides.len() < 500 {
        lab.poll();
        std::thread::sleep(Duration::from_millis(1));
    }
    let told = {
        // While this is held, the arm tells no state.
        let state = lab.fer.state();
        lab.fci.stop(NOW);
        state.told
    };
    assert!(matches!(lab.ending(), Event::Stopped { .. }));
    let state = lab.fer.state();
    let (last, stride) = state.strides.last().copied().unwrap();
    assert!(last > told + 50, "it brakes before it stands");
    assert!(last - told <= 250 + 2, "it stands after {}", last - told);
    assert!(
        stride < 1e-2 * state.fastest,
        "{stride} of {}",
        state.fastest
    );
}

#[test]
fn a_held_arm_stands_on_its_way_and_goes_on_with_the_rest_of_the_plan() {
    let mut lab = Lab::new();
    lab.begin("pick", &[(O, "can")]).unwrap();
    lab.until(|e| matches!(e, Event::Begun { number: 2, .. }));
    let cycles = lab.fer.state().cycles;
    while lab.fer.state().cycles < cycles + 300 {
        std::thread::sleep(Duration::from_millis(1));
    }
    let id = CommandId { run: 1, number: 1 };
    lab.fci.hold(NOW).unwrap();
    lab.until(|e| *e == Event::Held(id));
    let rest = lab.fer.state().q;
    std::thread::sleep(Duration::from_millis(100));
    let moved = rest
        .iter()
        .zip(lab.fer.state().q)
        .map(|(a, b)| (a - b).abs());
    assert!(moved.fold(0.0, f64::max) < 1e-9, "it stands");
    assert_eq!(lab.poll(), []);
    lab.fci.resume(NOW).unwrap();
    let events = lab.until(|e| matches!(e, Event::Done(_) | Event::Failed { .. }));
    assert_eq!(events.first(), Some(&Event::Resumed(id)));
    assert_eq!(events.last(), Some(&Event::Done(id)));
    assert!(lab.hand_is_off([0.45, 0.10, 0.21]) < 5e-3);
    assert_eq!(lab.fci.resume(NOW), Err(Refusal::NotHeld));
    assert_eq!(lab.fci.hold(NOW), Err(Refusal::Idle));
}

#[test]
fn a_stop_ends_what_is_held() {
    let mut lab = Lab::new();
    lab.begin("move-up", &[]).unwrap();
    lab.until(|e| matches!(e, Event::Begun { .. }));
    lab.fci.hold(NOW).unwrap();
    lab.until(|e| matches!(e, Event::Held(_)));
    lab.fci.stop(NOW);
    assert!(matches!(lab.ending(), Event::Stopped { .. }));
    lab.begin("move-up", &[]).unwrap();
    assert!(matches!(lab.ending(), Event::Done(_)));
}

#[test]
fn an_arm_is_told_what_it_carries_where_the_table_says_so() {
    let mut lab = Lab::new();
    let mass = |kilograms| Measures {
        mass: Some(kilograms),
        ..Measures::default()
    };
    let measures = [("can", 0.35), ("cube", 3.5)].map(|(n, kg)| (n.to_owned(), mass(kg)));
    lab.bench.table = lab.bench.table.clone().with_measures(measures.into());
    lab.begin("pick", &[(O, "can")]).unwrap();
    assert!(matches!(lab.ending(), Event::Done(_)));
    let told = lab.fer.state().loads.clone();
    assert!(told.len() == 1 && (told[0] - 0.35).abs() < 1e-6, "{told:?}");
    lab.begin("release", &[]).unwrap();
    assert!(matches!(lab.ending(), Event::Done(_)));
    assert_eq!(lab.fer.state().loads.last(), Some(&0.0));
    // Nobody says what the cup weighs.
    lab.begin("pick", &[(O, "cup")]).unwrap();
    assert!(matches!(lab.ending(), Event::Done(_)));
    assert_eq!(lab.fer.state().loads.len(), 2);
    lab.begin("release", &[]).unwrap();
    assert!(matches!(lab.ending(), Event::Done(_)));
    let heavy = lab.begin("pick", &[(O, "cube")]);
    assert_eq!(heavy, Err(Refusal::TooHeavy("cube".into())));
}
