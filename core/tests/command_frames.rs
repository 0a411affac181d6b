//! The command set in classic frames: what is lost or damaged on the way is noticed and never taken for something else.

#[path = "common/messages.rs"]
mod messages;

use deictic_core::can::Frame;
use deictic_core::command::Packet;
use deictic_core::command::message::*;
use deictic_core::command::parcel::{Assembler, ParcelError, Sender, frames};
use messages::*;
use proptest::prelude::*;

fn assembled(assembler: &mut Assembler, carried: &[Frame]) -> Vec<Result<Packet, ParcelError>> {
    let taken = carried.iter().filter_map(|frame| assembler.take(frame));
    taken.collect()
}

#[test]
fn a_halt_goes_between_the_frames_of_a_long_message() {
    let mut carried: Vec<Frame> = frames(Sender::Host, &execute().packet()).collect();
    let halt = ToRobot::Halt(Halt { id: id(3) }).packet();
    carried.splice(2..2, frames(Sender::Host, &halt));
    let got = assembled(&mut Assembler::new(Sender::Host), &carried);
    assert_eq!(got, [Ok(halt), Ok(execute().packet())]);
}

#[test]
fn a_lost_or_doubled_frame_loses_its_message_and_no_other() {
    let whole: Vec<Frame> = frames(Sender::Host, &execute().packet()).collect();
    for at in 0..whole.len() {
        let mut lossy = whole.clone();
        lossy.remove(at);
        lossy.extend(whole.clone());
        let got = assembled(&mut Assembler::new(Sender::Host), &lossy);
        let sound: Vec<_> = got.iter().filter(|g| g.is_ok()).collect();
        assert_eq!(sound, [&Ok(execute().packet())], "without frame {at}");
        assert!(got.contains(&Err(ParcelError::Gap)), "without frame {at}");

        let mut doubled = whole.clone();
        doubled.insert(at, whole[at].clone());
        doubled.extend(whole.clone());
        let got = assembled(&mut Assembler::new(Sender::Host), &doubled);
        assert!(got.iter().filter(|g| g.is_ok()).count() <= 2);
        assert_eq!(got.last(), Some(&Ok(execute().packet())));
    }
}

#[test]
fn frames_of_others_and_of_no_one_are_passed_over() {
    let mut assembler = Assembler::new(Sender::Host);
    for id in [0x000, 0x011, 0x110, 0x118, 0x200, 0x201, 0x7ff] {
        let frame = Frame::new(id, &[1; 8]).unwrap();
        assert_eq!(assembler.take(&frame), None, "{id:#x}");
    }
}

#[test]
fn a_flipped_bit_is_always_found() {
    for (sender, packet) in packets() {
        let carried: Vec<Frame> = frames(sender, &packet).collect();
        for at in 0..carried.len() {
            for bit in 0..64 {
                let mut data = carried[at].data().to_vec();
                data[bit / 8] ^= 1 << (bit % 8);
                let mut bad = carried.clone();
                bad[at] = Frame::new(bad[at].id(), &data).unwrap();
                let got = assembled(&mut Assembler::new(sender), &bad);
                // What pads a last frame carries nothing.
                let harmless = got == [Ok(packet.clone())] && at + 1 == carried.len();
                assert!(
                    harmless || got.iter().all(Result::is_err),
                    "{packet:?} frame {at} bit {bit}: {got:?}"
                );
            }
        }
    }
}

proptest! {
    #[test]
    fn any_frames_are_survived(carried in proptest::collection::vec(
        (0_u16..0x220, proptest::collection::vec(any::<u8>(), 0..=8)), 0..60,
    )) {
        for sender in [Sender::Host, Sender::Robot] {
            let mut assembler = Assembler::new(sender);
            for (id, data) in &carried {
                let frame = Frame::new(*id, data).unwrap();
                if let Some(Ok(packet)) = assembler.take(&frame) {
                    let _ = ToRobot::read(&packet);
                    let _ = FromRobot::read(&packet);
                }
            }
        }
    }

    #[test]
    fn any_text_is_survived(text in proptest::collection::vec(any::<u8>(), 0..200)) {
        let mut adapter = deictic_core::slcan::Adapter::new();
        let mut lines = deictic_core::slcan::Lines::new();
        for character in text {
            let _ = adapter.take(character);
            let _ = lines.hear(character);
        }
    }
}
