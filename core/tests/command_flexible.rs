//! The command set in frames of CAN FD: one frame for most messages, two for the longest, and damage is noticed.

use deictic_core::can::{FLEXIBLE, FlexibleFrame, Frame};
use deictic_core::command::parcel::{Assembler, ParcelError, Sender, frames};
use deictic_core::command::seal::SEALED;
use deictic_core::command::{LONGEST, Packet, SHORT};
use proptest::prelude::*;

fn packet(id: u16, length: usize) -> Packet {
    let bytes = (1..=length).map(|n| u8::try_from(n).unwrap()).collect();
    Packet { id, bytes }
}

fn flexible(packet: &Packet) -> Vec<FlexibleFrame> {
    frames(Sender::Host, packet).collect()
}

fn assembled(frames: &[FlexibleFrame]) -> Vec<Result<Packet, ParcelError>> {
    let mut assembler = Assembler::new(Sender::Host);
    let taken = frames.iter().filter_map(|frame| assembler.take(frame));
    taken.collect()
}

/// One of every length that a sealed message could have.
fn sealed() -> impl Iterator<Item = Packet> {
    (5..=LONGEST).map(|length| packet(0x040 | SEALED, length))
}

#[test]
fn a_message_goes_in_one_frame_where_it_fits_and_in_two_otherwise() {
    for packet in sealed() {
        let carried = packet.bytes.len() + 4;
        let frames = flexible(&packet);
        assert_eq!(frames.len(), 1 + usize::from(carried + 2 > FLEXIBLE));
        assert_eq!(assembled(&frames), [Ok(packet)]);
    }
    assert_eq!(flexible(&packet(0x040 | SEALED, LONGEST)).len(), 2);
}

#[test]
fn a_short_message_has_the_eight_bytes_of_a_classic_frame() {
    let halt = packet(0x010, SHORT);
    let classic: Vec<Frame> = frames(Sender::Host, &halt).collect();
    let flexible = flexible(&halt);
    assert_eq!((classic.len(), flexible.len()), (1, 1));
    assert_eq!(classic[0].data(), flexible[0].data());
    assert_eq!(classic[0].id(), flexible[0].id());
}

#[test]
fn a_flipped_bit_is_always_found() {
    for packet in sealed() {
        let frames = flexible(&packet);
        for (at, frame) in frames.iter().enumerate() {
            for bit in 0..frame.data().len() * 8 {
                let mut data = frame.data().to_vec();
                data[bit / 8] ^= 1 << (bit % 8);
                let mut bad = frames.clone();
                bad[at] = FlexibleFrame::new(frame.id(), &data).unwrap();
                let got = assembled(&bad);
                // What pads a last frame carries nothing.
                let harmless = got == [Ok(packet.clone())] && at + 1 == frames.len();
                assert!(
                    harmless || got.iter().all(Result::is_err),
                    "{packet:?} frame {at} bit {bit}: {got:?}"
                );
            }
        }
    }
}

#[test]
fn what_a_lost_frame_began_does_not_spoil_the_next_message() {
    let longest = packet(0x040 | SEALED, LONGEST);
    let whole = packet(0x040 | SEALED, 30);
    for next in [&longest, &whole] {
        let mut lossy = flexible(&longest);
        lossy.truncate(1);
        lossy.extend(flexible(next));
        let got = assembled(&lossy);
        assert_eq!(got.last(), Some(&Ok(next.clone())));
    }
    let rest = flexible(&longest).split_off(1);
    assert_eq!(assembled(&rest), [Err(ParcelError::Gap)]);
}

#[test]
fn a_frame_that_says_more_than_it_has_gives_nothing() {
    for data in [
        &[0x00][..],
        &[0x00, 8, 1, 2, 3, 4, 5, 6, 7, 8],
        &[0x00, 11, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10],
    ] {
        let frame = FlexibleFrame::new(Sender::Host.long_id(), data).unwrap();
        assert_eq!(assembled(&[frame]), [Err(ParcelError::Length)], "{data:?}");
    }
}

proptest! {
    #[test]
    fn any_frames_are_survived(carried in proptest::collection::vec(
        (0_u16..0x220, proptest::collection::vec(any::<u8>(), 0..=FLEXIBLE)), 0..30,
    )) {
        for sender in [Sender::Host, Sender::Robot] {
            let mut assembler = Assembler::new(sender);
            for (id, data) in &carried {
                let frame = FlexibleFrame::new(*id, data).unwrap();
                if let Some(Ok(packet)) = assembler.take(&frame) {
                    prop_assert!(packet.bytes.len() <= LONGEST);
                }
            }
        }
    }
}
