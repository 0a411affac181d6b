//! The arm's own network interface when things go wrong: every reflex is a typed fault, and a broken
//! connection is made again. Against FCI version 5 on loopback.

#[path = "common/lab.rs"]
mod lab;

use std::time::Duration;

use deictic::robot::fci::{Fci, FciFault};
use deictic::robot::{Event, Fault, Robot};
use franka::Errors;
use lab::Lab;
use lab::bench::O;
use lab::fer::Trouble;

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
        lab.moves_when_it_is_back(trouble);
        assert!(lab.fer.state().connections >= 2);
    }
}

#[test]
fn a_connection_may_break_at_every_step() {
    for step in 1..=5 {
        let mut lab = Lab::new();
        lab.begin("pick", &[(O, "can")]).unwrap();
        lab.until(|e| matches!(e, Event::Begun { number, .. } if *number == step));
        // The fingers are quick: it breaks in the first motion of the arm from here on.
        lab.fer.trouble(Trouble::Cut(0));
        let ending = lab.ending();
        let lost = matches!(
            &ending,
            Event::Failed {
                fault: Fault::RobotLost,
                ..
            }
        );
        assert!(lost, "step {step}: {ending:?}");
        let grasped = (step > 3).then_some("can");
        assert_eq!(lab.fci.holding(), grasped, "step {step}");
        lab.fer.trouble(Trouble::None);
        lab.moves_when_it_is_back(step);
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
