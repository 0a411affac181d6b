//! The simulated robot on a real CAN interface of Linux, which `DEICTIC_CAN` names (`cargo xtask can`
//! makes one), with `candump`, `cansend` and `ip` from outside the project as witnesses. Skipped, with
//! a word, where no interface is named.
#![cfg(target_os = "linux")]

#[path = "common/can.rs"]
mod can;
#[path = "common/trial.rs"]
mod trial;

use can::{Slcand, Witness, interface, stops_at_a_halt};
use deictic::robot::end::Listener;
use deictic::robot::way::Way;
use deictic_core::can::Frame;
use deictic_core::command::message::{FromRobot, ToRobot};
use deictic_core::command::parcel::{Assembler, Sender};
use trial::{Far, Near};

#[test]
fn a_witness_sees_a_command_and_all_that_follows() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let witness = Witness::of(&name);
    let far = Far::on(&name);
    let mut near = Near::to(&far.way);
    near.moves_up();
    let seen = witness.frames();
    let (mut host, mut robot) = (Assembler::new(Sender::Host), Assembler::new(Sender::Robot));
    let (mut said, mut answered) = (Vec::new(), Vec::new());
    for frame in &seen {
        let frame = &Frame::new(frame.id(), frame.data()).unwrap();
        assert_eq!(frame.data().len(), 8);
        if let Some(packet) = host.take(frame) {
            said.push(ToRobot::read(&packet.unwrap()).unwrap());
        }
        if let Some(packet) = robot.take(frame) {
            answered.push(FromRobot::read(&packet.unwrap()).unwrap());
        }
    }
    let executes = said
        .iter()
        .filter(|m| matches!(m, ToRobot::Execute(_)))
        .count();
    assert_eq!(executes, 1, "{said:?}");
    let position = |wanted: fn(&FromRobot) -> bool| answered.iter().position(wanted);
    let accepted = position(|m| matches!(m, FromRobot::Accepted(_))).unwrap();
    let done = position(|m| matches!(m, FromRobot::Done(_))).unwrap();
    assert!(accepted < done);
}

#[test]
fn a_halt_of_anybody_on_the_bus_stops_the_arm() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let far = Far::on(&name);
    stops_at_a_halt(&name, &far);
}

#[test]
fn the_kernels_own_slcan_speaks_to_our_adapter() {
    let Some((_, _one)) = interface() else { return };
    let pair = deictic::link::Pair::open().unwrap();
    let port = pair.path().to_owned();
    let _far = Far::at(Listener::Pair {
        pair,
        adapter: true,
    });
    let _slcand = Slcand::on(&port);
    let mut near = Near::to(&Way::Can("slcan0".to_owned()));
    near.moves_up();
}
