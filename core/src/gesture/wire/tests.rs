use super::*;
use crate::gesture::line::{FRAMED, SensorLine, send};
use crate::gesture::vector::{Vector, add};
use crate::protocol::stuffing::Outbox;
use proptest::prelude::*;
use std::vec::Vec;

fn point(span: f32) -> impl Strategy<Value = Vector> {
    prop::array::uniform3((-span * 10.0) as i32..(span * 10.0) as i32)
        .prop_map(|p| p.map(|n| n as f32 / 10.0))
}

prop_compose! {
    fn frames()(
        palm in point(2900.0),
        velocity in prop::array::uniform3(-32_767_i32..=32_767),
        time in any::<u32>(),
        right in any::<bool>(),
        shares in prop::array::uniform3(0_u8..=255),
        fingers in prop::array::uniform5(prop::option::of((point(102.0), point(102.0), point(102.0)))),
    ) -> HandFrame {
        let [grab, pinch, confidence] = shares.map(|n| f32::from(n) / 255.0);
        HandFrame {
            time,
            side: if right { Side::Right } else { Side::Left },
            confidence,
            grab,
            pinch,
            palm,
            velocity: velocity.map(|v| v as f32),
            normal: [0.0, -1.0, 0.0],
            direction: [1.0, 0.0, 0.0],
            fingers: fingers.map(|f| f.map(|(a, b, c)| {
                let knuckle = add(palm, a);
                let middle = add(knuckle, b);
                Finger { knuckle, middle, tip: add(middle, c) }
            })),
        }
    }
}

/// Equal to the tenth of a millimetre that the wire keeps.
fn same(a: &HandFrame, b: &HandFrame) -> bool {
    let points = |f: &HandFrame| -> Vec<i32> {
        let fingers = f.fingers.iter().flatten();
        core::iter::once(f.palm)
            .chain(fingers.flat_map(|f| [f.knuckle, f.middle, f.tip]))
            .flatten()
            .map(tenths)
            .collect()
    };
    let rest = |f: &HandFrame| HandFrame {
        palm: [0.0; 3],
        fingers: f.fingers.map(|f| f.map(|_| Finger::default())),
        ..*f
    };
    points(a) == points(b) && rest(a) == rest(b)
}

fn framed(sample: &Sample) -> Vec<u8> {
    let mut out = Outbox::<FRAMED>::new();
    send(sample, &mut out).unwrap();
    out.waiting().to_vec()
}

proptest! {
    #[test]
    fn a_frame_comes_back_to_the_tenth_of_a_millimetre(frame in frames()) {
        let bytes = framed(&Sample::Hand(frame));
        prop_assert_eq!(bytes.len(), FRAMED);
        let mut line = SensorLine::new();
        let got: Vec<_> = bytes.iter().filter_map(|b| line.push(*b)).collect();
        let [Ok(Sample::Hand(back))] = got[..] else { panic!("{got:?}") };
        prop_assert!(same(&frame, &back), "{:?} {:?}", frame, back);
    }

    #[test]
    fn any_bytes_are_survived_and_the_next_frame_is_read(
        noise in prop::collection::vec(any::<u8>(), 0..400),
        frame in frames(),
    ) {
        let mut line = SensorLine::new();
        let mut bytes = noise;
        bytes.push(0);
        bytes.extend(framed(&Sample::Hand(frame)));
        let last = bytes.iter().filter_map(|b| line.push(*b)).last();
        prop_assert!(matches!(last, Some(Ok(Sample::Hand(_)))));
    }

    #[test]
    fn any_payload_decodes_to_a_sound_frame_or_a_typed_error(
        bytes in prop::collection::vec(any::<u8>(), PAYLOAD..=PAYLOAD),
    ) {
        if let Ok(Sample::Hand(frame)) = decode(&bytes) {
            prop_assert_eq!(frame.check(), Ok(()));
        }
    }
}

#[test]
fn no_hand_is_a_sample_too() {
    let nothing = Sample::Nothing(0xdead_beef);
    assert_eq!(decode(&encode(&nothing).unwrap()), Ok(nothing));
    assert_eq!(framed(&nothing).len(), FRAMED);
}

#[test]
fn what_cannot_be_is_refused_by_name() {
    assert_eq!(decode(&[0x80; 87]), Err(WireError::Length(87)));
    assert_eq!(decode(&[0x12; 88]), Err(WireError::Version(0x12)));
    let mut far = HandFrame {
        normal: [0.0, -1.0, 0.0],
        direction: [0.0, 0.0, -1.0],
        ..HandFrame::default()
    };
    far.fingers[2] = Some(Finger {
        tip: [0.0, 102.4, 0.0],
        ..Finger::default()
    });
    let error = WireError::Frame(FrameError::OutOfRange(Part::Finger(2)));
    assert_eq!(encode(&Sample::Hand(far)), Err(error));
    far.fingers[2] = None;
    far.grab = f32::NAN;
    let error = WireError::Frame(FrameError::NotFinite(Part::Grab));
    assert_eq!(encode(&Sample::Hand(far)), Err(error));
    let mut full = Outbox::<90>::new();
    let error = WireError::Framing(stuffing::FrameError::Oversized);
    assert_eq!(send(&Sample::Nothing(0), &mut full), Err(error));
    assert!(full.waiting().is_empty());
}
