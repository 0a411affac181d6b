//! A robot at the far end of a line does what one in this process does: commands, a stop, a hold, the way home.

#[path = "common/far.rs"]
mod far;

use std::sync::Arc;

use deictic::robot::{CommandId, Event, Refusal, Taken};
use deictic_core::command::message::{FromRobot, ToRobot};
use far::{Ended, Scene, Way};

/// Commands that depend on each other: what one does decides whether the next can be done.
const SESSION: [&str; 14] = [
    "pick box",
    "unglue box",
    "unglue box",
    "put-into box drawer",
    "put-into can drawer",
    "pick box",
    "pick can",
    "release",
    "pour can bowl",
    "pour can bowl",
    "push cup left",
    "stack cube crackers",
    "stack cup crackers",
    "move-up",
];

fn done(end: &Ended) -> bool {
    matches!(end, Ended::Event(Event::Done(_)))
}

#[test]
fn a_far_robot_does_what_a_near_one_does() {
    let (mut near, mut far) = (Scene::near(), Scene::far());
    for written in SESSION {
        let (here, there) = (near.run(written), far.run(written));
        assert_eq!(here, there, "{written}");
        assert_eq!(near.robot.holding(), far.robot.holding(), "{written}");
        near.pass(300);
        far.pass(300);
    }
    assert_eq!(near.table.version(), far.table.version());
    for (a, b) in near
        .table
        .scene()
        .entities()
        .iter()
        .zip(far.table.scene().entities())
    {
        assert_eq!((a.category, a.option), (b.category, b.option));
        for (x, y) in a.position.iter().zip(b.position) {
            assert!((x - y).abs() <= 0.000_051, "{a:?} {b:?}");
        }
        for (x, y) in a.features.iter().zip(&b.features) {
            assert!((x - y).abs() <= 0.002, "{a:?} {b:?}");
        }
    }
    let steps = |events: &[Event]| -> Vec<Event> {
        let all = events.iter().filter(|e| matches!(e, Event::Begun { .. }));
        all.cloned().collect()
    };
    assert_eq!(steps(&near.events), steps(&far.events));
    assert!(
        far.events
            .iter()
            .filter(|e| matches!(e, Event::Done(_)))
            .count()
            >= 8
    );
}

#[test]
fn a_stop_stops_it_where_it_is_and_voids_what_is_on_the_way() {
    let mut scene = Scene::far();
    let (id, taken) = scene.begin("pick can");
    assert_eq!(taken, Ok(Taken::Begun));
    scene.pass(2_000);
    scene.robot.stop(scene.now);
    scene.tick();
    let Some(Ended::Event(Event::Stopped { step, .. })) = scene.end_of(id) else {
        panic!("{:?}", scene.events);
    };
    assert!(step.contains("the can"), "{step}");
    assert!(done(&scene.run("move-up")));
}

#[test]
fn another_bridge_is_not_heard_while_this_one_lives() {
    use deictic_core::command::field::{Id, Number};
    use deictic_core::command::message::{Home, HostBeat};
    let mut scene = Scene::far();
    let (id, _) = scene.begin("pick can");
    let far = Arc::clone(scene.far.as_ref().unwrap());
    let number = Number::new(900).unwrap();
    let other = Id { run: 7, number };
    for message in [
        ToRobot::from(HostBeat { id: other }),
        Home { id: other }.into(),
    ] {
        let mut far = far.lock().unwrap();
        let (now, mut out) = (far.now, Vec::new());
        far.end.take(now, &message.packet(), &mut out);
        let said: Vec<_> = out.iter().filter_map(|p| FromRobot::read(p).ok()).collect();
        assert!(
            said.iter()
                .all(|m| matches!(m, FromRobot::Refused(_) | FromRobot::Step(_))),
            "{said:?}"
        );
    }
    assert!(done(&scene.ending(id)));
}

/// Lets ten seconds pass and expects that the arm stands still all the while.
fn stands(scene: &mut Scene) {
    let posture = scene.robot.posture(scene.now);
    scene.pass(10_000);
    assert_eq!(scene.robot.posture(scene.now), posture);
}

#[test]
fn a_held_command_stands_and_goes_on_whichever_packets_are_lost() {
    for lost in 0..4 {
        let mut scene = Scene::far();
        let (id, _) = scene.begin("pick can");
        scene.pass(1_000);
        let mut count = 0;
        scene.spoil(move |way, packet| {
            let said = ToRobot::read(packet);
            let ours = matches!(said, Ok(ToRobot::Hold(_) | ToRobot::Resume(_)));
            count += usize::from(way == Way::ToRobot && ours);
            let gone = way == Way::ToRobot && ours && count <= lost;
            Ok(if gone { vec![] } else { vec![packet.clone()] })
        });
        scene.robot.hold(scene.now).unwrap();
        scene.pass(1_000);
        assert!(scene.events.contains(&Event::Held(id)), "{lost} lost");
        stands(&mut scene);
        assert_eq!(scene.run("move-up"), Ended::Refused(Refusal::Busy));
        scene.robot.resume(scene.now).unwrap();
        scene.pass(300);
        assert!(scene.events.contains(&Event::Resumed(id)), "{lost} lost");
        assert_eq!(scene.robot.resume(scene.now), Err(Refusal::NotHeld));
        assert!(done(&scene.ending(id)));
        assert_eq!(scene.begun(), 1);
    }
}

#[test]
fn a_stop_ends_what_is_held_and_nothing_is_held_of_an_arm_that_stands() {
    let mut scene = Scene::far();
    assert_eq!(scene.robot.hold(scene.now), Err(Refusal::Idle));
    let (id, _) = scene.begin("pick can");
    scene.pass(1_000);
    scene.robot.hold(scene.now).unwrap();
    scene.pass(300);
    scene.robot.stop(scene.now);
    let end = scene.ending(id);
    assert!(
        matches!(end, Ended::Event(Event::Stopped { .. })),
        "{end:?}"
    );
    assert_eq!(scene.robot.resume(scene.now), Err(Refusal::NotHeld));
    assert!(done(&scene.run("move-up")));
}

#[test]
fn a_far_arm_goes_home_once() {
    let mut scene = Scene::far();
    assert!(done(&scene.run("move-up")));
    scene.pass(300);
    let away = scene.robot.posture(scene.now);
    scene.number += 1;
    let id = CommandId {
        run: 1,
        number: scene.number,
    };
    assert_eq!(scene.robot.home(scene.now, id), Ok(Taken::Begun));
    assert!(done(&scene.ending(id)));
    scene.pass(300);
    assert_ne!(scene.robot.posture(scene.now), away);
    assert_eq!(scene.robot.home(scene.now, id), Err(Refusal::Repeated));
    assert_eq!(scene.begun(), 2);
}
