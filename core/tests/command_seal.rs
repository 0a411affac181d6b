//! Sealed messages of the command set: a guard takes what the other side's guard has said, once, and nothing else.

use deictic_core::can::Frame;
use deictic_core::command::Packet;
use deictic_core::command::code::{Outcome, State};
use deictic_core::command::field::{Id, Number};
use deictic_core::command::message::{
    Accepted, FromRobot, Halt, Home, HostBeat, RobotBeat, ToRobot,
};
use deictic_core::command::parcel::{Assembler, Sender, frames};
use deictic_core::command::seal::{Guard, Heard, ON_A_BUS, ON_A_STREAM, Refused, SEALED};
use deictic_core::protocol::seal::{KEY, Key};
use proptest::prelude::*;

fn id(number: u32) -> Id {
    let number = Number::new(number).unwrap();
    Id { run: 9, number }
}

fn guard(side: Sender, byte: u8, tag: usize) -> Guard {
    Guard::new(side, Key::new(&[byte; KEY]).unwrap(), tag, 5)
}

/// Both sides of a link, in conversation.
fn both(tag: usize) -> (Guard, Guard) {
    let (mut host, mut robot) = (guard(Sender::Host, 1, tag), guard(Sender::Robot, 1, tag));
    meet(&mut host, &mut robot);
    (host, robot)
}

fn beat() -> Packet {
    ToRobot::from(HostBeat { id: id(1) }).packet()
}

fn home(number: u32) -> Packet {
    ToRobot::from(Home { id: id(number) }).packet()
}

/// Carries what both answer to a beat of the host.
fn meet(host: &mut Guard, robot: &mut Guard) {
    for packet in host.say(&beat()) {
        let mut answer = robot.hear(&packet);
        let mut to_host = true;
        while let Heard::Answer(packet) = answer {
            answer = if to_host {
                host.hear(&packet)
            } else {
                robot.hear(&packet)
            };
            to_host = !to_host;
        }
    }
}

fn one(said: &[Packet]) -> &Packet {
    assert_eq!(said.len(), 1, "{said:?}");
    &said[0]
}

#[test]
fn what_one_says_the_other_takes_once() {
    for tag in [ON_A_BUS, ON_A_STREAM] {
        let (mut host, mut robot) = both(tag);
        assert!(host.is_challenged() && robot.is_proven());
        let said = host.say(&home(1));
        assert_eq!(one(&said).bytes.len(), home(1).bytes.len() + 2 + tag);
        assert_eq!(robot.hear(one(&said)), Heard::Message(home(1)));
        assert_eq!(robot.hear(one(&said)), Heard::Nothing);
        let replayed = Refused {
            replayed: 1,
            ..Refused::default()
        };
        assert_eq!(robot.refused(), replayed);
        let accepted = FromRobot::from(Accepted { id: id(1) }).packet();
        let said = robot.say(&accepted);
        assert_eq!(host.hear(one(&said)), Heard::Message(accepted));
        // Sent back to where it came from.
        assert_eq!(robot.hear(one(&said)), Heard::Nothing);
        assert_eq!(robot.refused().forged, 1);
    }
}

#[test]
fn without_a_conversation_nothing_is_said_but_a_beat_and_a_halt() {
    let mut host = guard(Sender::Host, 1, ON_A_BUS);
    let halt = ToRobot::from(Halt { id: id(1) }).packet();
    assert_eq!(one(&host.say(&beat())), &beat());
    assert_eq!(one(&host.say(&halt)), &halt);
    assert!(host.say(&home(1)).is_empty());
    let mut robot = guard(Sender::Robot, 1, ON_A_BUS);
    let state = RobotBeat {
        run_low: 9,
        number: id(1).number,
        state: State::Ready,
        outcome: Outcome::Nothing,
    };
    assert!(robot.say(&FromRobot::from(state).packet()).is_empty());
    assert_eq!(robot.hear(&halt), Heard::Message(halt));
    assert_eq!(robot.hear(&home(1)), Heard::Nothing);
    assert_eq!(robot.refused().unsealed, 1);
}

#[test]
fn a_host_that_is_not_answered_is_challenged_anew() {
    let (mut host, _) = both(ON_A_BUS);
    // The robot has started anew, with another nonce.
    let key = Key::new(&[1; KEY]).unwrap();
    let mut robot = Guard::new(Sender::Robot, key, ON_A_BUS, 1_000);
    let mut beats = 0;
    while !robot.is_proven() {
        beats += 1;
        assert!(beats < 6, "it never asks again");
        meet(&mut host, &mut robot);
    }
    let said = host.say(&home(2));
    assert_eq!(robot.hear(one(&said)), Heard::Message(home(2)));
}

#[test]
fn a_challenge_that_nobody_asked_for_changes_nothing() {
    let (mut host, mut robot) = both(ON_A_BUS);
    let mut other = guard(Sender::Robot, 2, ON_A_BUS);
    let Heard::Answer(challenge) = other.hear(&beat()) else {
        panic!("a beat in clear is challenged");
    };
    assert_eq!(host.hear(&challenge), Heard::Nothing);
    let said = host.say(&home(1));
    assert_eq!(robot.hear(one(&said)), Heard::Message(home(1)));
}

#[test]
fn an_answer_to_an_old_challenge_opens_nothing() {
    let (mut host, mut robot) = (
        guard(Sender::Host, 1, ON_A_BUS),
        guard(Sender::Robot, 1, ON_A_BUS),
    );
    let Heard::Answer(challenge) = robot.hear(&beat()) else {
        panic!("a beat in clear is challenged");
    };
    let Heard::Answer(proof) = host.hear(&challenge) else {
        panic!("a challenge is answered");
    };
    assert_eq!(robot.hear(&proof), Heard::Nothing);
    let said = host.say(&home(1));
    assert_eq!(robot.hear(one(&said)), Heard::Message(home(1)));
    // The whole conversation once more, from its beginning.
    assert_eq!(robot.hear(&proof), Heard::Nothing);
    assert_eq!(robot.hear(one(&said)), Heard::Nothing);
    assert_eq!(robot.refused().replayed, 2);
}

#[test]
fn a_message_of_65536_messages_ago_carries_the_same_number_and_is_not_taken() {
    let (mut host, mut robot) = both(ON_A_BUS);
    let old = host.say(&home(1));
    assert_eq!(robot.hear(one(&old)), Heard::Message(home(1)));
    for _ in 0..65_535 {
        let said = host.say(&home(2));
        assert_eq!(robot.hear(one(&said)), Heard::Message(home(2)));
    }
    assert_eq!(robot.hear(one(&old)), Heard::Nothing);
    assert_eq!(robot.refused().forged, 1);
    // Up to 32,767 in a row may be lost.
    for _ in 0..32_767 {
        let _ = host.say(&home(3));
    }
    let said = host.say(&home(4));
    assert_eq!(robot.hear(one(&said)), Heard::Message(home(4)));
}

#[test]
fn sealed_messages_go_in_long_frames() {
    let (mut host, mut robot) = both(ON_A_BUS);
    let said = host.say(&home(1));
    let mut assembler = Assembler::new(Sender::Host);
    let carried: Vec<Frame> = frames(Sender::Host, one(&said)).collect();
    // 7 bytes, 2 of a counter and 4 of a tag; identifier and check add 4.
    assert_eq!(carried.len(), 3);
    assert!(carried.iter().all(|f| f.id() == Sender::Host.long_id()));
    let put_together = carried.iter().find_map(|frame| assembler.take(frame));
    let packet = put_together.unwrap().unwrap();
    assert_eq!(packet.id, 0x033 | SEALED);
    assert_eq!(robot.hear(&packet), Heard::Message(home(1)));
}

proptest! {
    #[test]
    fn nothing_but_what_was_said_is_taken(
        at in 0_usize..13,
        change in 1_u8..,
        id in any::<u16>(),
        bytes in prop::collection::vec(any::<u8>(), 0..66),
    ) {
        let (mut host, mut robot) = both(ON_A_BUS);
        let said = host.say(&home(1));
        let mut changed = one(&said).clone();
        changed.bytes[at] ^= change;
        prop_assert_eq!(robot.hear(&changed), Heard::Nothing);
        let mut renamed = one(&said).clone();
        renamed.id ^= (id & 0x7fff).max(1);
        prop_assert_eq!(robot.hear(&renamed), Heard::Nothing);
        let invented = Packet { id: id | SEALED, bytes: bytes.into_iter().collect() };
        prop_assert_eq!(robot.hear(&invented), Heard::Nothing);
        prop_assert_eq!(robot.refused(), Refused { forged: 3, ..Refused::default() });
        prop_assert_eq!(robot.hear(one(&said)), Heard::Message(home(1)));
    }
}
