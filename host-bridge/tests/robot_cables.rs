//! A cable that is pulled at every step of a command, over each kind of line: the arm stands soon, the person is told,
//! nothing goes on by itself when it is plugged in again, and the next command is done. On a CAN bus:
//! `robot_can_faults.rs`.
#![cfg(target_os = "linux")]

#[path = "common/relay.rs"]
mod relay;
#[path = "common/trial.rs"]
mod trial;

use std::thread;
use std::time::Duration;

use deictic::link::Pair;
use deictic::robot::end::Listener;
use deictic::robot::{Event, Fault};
use relay::Relay;
use trial::{Far, Near, lost};

const COMMAND: &str = "put-into can drawer";

/// How many steps it has.
const STEPS: usize = 9;

fn listener(kind: &str) -> Listener {
    match kind {
        "tcp" => Listener::open(&"tcp:127.0.0.1:0".parse().unwrap()).unwrap(),
        kind => Listener::Pair {
            pair: Pair::open().unwrap(),
            adapter: kind == "slcan",
        },
    }
}

/// A busy machine may stall so long by itself that the robot counts as lost; so often it is tried again.
const TRIALS: usize = 10;

/// Pulls the cable of a link in the step of this number.
fn pulled(kind: &str, step: usize) {
    let reached = (0..TRIALS).any(|_| tried(kind, step));
    assert!(reached, "{kind}: lost before step {step}, every time");
}

/// The same once; `false` where the link was lost before that step.
fn tried(kind: &str, step: usize) -> bool {
    let far = Far::hasty(listener(kind), 8.0);
    let relay = Relay::to(&far.way);
    let mut near = Near::to(&relay.way);
    let id = near.begin(COMMAND);
    let at =
        |e: &Event| matches!(e, Event::Begun { number, of, .. } if *number == step && *of == STEPS);
    let lost_before = |e: &Event| {
        matches!(
            e,
            Event::Failed {
                fault: Fault::RobotLost,
                ..
            }
        )
    };
    let before = near.until(|e| at(e) || lost_before(e));
    if !before.iter().any(at) {
        return false;
    }
    relay.plug(false);
    let happened = near.until_end(id);
    // The last step may have been done just before.
    let done = step == STEPS && happened.last() == Some(&Event::Done(id));
    assert!(lost(&happened) || done, "{kind}, step {step}: {happened:?}");
    thread::sleep(Duration::from_millis(450));
    assert!(!far.is_moving(), "{kind}, step {step}: nobody is heard");
    relay.plug(true);
    near.pass(Duration::from_millis(1_500));
    assert!(
        !far.is_moving(),
        "{kind}, step {step}: it goes on by itself"
    );
    near.moves_up();
    true
}

#[test]
fn the_cable_may_be_pulled_at_every_step_over_every_line() {
    let links = ["tcp", "serial", "slcan"]
        .map(|kind| thread::spawn(move || (1..=STEPS).for_each(|step| pulled(kind, step))));
    for link in links {
        link.join().unwrap();
    }
}
