//! Motions end where they are to end, keep to the limits of a Panda's joints all the way, and are
//! refused where the arm cannot make them.

#[path = "common/bench.rs"]
mod bench;

use bench::*;
use deictic::robot::panda::{Joints, PANDA, hand, skeleton};
use deictic::robot::{CommandId, Event, Posture, Refusal, Robot};
use deictic::scene::Change;
use deictic_core::category::Category;
use deictic_core::large::Intent;
use deictic_core::time::Micros;

/// How fast the hand goes at most beside a person, in m/s.
const HAND: f64 = 0.25;

fn joints(posture: &Posture) -> Joints {
    posture.joints.map(f64::from)
}

/// Runs a command millisecond by millisecond and holds every posture against the limits; gives the
/// posture at its end.
fn watch(bench: &mut Bench, action: &str, things: &[(Category, &str)]) -> Posture {
    bench.begin(action, things).unwrap();
    let mut before: Option<(Posture, Joints)> = None;
    loop {
        let posture = bench.sim.posture(bench.now).unwrap();
        let arm = skeleton(&joints(&posture));
        assert!(PANDA.hold(&joints(&posture), 0.0), "{action}: {posture:?}");
        assert!(arm.lowest() > 0.0, "{action}: into the table");
        let mut speeds = [0.0; 7];
        if let Some((last, last_speeds)) = before {
            for (i, speed) in speeds.iter_mut().enumerate() {
                *speed = (joints(&posture)[i] - joints(&last)[i]) * 1e3;
                assert!(speed.abs() < PANDA.speed[i], "{action}: joint {i}");
                let jolt = (*speed - last_speeds[i]) * 1e3;
                assert!(jolt.abs() < PANDA.acceleration[i], "{action}: joint {i}");
            }
            let way = arm.hand.translation.vector - hand(&joints(&last)).translation.vector;
            assert!(
                way.norm() * 1e3 < HAND * 1.05,
                "{action}: {}",
                way.norm() * 1e3
            );
        }
        before = Some((posture, speeds));
        bench.now = bench.now.after(Micros::from_millis(1));
        let events = bench.pass(0);
        if events.iter().any(|e| matches!(e, Event::Done(_))) {
            return posture;
        }
    }
}

fn off(posture: &Posture, place: [f32; 3]) -> f64 {
    let hand = hand(&joints(posture)).translation;
    let off = hand.vector.iter().zip(place).map(|(a, b)| a - f64::from(b));
    off.map(|d| d * d).sum::<f64>().sqrt()
}

#[test]
fn every_motion_keeps_to_the_limits_and_ends_within_5_mm() {
    let mut bench = Bench::new();
    let end = watch(&mut bench, "pick", &[(O, "can")]);
    assert!(off(&end, [0.45, 0.10, 0.21]) < 5e-3);
    let end = watch(&mut bench, "pour", &[(O, "can"), (S, "bowl")]);
    assert!(off(&end, [0.45, 0.10, 0.21]) < 5e-3);
    let end = watch(&mut bench, "move-up", &[]);
    assert!(off(&end, [0.45, 0.10, 0.31]) < 5e-3);
    let end = watch(&mut bench, "put-into", &[(O, "can"), (S, "drawer")]);
    assert!(off(&end, [0.50, -0.34, 0.23]) < 5e-3);
    let end = watch(&mut bench, "unglue", &[(O, "box")]);
    assert!(off(&end, [0.58, -0.02, 0.20]) < 5e-3);
    watch(
        &mut bench,
        "push",
        &[(O, "cube"), (Category::DIRECTION, "left")],
    );
    assert!(bench.is_at("cube", [0.52, 0.34, 0.02]));
    let end = watch(&mut bench, "stack", &[(O, "cube"), (S, "crackers")]);
    assert!(off(&end, [0.62, 0.18, 0.22 + 0.15]) < 5e-3);
    assert!(bench.is_at("cube", [0.62, 0.18, 0.22]));
    watch(&mut bench, "pick", &[(O, "cup")]);
    watch(&mut bench, "release", &[]);
    assert!(bench.is_at("cup", [0.40, -0.12, 0.05]));
}

#[test]
fn things_are_fetched_from_all_over_the_table() {
    let mut asked = 0;
    for i in 0..9 {
        for j in 0..9 {
            let (x, y) = (0.34 + 0.04 * i as f32, -0.4 + 0.1 * j as f32);
            if x * x + y * y > 0.62 * 0.62 {
                continue;
            }
            let mut bench = Bench::new();
            let moved = Change::Moved {
                thing: "cube".into(),
                position: [x, y, 0.02],
            };
            bench.table.apply(&[moved], &bench.lexicon).unwrap();
            bench.run("pick", &[(O, "cube")]);
            assert!(bench.is_at("cube", [x, y, 0.17]), "({x}, {y})");
            asked += 1;
        }
    }
    assert!(asked > 40, "{asked}");
}

#[test]
fn what_is_let_go_comes_to_rest_on_what_is_below() {
    let mut bench = Bench::new();
    bench.run("pick", &[(O, "cube")]);
    let over = |place: [f32; 3]| Change::Moved {
        thing: "cup".into(),
        position: place,
    };
    // Somebody puts the cup where the cube would go down.
    bench
        .table
        .apply(&[over([0.52, 0.24, 0.05])], &bench.lexicon)
        .unwrap();
    bench.run("release", &[]);
    assert!(bench.is_at("cube", [0.52, 0.24, 0.12]));
    assert_eq!(bench.feature(O, "cup", "full-stack"), 1.0);
    let covered = bench.begin("pick", &[(O, "cup")]);
    assert_eq!(covered, Err(Refusal::Covered("cup".into())));
    bench.run("pick", &[(O, "cube")]);
    assert_eq!(bench.feature(O, "cup", "full-stack"), 0.0);
    bench.run("put-into", &[(O, "cube"), (S, "drawer")]);
    bench.run("pick", &[(O, "cup")]);
}

#[test]
fn nothing_is_pushed_into_something_else() {
    let mut bench = Bench::new();
    let beside = Change::Moved {
        thing: "cup".into(),
        position: [0.53, 0.32, 0.05],
    };
    bench.table.apply(&[beside], &bench.lexicon).unwrap();
    let left = [(O, "cube"), (Category::DIRECTION, "left")];
    let refused = bench.begin("push", &left);
    assert_eq!(refused, Err(Refusal::InTheWay("cup".into())));
    bench.run("push", &[(O, "cube"), (Category::DIRECTION, "back")]);
}

#[test]
fn a_command_is_held_and_goes_on_where_it_was() {
    let mut bench = Bench::new();
    assert_eq!(bench.sim.hold(bench.now), Err(Refusal::Idle));
    bench.begin("pick", &[(O, "can")]).unwrap();
    bench.pass(2);
    bench.sim.hold(bench.now).unwrap();
    bench.sim.hold(bench.now).unwrap();
    let id = CommandId { run: 1, number: 1 };
    assert_eq!(bench.pass(0), [Event::Held(id)], "told once");
    let stands = bench.sim.posture(bench.now);
    let progress = bench.sim.progress(bench.now);
    assert_eq!(bench.pass(60), []);
    assert_eq!(bench.sim.posture(bench.now), stands);
    assert_eq!(bench.sim.progress(bench.now), progress);
    bench.sim.resume(bench.now).unwrap();
    assert_eq!(bench.sim.posture(bench.now), stands);
    assert_eq!(bench.sim.resume(bench.now), Err(Refusal::NotHeld));
    let events = bench.pass(60);
    assert_eq!(events.first(), Some(&Event::Resumed(id)));
    assert_eq!(events.last(), Some(&Event::Done(id)));
}

#[test]
fn the_arm_goes_home_once() {
    let mut bench = Bench::new();
    bench.run("pick", &[(O, "can")]);
    let id = CommandId { run: 1, number: 9 };
    bench.sim.home(bench.now, id).unwrap();
    assert_eq!(bench.sim.home(bench.now, id), Err(Refusal::Repeated));
    let events = bench.pass(60);
    assert_eq!(events.last(), Some(&Event::Done(id)));
    let posture = bench.sim.posture(bench.now).unwrap();
    assert!(off(&posture, [0.307, 0.0, 0.487]) < 5e-3);
    assert!(bench.is_at("can", [0.307, 0.0, 0.487]));
}

fn with_quantity(bench: &Bench, mut intent: Intent, name: &str, quantity: f32) -> Intent {
    let category = if name == "angle" {
        Category::ANGLE
    } else {
        Category::DISTANCE
    };
    bench.give(&mut intent, category, name, Some(quantity));
    intent
}

#[test]
fn what_the_arm_cannot_reach_is_refused_before_it_moves() {
    let mut bench = Bench::new();
    let version = bench.table.version();
    let up = bench.intent("move-up", &[]);
    let up = with_quantity(&bench, up, "distance", 0.5);
    let refused = bench.begin_as(1, version, up);
    assert_eq!(refused, Err(Refusal::OutOfReach("place up there".into())));
    let pour = bench.intent("pour", &[(O, "can"), (S, "bowl")]);
    let over = with_quantity(&bench, pour.clone(), "angle", core::f32::consts::PI);
    let refused = bench.begin_as(2, version, over);
    assert_eq!(refused, Err(Refusal::OutOfReach("bowl".into())));
    assert_eq!(bench.sim.progress(bench.now), None);
    for degrees in [20.0_f32, 60.0, 90.0, 110.0] {
        let mut bench = Bench::new();
        let pour = with_quantity(&bench, pour.clone(), "angle", degrees.to_radians());
        bench.begin_as(1, version, pour).unwrap();
        assert!(matches!(bench.pass(120).last(), Some(Event::Done(_))));
    }
}
