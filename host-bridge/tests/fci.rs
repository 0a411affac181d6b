//! The arm's own network interface: intents become joint motions at a thousand commands a second, a
//! stop comes to rest on the way, every reflex is a typed fault, nothing is done twice, and a broken
//! connection is made again. Against FCI version 5 on loopback; `fci_simulated.rs` does version 10.

#[path = "common/bench.rs"]
mod bench;
#[path = "common/fer.rs"]
mod fer;

use std::time::{Duration, Instant};

use bench::*;
use deictic::robot::fci::{Fci, FciFault};
use deictic::robot::panda::hand;
use deictic::robot::{Command, CommandId, Event, Fault, Refusal, Robot, Taken, World};
use deictic_core::category::Category;
use deictic_core::large::Intent;
use deictic_core::time::Micros;
use fer::{Fer, Trouble};
use franka::Errors;

/// An arm, the bridge's side of it, and a table.
struct Lab {
    fer: Fer,
    fci: Fci,
    bench: Bench,
    number: u32,
}

const NOW: Micros = Micros(0);

impl Lab {
    fn new() -> Self {
        let fer = Fer::start();
        let fci = Fci::connect(&fer.arm, &fer.hand, false).unwrap();
        let (bench, number) = (Bench::new(), 0);
        Self {
            fer,
            fci,
            bench,
            number,
        }
    }

    fn give(&mut self, number: u32, intent: Intent) -> Result<Taken, Refusal> {
        let id = CommandId { run: 1, number };
        let world = World {
            table: &self.bench.table,
            lexicon: &self.bench.lexicon,
        };
        let scene = self.bench.table.version();
        self.fci.begin(NOW, &Command { id, intent, scene }, world)
    }

    fn begin(&mut self, action: &str, things: &[(Category, &str)]) -> Result<Taken, Refusal> {
        self.number += 1;
        let intent = self.bench.intent(action, things);
        self.give(self.number, intent)
    }

    fn poll(&mut self) -> Vec<Event> {
        let events = self.fci.poll(NOW);
        for event in &events {
            if let Event::Changed { changes, .. } = event {
                let lexicon = &self.bench.lexicon;
                self.bench.table.apply(changes, lexicon).unwrap();
            }
        }
        events
    }

    /// All events up to one that `is_last` accepts.
    fn until(&mut self, is_last: impl Fn(&Event) -> bool) -> Vec<Event> {
        let patience = Instant::now() + Duration::from_secs(60);
        let mut all = Vec::new();
        while Instant::now() < patience {
            for event in self.poll() {
                let last = is_last(&event);
                all.push(event);
                if last {
                    return all;
                }
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        panic!("it does not come; so far {all:#?}");
    }

    fn ending(&mut self) -> Event {
        let all = self.until(|e| {
            matches!(
                e,
                Event::Done(_) | Event::Stopped { .. } | Event::Failed { .. }
            )
        });
        all.last().unwrap().clone()
    }

    fn hand_is_off(&self, place: [f64; 3]) -> f64 {
        let at = hand(&self.fer.state().q).translation.vector;
        let off = at.iter().zip(place).map(|(a, b)| (a - b) * (a - b));
        off.sum::<f64>().sqrt()
    }
}

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

#[test]
fn a_reflex_fails_the_command_and_the_next_one_recovers() {
    for (name, fault) in [
        ("joint_reflex", Fault::Collision),
        ("cartesian_reflex", Fault::Collision),
        ("joint_velocity_violation", Fault::SpeedLimit),
        ("joint_position_limits_violation", Fault::JointLimit),
        ("communication_constraints_violation", Fault::HostLost),
    ] {
        let mut lab = Lab::new();
        let error = Errors::index_of(name).unwrap();
        lab.fer.trouble(Trouble::Reflex(error, 100));
        lab.begin("move-up", &[]).unwrap();
        let Event::Failed {
            fault: told, why, ..
        } = lab.ending()
        else {
            panic!("{name} went unnoticed");
        };
        assert_eq!(told, fault, "{name}: {why}");
        let cycles = lab.fer.state().cycles;
        std::thread::sleep(Duration::from_millis(30));
        assert_eq!(lab.fer.state().cycles, cycles, "nothing moves after it");
        lab.begin("move-up", &[]).unwrap();
        assert!(matches!(lab.ending(), Event::Done(_)), "{name}");
        assert_eq!(lab.fer.state().recovered, 1);
    }
}

#[test]
fn a_hand_that_finds_nothing_says_so() {
    let mut lab = Lab::new();
    lab.fer.trouble(Trouble::EmptyHand);
    lab.begin("pick", &[(O, "can")]).unwrap();
    let Event::Failed { fault, .. } = lab.ending() else {
        panic!("nothing was grasped");
    };
    assert_eq!(fault, Fault::GraspLost);
    assert_eq!(lab.fci.holding(), None);
}

#[test]
fn what_the_hand_holds_is_where_the_arm_stopped_at_a_fault() {
    let mut lab = Lab::new();
    lab.begin("pick", &[(O, "can")]).unwrap();
    assert!(matches!(lab.ending(), Event::Done(_)));
    let error = Errors::index_of("joint_reflex").unwrap();
    lab.fer.trouble(Trouble::Reflex(error, 600));
    lab.begin("move-up", &[]).unwrap();
    assert!(matches!(lab.ending(), Event::Failed { .. }));
    let can = lab.bench.position("can").map(f64::from);
    assert!(can[2] > 0.211, "it has moved: {can:?}");
    assert!(lab.hand_is_off(can) < 5e-3, "{can:?}");
    assert_eq!(lab.fci.holding(), Some("can"));
}

#[test]
fn an_arm_that_came_to_rest_short_of_the_end_is_brought_there() {
    let mut lab = Lab::new();
    lab.begin("move-up", &[]).unwrap();
    assert!(matches!(lab.ending(), Event::Done(_)));
    // The next one is about as long, and loses what comes after three quarters of it.
    let cycles = lab.fer.state().cycles;
    lab.fer.trouble(Trouble::Short(cycles * 3 / 4));
    lab.begin("move-up", &[]).unwrap();
    let ending = lab.ending();
    assert!(matches!(ending, Event::Done(_)), "{ending:?}");
    assert_eq!(lab.fer.state().trouble, Trouble::None, "it was short once");
    assert!(lab.hand_is_off([0.307, 0.0, 0.687]) < 5e-3);
}

#[test]
fn a_pressed_stop_moves_nothing() {
    let mut lab = Lab::new();
    lab.fer.trouble(Trouble::Pressed);
    lab.begin("move-up", &[]).unwrap();
    assert!(matches!(lab.ending(), Event::Failed { .. }));
    assert_eq!(lab.fer.state().cycles, 0);
    lab.fer.trouble(Trouble::None);
    lab.begin("move-up", &[]).unwrap();
    assert!(matches!(lab.ending(), Event::Done(_)));
}

#[test]
fn a_broken_connection_ends_the_command_and_is_made_again() {
    for trouble in [Trouble::Cut(150), Trouble::Silent(150)] {
        let mut lab = Lab::new();
        lab.fer.trouble(trouble);
        lab.begin("move-up", &[]).unwrap();
        let Event::Failed { fault, .. } = lab.ending() else {
            panic!("{trouble:?} went unnoticed");
        };
        assert_eq!(fault, Fault::RobotLost, "{trouble:?}");
        lab.fer.trouble(Trouble::None);
        let cycles = lab.fer.state().cycles;
        // It is tried again once a second; nothing that was given before is given again.
        let patience = Instant::now() + Duration::from_secs(20);
        loop {
            match lab.begin("move-up", &[]) {
                Ok(_) => break,
                Err(Refusal::Arm { .. }) if Instant::now() < patience => {
                    assert_eq!(lab.fer.state().cycles, cycles);
                    std::thread::sleep(Duration::from_millis(100));
                }
                Err(other) => panic!("{trouble:?}: {other}"),
            }
        }
        assert!(matches!(lab.ending(), Event::Done(_)), "{trouble:?}");
        assert!(lab.fer.state().connections >= 2);
    }
}

#[test]
fn an_arm_that_is_not_there_is_an_error_with_advice() {
    let Err(fault) = Fci::connect("127.0.0.1:9", "127.0.0.1:9", false) else {
        panic!("nobody is there");
    };
    assert!(matches!(fault, FciFault::Unreachable(_)), "{fault}");
    assert!(fault.remedy().contains("FCI"));
}
