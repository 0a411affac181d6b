//! A sealed line of which everything is recorded, and somebody else who talks on it.
#![allow(dead_code)]

use std::sync::{Arc, Mutex};

use deictic_core::command::Packet;
use deictic_core::command::field::{Id, Number};
use deictic_core::command::message::ToRobot;
use deictic_core::command::seal::{Refused, SEALED};

use crate::far::{Far, Scene, Way};

/// What a scene's line has carried.
pub type Tape = Arc<Mutex<Vec<(Way, Packet)>>>;

pub fn record(scene: &Scene) -> Tape {
    let tape = Tape::default();
    let writes = Arc::clone(&tape);
    scene.spoil(move |way, packet| {
        writes.lock().unwrap().push((way, packet.clone()));
        Ok(vec![packet.clone()])
    });
    tape
}

pub fn far(scene: &Scene) -> Arc<Mutex<Far>> {
    Arc::clone(scene.far.as_ref().unwrap())
}

pub fn refused(scene: &Scene) -> Refused {
    far(scene).lock().unwrap().gate.refused()
}

/// Says something to the robot in the bridge's place.
pub fn inject(scene: &Scene, packet: &Packet) {
    let _ = far(scene).lock().unwrap().take(packet);
}

pub fn is_moving(scene: &Scene) -> bool {
    far(scene).lock().unwrap().end.is_moving()
}

pub fn id(run: u32, number: u32) -> Id {
    let number = Number::new(number).unwrap();
    Id { run, number }
}

/// The run and the newest number of what was said in clear on the tape.
pub fn last_id(tape: &Tape) -> Id {
    let tape = tape.lock().unwrap();
    let named = |(way, packet): &(Way, Packet)| {
        let mut clear = packet.clone();
        clear.id &= !SEALED;
        clear.bytes.truncate(clear.bytes.len().min(7));
        match (way, ToRobot::read(&clear)) {
            (Way::ToRobot, Ok(ToRobot::HostBeat(of))) => Some(of.id),
            _ => None,
        }
    };
    tape.iter().rev().find_map(named).unwrap()
}
