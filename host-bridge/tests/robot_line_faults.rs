//! Whatever becomes of the line to a robot, or of the robot, every command ends once, is done at most once, and the table
//! is what the robot made it.

#[path = "common/far.rs"]
mod far;

use std::io;
use std::sync::{Arc, Mutex};

use deictic::robot::sim::Sim;
use deictic::robot::{Event, Fault, Refusal, Taken};
use deictic_core::command::message::{FromRobot, ToRobot};
use deictic_core::command::{HOST_LOST, ROBOT_LOST};
use far::{Counted, Ended, Scene, Way};

fn done(end: &Ended) -> bool {
    matches!(end, Ended::Event(Event::Done(_)))
}

/// Spoils the `nth` packet of one direction and expects the command to end well all the same, or
/// with a fault that says so, and never to be done twice.
fn survives(
    nth: usize,
    way: Way,
    what: fn(&deictic_core::command::Packet) -> Vec<deictic_core::command::Packet>,
) -> bool {
    let mut scene = Scene::far();
    let mut count = 0;
    let hit = Arc::new(Mutex::new(false));
    let struck = Arc::clone(&hit);
    scene.spoil(move |at, packet| {
        if at == way {
            count += 1;
            if count == nth {
                *struck.lock().unwrap() = true;
                return Ok(what(packet));
            }
        }
        Ok(vec![packet.clone()])
    });
    let end = scene.run("put-into can drawer");
    let spoilt = *hit.lock().unwrap();
    let begun = scene.begun();
    match end {
        Ended::Event(Event::Done(_)) => {
            assert_eq!(begun, 1);
            assert_eq!(scene.table.version(), 6, "not all changes were told");
        }
        // The scene was not whole when the command came.
        Ended::Refused(Refusal::StaleScene { .. }) => {
            assert_eq!(begun, 0);
            assert!(
                done(&scene.run("put-into can drawer")),
                "it does not recover"
            );
        }
        other => panic!("packet {nth} {way:?}: {other:?}"),
    }
    spoilt
}

#[test]
fn any_one_packet_may_be_lost_or_come_twice() {
    for way in [Way::ToRobot, Way::ToHost] {
        for what in [
            |_: &_| vec![],
            |p: &deictic_core::command::Packet| vec![p.clone(), p.clone()],
        ] {
            // Packets are spoilt one by one until the command ends before the next one's turn; the
            // beats of a long motion are all alike.
            let struck = (1..60).take_while(|nth| survives(*nth, way, what)).count();
            assert!(struck > 20, "only {struck} packets {way:?}");
        }
    }
}

#[test]
fn a_cable_may_be_pulled_at_any_packet() {
    for way in [Way::ToRobot, Way::ToHost] {
        for nth in 1..40 {
            let mut scene = Scene::far();
            let mut count = 0;
            scene.spoil(move |at, packet| {
                count += usize::from(at == way);
                if at == way && count == nth {
                    return Err(io::Error::other("pulled"));
                }
                Ok(vec![packet.clone()])
            });
            let (id, taken) = scene.begin("put-into can drawer");
            let end = match taken {
                Err(refusal) => Ended::Refused(refusal),
                Ok(_) => scene.ending(id),
            };
            let begun = scene.begun();
            assert!(begun <= 1);
            let lost = matches!(
                &end,
                Ended::Event(Event::Failed {
                    fault: Fault::RobotLost,
                    ..
                })
            );
            assert!(lost || done(&end), "packet {nth} {way:?}: {end:?}");
            // The arm stands still soon after, and goes on only when it is told to again.
            scene.pass(HOST_LOST.0 / 1_000 + 20);
            let far = Arc::clone(scene.far.as_ref().unwrap());
            assert!(!far.lock().unwrap().end.is_moving(), "packet {nth} {way:?}");
            {
                let mut far = far.lock().unwrap();
                far.cut = false;
                far.spoil = None;
            }
            scene.pass(3_000);
            assert!(!far.lock().unwrap().end.is_moving());
            assert_eq!(scene.begun(), begun, "packet {nth} {way:?}: done again");
            assert!(
                done(&scene.run("move-up")),
                "packet {nth} {way:?}: it does not recover"
            );
        }
    }
}

#[test]
fn a_robot_that_hears_no_host_stops_within_the_bound() {
    let mut scene = Scene::far();
    let (id, _) = scene.begin("pick can");
    scene.pass(1_000);
    scene.spoil(|way, packet| match way {
        Way::ToRobot => Ok(vec![]),
        Way::ToHost => Ok(vec![packet.clone()]),
    });
    let since = scene.now;
    let far = Arc::clone(scene.far.as_ref().unwrap());
    while far.lock().unwrap().end.is_moving() {
        scene.tick();
        assert!(scene.now.since(since) <= HOST_LOST.after(deictic_core::time::Micros(10_000)));
    }
    scene.pass(200);
    let Some(Ended::Event(Event::Failed { fault, why, .. })) = scene.end_of(id) else {
        panic!("{:?}", scene.events);
    };
    assert_eq!(fault, Fault::HostLost, "{why}");
}

#[test]
fn a_robot_that_falls_silent_counts_as_lost() {
    let mut scene = Scene::far();
    let (id, _) = scene.begin("pick can");
    scene.pass(1_000);
    scene.spoil(|way, packet| match way {
        Way::ToRobot => Ok(vec![packet.clone()]),
        Way::ToHost => Ok(vec![]),
    });
    let since = scene.now;
    while scene.end_of(id).is_none() {
        scene.tick();
        assert!(scene.now.since(since) <= ROBOT_LOST.after(deictic_core::time::Micros(110_000)));
    }
    let end = scene.end_of(id);
    assert!(
        matches!(
            end,
            Some(Ended::Event(Event::Failed {
                fault: Fault::RobotLost,
                ..
            }))
        ),
        "{end:?}"
    );
    let gone = scene.run("move-up");
    assert_eq!(gone, Ended::Refused(Refusal::Gone));
}

#[test]
fn a_robot_that_hangs_can_be_stopped() {
    let mut scene = Scene::before(Counted {
        inner: Sim::new(1.0),
        begun: Arc::default(),
        hangs: true,
    });
    let (id, _) = scene.begin("pick can");
    scene.pass(60_000);
    assert_eq!(scene.end_of(id), None);
    assert_eq!(scene.run("move-up"), Ended::Refused(Refusal::Busy));
    scene.robot.stop(scene.now);
    scene.pass(50);
    assert!(scene.end_of(id).is_some());
}

#[test]
fn a_robot_that_never_answers_is_halted_and_does_not_begin_later() {
    let mut scene = Scene::far();
    let kept = Arc::new(Mutex::new(Vec::new()));
    let keeps = Arc::clone(&kept);
    scene.spoil(move |way, packet| {
        let execute = ToRobot::read(packet).is_ok_and(|m| matches!(m, ToRobot::Execute(_)));
        if way == Way::ToRobot && execute {
            keeps.lock().unwrap().push(packet.clone());
            return Ok(vec![]);
        }
        Ok(vec![packet.clone()])
    });
    let (id, taken) = scene.begin("pick can");
    assert_eq!(taken, Ok(Taken::Sent));
    let end = scene.ending(id);
    assert!(
        matches!(
            end,
            Ended::Event(Event::Failed {
                fault: Fault::RobotLost,
                ..
            })
        ),
        "{end:?}"
    );
    // What was stuck on the way arrives after all.
    let late = kept.lock().unwrap().clone();
    assert!(late.len() > 1, "it was not given again");
    let far = Arc::clone(scene.far.as_ref().unwrap());
    for packet in late {
        let mut far = far.lock().unwrap();
        let (now, mut out) = (far.now, Vec::new());
        far.end.take(now, &packet, &mut out);
        let refused = out.iter().filter_map(|p| FromRobot::read(p).ok());
        let refused: Vec<_> = refused.collect();
        assert!(
            !refused.iter().any(|m| matches!(m, FromRobot::Accepted(_))),
            "{refused:?}"
        );
    }
    assert_eq!(scene.begun(), 0);
}

#[test]
fn a_robot_that_starts_anew_is_noticed() {
    let mut scene = Scene::far();
    let (id, _) = scene.begin("pick can");
    scene.pass(1_000);
    let fresh = Scene::far();
    let far = Arc::clone(scene.far.as_ref().unwrap());
    {
        let mut far = far.lock().unwrap();
        let lexicon = deictic::vocabulary::Lexicon::tabletop().unwrap();
        far.end = deictic::robot::end::End::new(Box::new(Sim::new(1.0)), lexicon, 2);
    }
    drop(fresh);
    scene.pass(300);
    let end = scene.end_of(id);
    assert!(
        matches!(
            end,
            Some(Ended::Event(Event::Failed {
                fault: Fault::Restarted,
                ..
            }))
        ),
        "{end:?}"
    );
    assert!(done(&scene.run("move-up")));
}
