//! The part of the interface that works on bytes, frames and packets.

use core::hint::black_box;

use deictic_core::can::{FLEXIBLE, Frame};
use deictic_core::command::message::{FromRobot, ToRobot};
use deictic_core::command::parcel::{Assembler, Sender, frames};
use deictic_core::command::seal::{Guard, Heard};
use deictic_core::command::{Packet, field};
use deictic_core::gesture::line::{SensorLine, send};
use deictic_core::gesture::wire::{decode, encode};
use deictic_core::large;
use deictic_core::protocol::seal::{Key, Nonces, Way};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::slcan::{Adapter, Lines, line};

use crate::any::any;

/// Calls it.
pub fn call() {
    let bytes = any([7_u8; 88]);
    let mut out = Outbox::<128>::new();
    let mut sensor = SensorLine::new();
    for byte in bytes {
        black_box(sensor.push(byte).is_some());
    }
    if let Ok(sample) = decode(&bytes) {
        black_box(encode(&sample).is_ok());
        black_box(send(&sample, &mut out).is_ok());
    }
    out.written(any(5));
    out.abandon();
    let (mut ear, mut adapter) = (Lines::new(), Adapter::new());
    for byte in bytes {
        black_box((ear.hear(byte).is_some(), adapter.take(byte).is_some()));
    }
    let packet = Packet {
        id: any(0x20),
        bytes: heapless::Vec::from_slice(bytes.get(..any(30)).unwrap_or(&[])).unwrap_or_default(),
    };
    for sender in [Sender::Host, Sender::Robot] {
        guarded(sender, &packet);
        let mut assembler = Assembler::new(sender);
        for frame in frames(sender, &packet) {
            black_box(line(&frame).len());
            black_box(assembler.take(&frame).is_some());
        }
        for frame in frames::<FLEXIBLE>(sender, &packet) {
            black_box((frame.id(), frame.data().len()));
            black_box(assembler.take(&frame).is_some());
        }
    }
    if let Ok(message) = ToRobot::read(&packet) {
        black_box(message.packet());
    }
    if let Ok(message) = FromRobot::read(&packet) {
        black_box(message.packet());
    }
    if let Some((frame, carried)) = Frame::of_stream(any(0x200), &bytes) {
        black_box((carried, frame.stream().len()));
    }
    black_box((
        field::Place::of_metres(any([0.1; 3])),
        field::Angle::of_radians(any(1.0)).radians(),
    ));
    black_box(field::Features::new(&any([0.5; 40])));
    let mut link = large::Link::new();
    if let Some(key) = Key::new(&any([1; 32])) {
        link.lock(key, any(Way::ToUnit));
        link.seal(Nonces {
            unit: any(1),
            host: any(2),
        });
    }
    for byte in bytes {
        black_box(link.receive::<large::ToHost>(byte).is_some());
    }
    let mut out = Outbox::<1024>::new();
    black_box(link.send(&large::ToUnit::AskStatistics, &mut out));
    black_box(link.counters().dropped());
}

/// A packet past a guard and back.
fn guarded(side: Sender, packet: &Packet) {
    let Some(key) = Key::new(&any([2; 32])) else {
        return;
    };
    let mut guard = Guard::new(side, key, any(4), any(3));
    let answer = match guard.hear(packet) {
        Heard::Message(packet) | Heard::Answer(packet) => packet,
        Heard::Nothing => packet.clone(),
    };
    for said in guard.say(&answer) {
        black_box(guard.hear(&said) == Heard::Nothing);
    }
    black_box((
        guard.refused().all(),
        guard.is_challenged(),
        guard.is_proven(),
    ));
}
