//! With a key, a robot behind a link does only what its bridge says, and the bridge believes only its robot: what is
//! invented, recorded, changed, sent back or said in clear is not taken, and counted.

#[path = "common/far.rs"]
mod far;
#[path = "common/tape.rs"]
mod tape;

use std::sync::{Arc, Mutex};

use deictic::robot::end::End;
use deictic::robot::sim::Sim;
use deictic::robot::{Event, Refusal};
use deictic::vocabulary::Lexicon;
use deictic_core::command::Packet;
use deictic_core::command::field::Id;
use deictic_core::command::message::{Done, FromRobot, Home, HostBeat, ToRobot};
use deictic_core::command::parcel::Sender;
use deictic_core::command::seal::{Guard, Heard, ON_A_BUS, Refused, SEALED};
use far::{Ended, Scene, Way, gate, key};
use tape::{far, id, inject, is_moving, last_id, record, refused};

#[test]
fn with_the_same_key_everything_goes_on_as_without() {
    let mut scene = Scene::keyed(Some(7), Some(7));
    let tape = record(&scene);
    let end = scene.run("put-into can drawer");
    assert!(matches!(end, Ended::Event(Event::Done(_))), "{end:?}");
    assert_eq!(scene.table.version(), 6);
    assert_eq!(refused(&scene), Refused::default());
    let tape = tape.lock().unwrap();
    assert!(tape.len() > 50 && tape.iter().all(|(_, p)| p.id & SEALED != 0));
}

#[test]
fn whoever_lacks_the_key_moves_nothing() {
    for (near, far) in [(None, Some(7)), (Some(7), None), (Some(7), Some(8))] {
        let mut scene = Scene::keyed(near, far);
        let end = scene.run("move-up");
        assert_eq!(end, Ended::Refused(Refusal::Gone), "{near:?} {far:?}");
        assert_eq!(scene.begun(), 0);
    }
}

#[test]
fn what_is_invented_is_not_taken() {
    let scene = Scene::keyed(Some(7), Some(7));
    let tape = record(&scene);
    let mut scene = scene;
    scene.pass(200);
    let Id { run, number } = last_id(&tape);
    let home = ToRobot::from(Home {
        id: id(run, number.get() + 1),
    })
    .packet();
    inject(&scene, &home);
    // Under the seal of another key, of the same key in another conversation, and of none.
    for byte in [8, 7] {
        let mut guard = Guard::new(Sender::Host, key(byte), ON_A_BUS, 1);
        let mut robot = gate(Sender::Robot, Some(byte));
        let _ = converse(&mut guard, &mut robot);
        guard
            .say(&home)
            .iter()
            .for_each(|packet| inject(&scene, packet));
    }
    let bytes = home.bytes.iter().copied().chain([0; 6]).collect();
    let id = home.id | SEALED;
    inject(&scene, &Packet { id, bytes });
    assert_eq!(scene.begun(), 0);
    let Refused {
        unsealed,
        forged,
        replayed,
    } = refused(&scene);
    assert_eq!((unsealed, forged, replayed), (1, 3, 0));
    assert!(matches!(scene.run("move-up"), Ended::Event(Event::Done(_))));
}

/// Has a host's guard open a conversation with a robot's gate.
fn converse(guard: &mut Guard, robot: &mut deictic::robot::remote::Gate) -> Vec<Packet> {
    let beat = ToRobot::from(HostBeat { id: id(1, 0) }).packet();
    let mut said = Vec::new();
    for packet in guard.say(&beat) {
        if let Heard::Answer(challenge) = robot.hear(packet)
            && let Heard::Answer(proof) = guard.hear(&challenge)
        {
            said.push(proof.clone());
            assert_eq!(robot.hear(proof), Heard::Nothing);
        }
    }
    said
}

#[test]
fn what_was_recorded_is_worth_nothing() {
    let mut scene = Scene::keyed(Some(7), Some(7));
    let tape = record(&scene);
    let end = scene.run("move-up");
    assert!(matches!(end, Ended::Event(Event::Done(_))), "{end:?}");
    let recorded: Vec<_> = tape.lock().unwrap().clone();
    let said = |way| {
        recorded
            .iter()
            .filter(move |(w, _)| *w == way)
            .map(|(_, p)| p)
    };
    said(Way::ToRobot).for_each(|packet| inject(&scene, packet));
    assert_eq!(scene.begun(), 1);
    let replayed = said(Way::ToRobot).count() as u32;
    assert!(replayed > 10);
    assert_eq!(
        refused(&scene),
        Refused {
            replayed,
            ..Refused::default()
        }
    );
    // The robot's own words, sent back to it.
    said(Way::ToHost).for_each(|packet| inject(&scene, packet));
    assert_eq!(refused(&scene).forged, said(Way::ToHost).count() as u32);
    // A robot that has started anew knows no command, but challenges anew as well.
    {
        let far = far(&scene);
        let mut far = far.lock().unwrap();
        let lexicon = Lexicon::tabletop().unwrap();
        far.end = End::new(Box::new(Sim::new(1.0)), lexicon, 2);
        far.gate = gate(Sender::Robot, Some(7));
        for packet in said(Way::ToRobot) {
            let _ = far.take(packet);
            assert!(!far.end.is_moving());
        }
        assert_eq!(far.gate.refused().forged, replayed);
    }
    scene.pass(1_000);
    let end = scene.run("move-up");
    assert!(matches!(end, Ended::Event(Event::Done(_))), "{end:?}");
}

#[test]
fn every_changed_byte_is_found_out() {
    let mut scene = Scene::keyed(Some(7), Some(7));
    let held = Arc::new(Mutex::new(None));
    let keeps = Arc::clone(&held);
    scene.spoil(move |way, packet| {
        let execute = packet.id == 0x040 | SEALED && way == Way::ToRobot;
        let first = keeps.lock().unwrap().is_none();
        if execute && first {
            *keeps.lock().unwrap() = Some(packet.clone());
        }
        Ok(if execute && first {
            vec![]
        } else {
            vec![packet.clone()]
        })
    });
    // The bridge gives it again after 60 ms; before that, somebody tries every change of a bit.
    let (id, taken) = scene.begin("move-up");
    taken.unwrap();
    let sound: Packet = held.lock().unwrap().clone().unwrap();
    for at in 0..sound.bytes.len() * 8 {
        let mut changed = sound.clone();
        changed.bytes[at / 8] ^= 1 << (at % 8);
        inject(&scene, &changed);
    }
    let mut other = sound.clone();
    other.id = 0x033 | SEALED;
    inject(&scene, &other);
    assert!(!is_moving(&scene));
    assert_eq!(refused(&scene).forged as usize, sound.bytes.len() * 8 + 1);
    assert!(matches!(scene.ending(id), Ended::Event(Event::Done(_))));
}

#[test]
fn what_is_told_in_the_robots_place_is_not_believed() {
    let mut scene = Scene::keyed(Some(7), Some(7));
    let tape = record(&scene);
    let (command, taken) = scene.begin("put-into can drawer");
    taken.unwrap();
    scene.pass(100);
    let Id { run, number } = last_id(&tape);
    let done = FromRobot::from(Done {
        number,
        run_low: run as u16,
        groups: 0,
    })
    .packet();
    far(&scene).lock().unwrap().to_host.push_back(done);
    scene.pass(100);
    assert_eq!(scene.end_of(command), None, "it believes anybody");
    assert!(matches!(
        scene.ending(command),
        Ended::Event(Event::Done(_))
    ));
    assert_eq!(scene.table.version(), 6);
}
