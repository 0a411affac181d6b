//! An arm that moves under a key: what goes in clear may stop it and not keep it going, and one packet more or less
//! changes nothing.

#[path = "common/far.rs"]
mod far;
#[path = "common/tape.rs"]
mod tape;

use deictic::robot::{Event, Refusal};
use deictic_core::command::message::{Halt, HostBeat, ToRobot};
use deictic_core::command::{HOST_LOST, Packet};
use far::{Ended, Scene, Way};
use tape::{inject, is_moving, last_id, record};

#[test]
fn a_beat_in_clear_keeps_nothing_moving() {
    let mut scene = Scene::keyed(Some(7), Some(7));
    let tape = record(&scene);
    let (_, taken) = scene.begin("put-into can drawer");
    taken.unwrap();
    scene.pass(500);
    assert!(is_moving(&scene));
    let id = last_id(&tape);
    // The bridge is cut off, and somebody beats in its place.
    scene.spoil(|way, packet| {
        Ok(if way == Way::ToRobot {
            vec![]
        } else {
            vec![packet.clone()]
        })
    });
    for _ in 0..HOST_LOST.0 / 10_000 + 2 {
        inject(&scene, &ToRobot::from(HostBeat { id }).packet());
        scene.tick();
    }
    assert!(!is_moving(&scene));
}

#[test]
fn anybody_may_stop_the_arm() {
    let mut scene = Scene::keyed(Some(7), Some(7));
    let tape = record(&scene);
    let (command, taken) = scene.begin("put-into can drawer");
    taken.unwrap();
    scene.pass(500);
    assert!(is_moving(&scene));
    inject(&scene, &ToRobot::from(Halt { id: last_id(&tape) }).packet());
    assert!(!is_moving(&scene));
    let end = scene.ending(command);
    assert!(
        matches!(end, Ended::Event(Event::Stopped { .. })),
        "{end:?}"
    );
    // The bridge's own halt goes in clear, in one frame.
    scene.robot.stop(scene.now);
    let halts = |(way, p): &(Way, Packet)| *way == Way::ToRobot && p.id == 0x010;
    assert!(tape.lock().unwrap().iter().any(halts));
}

#[test]
fn any_one_sealed_packet_may_be_lost_or_come_twice() {
    for way in [Way::ToRobot, Way::ToHost] {
        for times in [0, 2] {
            for nth in 1..40 {
                let mut scene = Scene::keyed(Some(7), Some(7));
                let mut count = 0;
                scene.spoil(move |at, packet| {
                    count += usize::from(at == way);
                    let times = if at == way && count == nth { times } else { 1 };
                    Ok(vec![packet.clone(); times])
                });
                let end = match scene.run("put-into can drawer") {
                    // The scene was not whole when the command came.
                    Ended::Refused(Refusal::StaleScene { .. }) => scene.run("put-into can drawer"),
                    end => end,
                };
                assert!(
                    matches!(end, Ended::Event(Event::Done(_))),
                    "{way:?} {nth}: {end:?}"
                );
                assert_eq!((scene.begun(), scene.table.version()), (1, 6));
            }
        }
    }
}
