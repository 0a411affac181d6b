//! The command set: every message fits its frames and survives them, and what is lost or damaged on
//! the way is noticed and never taken for something else.

use deictic_core::can::Frame;
use deictic_core::command::code::{Direction, Fault, Motion, Outcome, Reason, State};
use deictic_core::command::field::{
    Angle, Features, Id, Name, Number, Place, Quantity, Text, Thing,
};
use deictic_core::command::letter::Letters;
use deictic_core::command::message::*;
use deictic_core::command::parcel::{Assembler, ParcelError, Sender, frames};
use deictic_core::command::{LONGEST, Packet, PacketError, seal};
use deictic_core::protocol::stuffing::Outbox;
use proptest::prelude::*;

fn id(number: u32) -> Id {
    let number = Number::new(number).unwrap();
    let run = 0xdead_beef;
    Id { run, number }
}

fn thing(option: u8) -> Thing {
    Thing {
        name: Name::storage(option).unwrap(),
        place: Place::of_metres([0.5, -0.3, 0.1]).unwrap(),
    }
}

fn execute() -> ToRobot {
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

fn to_robot() -> Vec<ToRobot> {
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

fn from_robot() -> Vec<FromRobot> {
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

fn packets() -> Vec<(Sender, Packet)> {
    let to = to_robot();
    let to = to.iter().map(|m| (Sender::Host, m.packet()));
    let from = from_robot();
    let from = from.iter().map(|m| (Sender::Robot, m.packet()));
    to.chain(from).collect()
}

fn assembled(assembler: &mut Assembler, carried: &[Frame]) -> Vec<Result<Packet, ParcelError>> {
    let taken = carried.iter().filter_map(|frame| assembler.take(frame));
    taken.collect()
}

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
        assert_eq!(assembled(&mut assembler, &carried), [Ok(packet)]);
    }
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
