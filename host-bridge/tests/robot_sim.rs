//! The simulated arm does what it is told step by step, stops at any moment, and leaves the table as
//! it made it.

#[path = "common/bench.rs"]
mod bench;

use bench::*;
use deictic::robot::{CommandId, Event, Refusal, Robot};
use deictic::scene::Change;
use deictic_core::category::Category;
use deictic_core::intent::Parameter;
use deictic_core::time::Micros;

#[test]
fn a_pick_is_approach_lower_grasp_and_lift() {
    let mut bench = Bench::new();
    let events = bench.run("pick", &[(O, "can")]);
    assert_eq!(
        steps(&events),
        [
            "open the hand",
            "approach the can",
            "lower to the can",
            "grasp the can",
            "lift the can"
        ]
    );
    assert_eq!(bench.sim.holding(), Some("can"));
    assert!(bench.is_at("can", [0.45, 0.10, 0.21]));
}

#[test]
fn progress_goes_from_nothing_to_everything() {
    let mut bench = Bench::new();
    bench.begin("pick", &[(O, "can")]).unwrap();
    assert_eq!(bench.sim.progress(bench.now).unwrap().1, 0);
    let mut last = 0;
    while let Some((_, percent)) = bench.sim.progress(bench.now) {
        assert!(percent >= last && percent <= 100);
        last = percent;
        bench.now = bench.now.after(Micros::from_millis(100));
        bench.sim.poll(bench.now);
    }
    assert!(last > 90);
}

#[test]
fn what_a_command_does_is_there_for_the_next_one() {
    let mut bench = Bench::new();
    assert_eq!(
        bench.begin("pick", &[(O, "box")]),
        Err(Refusal::Glued("box".into()))
    );
    bench.run("unglue", &[(O, "box")]);
    assert_eq!(bench.feature(O, "box", "glued"), 0.0);
    bench.run("put-into", &[(O, "box"), (S, "drawer")]);
    assert_eq!(bench.feature(S, "drawer", "full-container"), 1.0);
    assert!(bench.is_at("box", [0.5, -0.34, 0.08]));
    assert_eq!(bench.sim.holding(), None);
    let full = bench.begin("put-into", &[(O, "can"), (S, "drawer")]);
    assert_eq!(full, Err(Refusal::Full("drawer".into())));
    bench.run("pick", &[(O, "box")]);
    assert_eq!(bench.feature(S, "drawer", "full-container"), 0.0);
    bench.run("stack", &[(O, "box"), (S, "crackers")]);
    assert_eq!(bench.feature(S, "crackers", "full-stack"), 1.0);
    let covered = bench.begin("stack", &[(O, "cube"), (S, "crackers")]);
    assert_eq!(covered, Err(Refusal::Covered("crackers".into())));
}

#[test]
fn pouring_empties_one_and_fills_the_other() {
    let mut bench = Bench::new();
    let events = bench.run("pour", &[(O, "can"), (S, "bowl")]);
    assert!(steps(&events).contains(&"tilt the can by 90 degrees"));
    assert_eq!(bench.feature(O, "can", "full-liquid"), 0.0);
    assert_eq!(bench.feature(S, "bowl", "full-liquid"), 1.0);
    assert!(bench.is_at("can", [0.45, 0.10, 0.06]));
    let empty = bench.begin("pour", &[(O, "can"), (S, "bowl")]);
    assert_eq!(empty, Err(Refusal::Empty("can".into())));
}

#[test]
fn pushing_moves_a_thing_where_it_was_said() {
    let mut bench = Bench::new();
    bench.run("push", &[(O, "cube"), (Category::DIRECTION, "left")]);
    assert!(bench.is_at("cube", [0.52, 0.34, 0.02]));
    bench.run("push", &[(O, "can"), (Category::DIRECTION, "back")]);
    assert!(bench.is_at("can", [0.35, 0.10, 0.06]));
    let mut far = bench.intent("push", &[(O, "cube"), (Category::DIRECTION, "forward")]);
    let distance = bench
        .lexicon
        .option(Category::DISTANCE, "distance")
        .unwrap();
    let (category, option, quantity) = (Category::DISTANCE, distance, Some(0.4));
    far.parameters
        .push(Parameter {
            category,
            option,
            quantity,
        })
        .unwrap();
    let version = bench.table.version();
    assert!(matches!(
        bench.begin_as(9, version, far.clone()),
        Err(Refusal::OutOfReach(_))
    ));
    for bad in [f32::NAN, f32::INFINITY, -1.0, 3.0] {
        far.parameters.last_mut().unwrap().quantity = Some(bad);
        assert!(matches!(
            bench.begin_as(9, version, far.clone()),
            Err(Refusal::TooFar(_))
        ));
    }
}

#[test]
fn a_stop_stops_at_every_moment_and_keeps_what_the_hand_holds() {
    for tenth in 0..200 {
        let mut bench = Bench::new();
        bench
            .begin("put-into", &[(O, "can"), (S, "drawer")])
            .unwrap();
        bench.now = bench.now.after(Micros::from_millis(100 * tenth));
        bench.number += 1;
        let stop = bench.intent("stop", &[]);
        bench.begin_as(bench.number, 999, stop).unwrap();
        let events = bench.pass(0);
        let id = CommandId { run: 1, number: 1 };
        let over = events.contains(&Event::Done(id));
        let stopped = events
            .iter()
            .any(|e| matches!(e, Event::Stopped { id: i, .. } if *i == id));
        assert!(over != stopped, "{tenth}");
        assert_eq!(bench.pass(60), [], "nothing moves after a stop");
        if stopped && bench.sim.holding() == Some("can") {
            let moved = events.iter().rev().find_map(|e| match e {
                Event::Changed { changes, .. } => changes.last().cloned(),
                _ => None,
            });
            assert!(matches!(moved, Some(Change::Moved { .. })));
            bench.run("put-into", &[(O, "can"), (S, "bowl")]);
        }
    }
}
