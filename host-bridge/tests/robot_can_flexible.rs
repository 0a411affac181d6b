//! The simulated robot in frames of CAN FD on a real interface of Linux, which `DEICTIC_CAN` names (`cargo xtask can`
//! makes one), with `candump`, `cansend` and `ip` as witnesses. Skipped, with a word, where no interface is named.
#![cfg(target_os = "linux")]

#[path = "common/can.rs"]
mod can;
#[path = "common/trial.rs"]
mod trial;

use can::{Witness, interface, run, stops_at_a_halt};
use deictic::link::bus::{Bus, BusFault, Socket};
use deictic::robot::end::Listener;
use deictic::robot::way::Way;
use deictic_core::can::FlexibleFrame;
use deictic_core::command::message::{FromRobot, ToRobot};
use deictic_core::command::parcel::{Assembler, Sender};
use trial::{Far, Near};

fn far(interface: &str) -> Far {
    let way = Way::Flexible(interface.to_owned());
    Far::at(Listener::open(&way).unwrap())
}

#[test]
fn every_message_of_a_command_is_one_frame() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let witness = Witness::of(&name);
    let far = far(&name);
    let mut near = Near::to(&far.way);
    near.moves_up();
    let seen = witness.frames();
    let (mut host, mut robot) = (Assembler::new(Sender::Host), Assembler::new(Sender::Robot));
    let (mut executes, mut done) = (0, 0);
    for frame in &seen {
        let said = host
            .take(frame)
            .map(|p| ToRobot::read(&p.unwrap()).unwrap());
        let answered = robot
            .take(frame)
            .map(|p| FromRobot::read(&p.unwrap()).unwrap());
        assert!(said.is_some() || answered.is_some(), "{frame:?}");
        executes += usize::from(matches!(said, Some(ToRobot::Execute(_))));
        done += usize::from(matches!(answered, Some(FromRobot::Done(_))));
    }
    assert_eq!((executes, done), (1, 1));
    assert!(seen.iter().any(|frame| frame.data().len() > 8));
}

#[test]
fn a_halt_in_a_classic_frame_stops_the_arm() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let far = far(&name);
    stops_at_a_halt(&name, &far);
}

#[test]
fn an_interface_that_has_classic_frames_only_is_named_as_that() {
    let Some((name, _one)) = interface() else {
        return;
    };
    let mtu = |bytes: &str| {
        run("ip", &["link", "set", &name, "down"]);
        run("ip", &["link", "set", &name, "mtu", bytes]);
        run("ip", &["link", "set", &name, "up"]);
    };
    mtu("16");
    let mut socket = Socket::open(&name).unwrap();
    let short = FlexibleFrame::new(0x123, &[1; 8]).unwrap();
    let long = FlexibleFrame::new(0x123, &[1; 12]).unwrap();
    let (short, long) = (socket.send(&short), socket.send(&long));
    mtu("72");
    assert!(short.is_ok(), "{short:?}");
    let error = long.unwrap_err();
    assert_eq!(BusFault::within(&error), Some(BusFault::Classic), "{error}");
    assert!(error.to_string().contains("leave out `,fd`"), "{error}");
}
