//! Who may talk: a unit with a key listens to nobody who has not shown to have it; what is invented, recorded, sent
//! back or left unsealed is dropped and counted.

mod common;
#[path = "common/keyed.rs"]
mod keyed;

use deictic_core::board::{Link, ToHost, ToUnit, Unit};
use deictic_core::protocol::link::Opening;
use deictic_core::protocol::message::{Heartbeat, Loaded};
use deictic_core::protocol::seal::{Nonces, Way};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::time::Micros;
use keyed::*;

#[test]
fn with_the_same_key_everything_goes_on_as_without() {
    let mut unit = locked();
    let mut host = Host::new(Some(key(1)));
    assert_eq!(host.open(&mut unit, &key(1), 5), [ToHost::Proven]);
    assert!(decides(&host.command(&mut unit)));
    assert_eq!(unit.statistics().link.dropped(), 0);
    assert_eq!(host.link.counters().dropped(), 0);
}

#[test]
fn without_the_key_nothing_is_taken() {
    let mut unit = locked();
    for mut host in [Host::new(None), Host::new(Some(key(2)))] {
        let before = unit.statistics().link.unauthentic;
        host.open(&mut unit, &key(2), 5);
        assert!(!decides(&host.command(&mut unit)));
        // Three parts of a vocabulary, two of a scene, configuration and sentence.
        assert_eq!(unit.statistics().link.unauthentic, before + 7);
        assert_eq!(unit.statistics().executes, 0);
    }
    assert_eq!(unit.next_wake(), Micros::NEVER);
}

#[test]
fn a_host_with_a_key_takes_nothing_from_a_unit_without() {
    let mut unit = Unit::new(77);
    let mut host = Host::new(Some(key(1)));
    let heard = host.greet(&mut unit);
    assert!(matches!(heard[..], [ToHost::Hello(_)]), "{heard:?}");
    // Somebody opens the conversation in the host's name, and the unit decides in clear.
    let mut other = Host::new(None);
    other.greet(&mut unit);
    let heard = {
        let mut out = Vec::new();
        let v = other.command(&mut unit);
        assert!(decides(&v));
        unit.receive(NOW, &other.said.last().unwrap().clone());
        out.extend(listen(&mut unit));
        out
    };
    assert!(!decides(&host.hear(&heard)));
}

#[test]
fn a_recorded_conversation_is_worth_nothing() {
    let mut unit = locked();
    let mut host = Host::new(Some(key(1)));
    host.open(&mut unit, &key(1), 5);
    host.command(&mut unit);
    let recorded = host.said.clone();
    let executes = unit.statistics().executes;
    // From its beginning, in the same unit and in one that has started anew.
    for mut unit in [unit, {
        let mut reborn = Unit::new(78);
        reborn.lock(key(1));
        reborn
    }] {
        let executes = executes.min(unit.statistics().executes);
        for frame in &recorded {
            unit.receive(NOW, frame);
        }
        assert_eq!(unit.statistics().executes, executes);
        assert_eq!(unit.statistics().link.unauthentic, 7);
        assert_eq!(unit.statistics().faults, 1, "the old proof was refused");
    }
}

#[test]
fn what_the_unit_said_is_not_taken_again_by_the_host_or_by_the_unit() {
    let mut unit = locked();
    let mut host = Host::new(Some(key(1)));
    host.open(&mut unit, &key(1), 5);
    host.command(&mut unit);
    let frame = host.said.last().unwrap().clone();
    // The same frame again, in the same conversation.
    unit.receive(NOW, &frame);
    assert_eq!(unit.statistics().link.duplicated, 1);
    let decision = listen(&mut unit);
    assert!(!decides(&host.hear(&decision)));
    // The unit's own words, sent back to it.
    unit.poll(NOW.after(Micros::from_millis(600)));
    let own = listen(&mut unit);
    assert!(!own.is_empty());
    let before = unit.statistics().link.unauthentic;
    unit.receive(NOW, &own);
    assert_eq!(unit.statistics().link.unauthentic, before + 1);
    // They are good where they belong, once.
    assert!(matches!(host.hear(&own)[..], [ToHost::Heartbeat(_)]));
    assert!(host.hear(&own).is_empty());
}

#[test]
fn a_changed_frame_with_a_right_crc_is_not_taken() {
    let mut unit = locked();
    let mut host = Host::new(Some(key(1)));
    host.open(&mut unit, &key(1), 5);
    let mut out = Outbox::<512>::new();
    let beat = Heartbeat {
        now: NOW,
        vocabulary: 1,
        scene: 1,
    };
    assert!(host.link.send(&ToUnit::Heartbeat(beat), &mut out));
    let stuffed = out.waiting();
    let plain = cobs::decode_vec(&stuffed[..stuffed.len() - 1]).unwrap();
    let crc32 = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    for at in 0..plain.len() - 4 {
        let mut forged = plain[..plain.len() - 4].to_vec();
        forged[at] ^= 1;
        let crc = crc32.checksum(&forged);
        forged.extend(crc.to_le_bytes());
        let mut line = cobs::encode_vec(&forged);
        line.push(0);
        let received = unit.statistics().link.received;
        unit.receive(NOW, &line);
        assert_eq!(unit.statistics().link.received, received, "byte {at}");
    }
    unit.receive(NOW, stuffed);
    assert_eq!(unit.statistics().link.unauthentic as usize, plain.len() - 4);
}

#[test]
fn a_frame_of_65536_frames_ago_has_the_same_number_and_is_not_taken() {
    #[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
    struct Note(u8);
    impl Opening for Note {
        fn opens(&self) -> bool {
            false
        }
    }
    let nonces = Nonces { unit: 1, host: 2 };
    let (mut a, mut b) = (Link::new(), Link::new());
    a.lock(key(1), Way::ToHost);
    b.lock(key(1), Way::ToUnit);
    a.seal(nonces);
    b.seal(nonces);
    let mut out = Outbox::<64>::new();
    let mut recorded = Vec::new();
    for i in 0..=65_536_u32 {
        assert!(a.send(&Note(1), &mut out));
        if i == 0 {
            recorded = out.waiting().to_vec();
        }
        if i == 65_536 {
            for byte in &recorded {
                assert!(b.receive::<Note>(*byte).is_none());
            }
            assert_eq!(b.counters().unauthentic, 1);
        }
        let taken = out
            .waiting()
            .iter()
            .filter_map(|byte| b.receive::<Note>(*byte));
        assert_eq!(taken.map(|r| r.message).collect::<Vec<_>>(), [Note(1)]);
        out.clear();
    }
    assert_eq!(b.counters().missed, 0);
}

#[test]
fn a_hello_from_anybody_ends_the_conversation_and_opens_none() {
    let mut unit = locked();
    let mut host = Host::new(Some(key(1)));
    host.open(&mut unit, &key(1), 5);
    assert!(decides(&host.command(&mut unit)));
    let mut other = Host::new(None);
    let heard = other.greet(&mut unit);
    // The host hears of it, and knows that the unit has forgotten everything.
    assert!(matches!(
        heard[..],
        [ToHost::Hello(_), ToHost::Challenge(_)]
    ));
    assert!(!decides(&other.command(&mut unit)));
    assert_eq!(host.open(&mut unit, &key(1), 6), [ToHost::Proven]);
    let heard = host.command(&mut unit);
    assert!(decides(&heard));
    assert!(!heard.contains(&ToHost::Loaded(Loaded::Configuration)));
}
