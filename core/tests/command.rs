//! The command set: every message has a form of its own and keeps it on the way.

#[path = "common/messages.rs"]
mod messages;

use deictic_core::can::Frame;
use deictic_core::command::field::{Features, Name, Place, Quantity, Text};
use deictic_core::command::letter::Letters;
use deictic_core::command::message::*;
use deictic_core::command::parcel::{Assembler, Sender, frames};
use deictic_core::command::{LONGEST, Packet, PacketError, seal};
use deictic_core::protocol::stuffing::Outbox;
use messages::*;

#[test]
fn every_message_has_a_layout_of_its_own_that_fits() {
    let all = [ToRobot::LAYOUTS, FromRobot::LAYOUTS].concat();
    let mut ids: Vec<u16> = all.iter().map(|l| l.id).collect();
    ids.extend([Sender::Host.long_id(), Sender::Robot.long_id()]);
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), all.len() + 2, "two messages share an identifier");
    assert!(ids.iter().all(|id| *id < 0x200));
    for layout in &all {
        let sealed = layout.bytes() + seal::ROOM;
        assert!(sealed <= LONGEST, "{} is too long", layout.name);
    }
    // Every message is among those that the other tests go through.
    assert_eq!(packets().len(), all.len());
    for ((_, packet), layout) in packets().iter().zip(&all) {
        assert_eq!((packet.id, packet.bytes.len()), (layout.id, layout.bytes()));
    }
}

#[test]
fn every_message_survives_frames_and_letters() {
    let (mut sends, mut takes) = (Letters::new(), Letters::new());
    for message in to_robot() {
        let packet = message.packet();
        assert_eq!(ToRobot::read(&packet), Ok(message));
        let mut out = Outbox::<128>::new();
        assert!(sends.send(&packet, &mut out));
        let bytes = out.waiting().to_vec();
        let taken = bytes.iter().find_map(|b| takes.receive::<Packet>(*b));
        assert_eq!(taken.map(|r| r.message), Some(packet));
    }
    for message in from_robot() {
        assert_eq!(FromRobot::read(&message.packet()), Ok(message));
    }
    for (sender, packet) in packets() {
        let carried: Vec<Frame> = frames(sender, &packet).collect();
        assert!(carried.iter().all(|f| f.data().len() == 8), "{packet:?}");
        let mut assembler = Assembler::new(sender);
        let taken = carried.iter().filter_map(|frame| assembler.take(frame));
        assert_eq!(taken.collect::<Vec<_>>(), [Ok(packet)]);
    }
}

#[test]
fn what_is_no_message_is_refused_by_name() {
    let unknown = Packet {
        id: 0x123,
        bytes: heapless::Vec::new(),
    };
    assert_eq!(
        ToRobot::read(&unknown),
        Err(PacketError::UnknownMessage(0x123))
    );
    let mut short = execute().packet();
    short.bytes.pop();
    assert!(matches!(
        ToRobot::read(&short),
        Err(PacketError::Length { .. })
    ));
    let mut odd = execute().packet();
    odd.bytes[11] = 200;
    assert_eq!(ToRobot::read(&odd), Err(PacketError::Value(0x040)));
}

#[test]
fn values_keep_what_they_promise() {
    let place = Place::of_metres([0.455_04, -1.0, 3.2]).unwrap();
    assert_eq!(place.0, [4550, -10_000, 32_000]);
    for bad in [3.3, f32::NAN, f32::INFINITY, -3.3] {
        assert_eq!(Place::of_metres([0.0, bad, 0.0]), None);
    }
    for bad in [-0.1, 6.5535, f32::NAN] {
        assert_eq!(Quantity::new(bad), None);
    }
    assert_eq!(Quantity::new(0.1).unwrap().get(), Some(0.1));
    assert_eq!(Quantity::NONE.get(), None);
    for (likelihood, above) in [(0.5, true), (0.499_9, false), (1.0, true), (0.0, false)] {
        let through = Features::likelihood(Features::in_255ths(likelihood));
        assert_eq!(through >= 0.5, above, "{likelihood}");
    }
    let long = "a description of a thing that is é".to_owned() + &"é".repeat(9);
    let text = Text::new(&long);
    assert!(long.starts_with(text.get()) && text.get().len() >= 39);
    assert_eq!(Text::new("a\0b").get(), "a");
    assert_eq!(Name::NONE.get(), None);
    assert_eq!(Name::object(127), None);
    assert_eq!(Name::storage(126).unwrap().get(), Some((true, 126)));
}
