//! One of every message of the command set.
#![allow(dead_code, reason = "every test uses a part of it")]

use deictic_core::command::Packet;
use deictic_core::command::code::{Direction, Fault, Motion, Outcome, Reason, State};
use deictic_core::command::field::{
    Angle, Features, Id, Name, Number, Place, Quantity, Text, Thing,
};
use deictic_core::command::message::*;
use deictic_core::command::parcel::Sender;

pub fn id(number: u32) -> Id {
    let number = Number::new(number).unwrap();
    let run = 0xdead_beef;
    Id { run, number }
}

pub fn thing(option: u8) -> Thing {
    Thing {
        name: Name::storage(option).unwrap(),
        place: Place::of_metres([0.5, -0.3, 0.1]).unwrap(),
    }
}

pub fn execute() -> ToRobot {
    ToRobot::Execute(Execute {
        id: id(70_000),
        scene: 9,
        motion: Motion::PutInto,
        object: Thing {
            name: Name::object(3).unwrap(),
            ..thing(0)
        },
        storage: thing(2),
        distance: Quantity::new(0.1).unwrap(),
        direction: Direction::Left,
        angle: Quantity::NONE,
        amount: 2,
    })
}

pub fn to_robot() -> Vec<ToRobot> {
    let id = id(5);
    let features = Features::new(&[0.0, 0.5, 1.0]);
    vec![
        Halt { id }.into(),
        HostBeat { id }.into(),
        Prove { nonce: 1 << 40 }.into(),
        Hold { id }.into(),
        Resume { id }.into(),
        Home { id }.into(),
        ClearFault { id }.into(),
        Ask { id }.into(),
        execute(),
        ToRobot::Scene(Scene {
            version: 3,
            vocabulary: 77,
            things: 11,
        }),
        ToRobot::Item(Item {
            version: 3,
            place: 10,
            thing: thing(7),
            features,
        }),
    ]
}

pub fn from_robot() -> Vec<FromRobot> {
    let id = id(5);
    let text = Text::new("lower to the can");
    let number = id.number;
    let [a, b, c] = [-2.8973, 0.0, 3.7525].map(Angle::of_radians);
    vec![
        FromRobot::RobotBeat(RobotBeat {
            run_low: 1,
            number,
            state: State::Held,
            outcome: Outcome::Running,
        }),
        FromRobot::Welcome(Welcome { run: 9, boot: 1 }),
        Accepted { id }.into(),
        FromRobot::Refused(Refused {
            id,
            reason: Reason::Glued,
            value: 4,
            text,
        }),
        FromRobot::Step(Step {
            id,
            step: 1,
            steps: 5,
            text,
        }),
        FromRobot::Progress(Progress {
            number,
            step: 2,
            steps: 5,
            percent: 40,
        }),
        FromRobot::Done(Done {
            number,
            run_low: 7,
            groups: 2,
        }),
        FromRobot::Stopped(Stopped {
            id,
            groups: 1,
            text,
        }),
        FromRobot::Failed(Failed {
            id,
            groups: 0,
            fault: Fault::Collision,
            text,
        }),
        Challenge { nonce: 1 << 50 }.into(),
        FromRobot::Moved(Moved {
            thing: Name::object(4).unwrap(),
            place: Place([1, -2, 3]),
        }),
        FromRobot::Became(Became {
            thing: Name::NONE,
            feature: 8,
            likelihood: 255,
        }),
        FromRobot::Changed(Changed {
            number,
            run_low: 7,
            group: 1,
            changes: 2,
        }),
        FromRobot::Joints123(Joints123 {
            joint1: a,
            joint2: b,
            joint3: c,
        }),
        FromRobot::Joints456(Joints456 {
            joint4: a,
            joint5: b,
            joint6: c,
        }),
        FromRobot::Joint7Gripper(Joint7Gripper {
            joint7: a,
            width: Quantity::new(0.08).unwrap(),
            held: Name::object(1).unwrap(),
        }),
    ]
}

pub fn packets() -> Vec<(Sender, Packet)> {
    let to = to_robot();
    let to = to.iter().map(|m| (Sender::Host, m.packet()));
    let from = from_robot();
    let from = from.iter().map(|m| (Sender::Robot, m.packet()));
    to.chain(from).collect()
}
