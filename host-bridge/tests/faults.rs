//! Whatever happens to the line or the unit, the robot does not move by it: it stands still or goes
//! on being stoppable, the person is told, and nothing is done twice.

mod common;

use std::time::Duration;

use common::*;
use deictic::link::Wire;
use deictic::robot::Event;
use deictic::session::{Happening, Session};
use deictic::showing::showing;
use deictic::unit::Loss;
use deictic_core::large::{ToHost, ToUnit};

fn is_decision(message: &ToHost) -> bool {
    matches!(message, ToHost::Decision(_))
}

fn lost(h: &Happening) -> bool {
    matches!(h, Happening::Lost(_))
}

fn back(h: &Happening) -> bool {
    matches!(h, Happening::Back(_))
}

#[test]
fn a_cable_that_is_pulled_stops_the_robot_and_the_unit_is_loaded_anew() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1.0);
    session
        .observe(showing("pick can", &lexicon).unwrap())
        .unwrap();
    until(&mut session, |h| {
        matches!(h, Happening::Robot(Event::Begun { number: 3, .. }))
    });
    cable.with(|line| line.cut = true);
    let happened = until(&mut session, |h| {
        matches!(h, Happening::Robot(Event::Stopped { .. }))
    });
    assert!(happened.iter().any(lost));
    assert!(
        session
            .observe(showing("pick can", &lexicon).unwrap())
            .is_err()
    );
    cable.with(|line| line.cut = false);
    let happened = until(&mut session, back);
    assert!(!moved(&happened));
    let happened = settle(&mut session);
    assert!(!moved(&happened), "nothing of before is done after");
    assert!(cable.with(|line| line.opened) >= 2);
    session
        .observe(showing("pick can", &lexicon).unwrap())
        .unwrap();
    let happened = until(&mut session, |h| matches!(h, Happening::Decided { .. }));
    assert!(happened.iter().any(|h| matches!(
        h,
        Happening::Decided { scene, .. } if *scene == session.table().version()
    )));
}

#[test]
fn a_unit_that_falls_silent_is_missed() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1.0);
    session
        .observe(showing("pick can", &lexicon).unwrap())
        .unwrap();
    until(&mut session, |h| {
        matches!(h, Happening::Robot(Event::Begun { .. }))
    });
    cable.with(|line| line.dead = true);
    let happened = until(&mut session, lost);
    assert!(
        happened.contains(&Happening::Lost(Loss::Silent)),
        "{happened:#?}"
    );
    assert_eq!(session.progress(), None);
    cable.with(|line| line.dead = false);
    until(&mut session, back);
}

#[test]
fn a_unit_that_restarts_is_loaded_anew_and_its_first_decision_counts() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    session
        .observe(showing("pick can", &lexicon).unwrap())
        .unwrap();
    settle(&mut session);
    cable.restart();
    let happened = until(&mut session, lost);
    assert!(
        happened.contains(&Happening::Lost(Loss::Forgetful)),
        "{happened:#?}"
    );
    until(&mut session, back);
    session
        .observe(showing("put-into can bowl", &lexicon).unwrap())
        .unwrap();
    let happened = settle(&mut session);
    assert!(happened.iter().any(is_done), "{happened:#?}");
}

#[test]
fn a_decision_that_was_made_before_the_loss_is_not_carried_out_after_it() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    let held: std::sync::Arc<std::sync::Mutex<Vec<u8>>> = Default::default();
    let keep = held.clone();
    cable.with(|line| {
        line.filter = Some(Box::new(move |message, frame| {
            if is_decision(message) {
                keep.lock().unwrap().extend(frame);
                return Vec::new();
            }
            let mut all = std::mem::take(&mut *keep.lock().unwrap());
            // The old decision comes first of all that is heard after the loss.
            if matches!(message, ToHost::Hello(_)) {
                all.extend(frame);
                return all;
            }
            keep.lock().unwrap().extend(all);
            frame.to_vec()
        }));
    });
    session
        .observe(showing("pick can", &lexicon).unwrap())
        .unwrap();
    for _ in 0..100 {
        assert!(!moved(&session.turn(Duration::from_millis(1))));
    }
    assert!(!held.lock().unwrap().is_empty());
    cable.with(|line| line.cut = true);
    until(&mut session, lost);
    cable.with(|line| line.cut = false);
    let happened = until(&mut session, back);
    assert!(!moved(&happened));
    let happened = settle(&mut session);
    assert!(!moved(&happened), "{happened:#?}");
    assert_eq!(session.holding(), None);
}

#[test]
fn a_corrupted_decision_moves_nothing() {
    for at in [0, 3, 7] {
        let (cable, lexicon) = (Cable::new(), lexicon());
        let mut session = open(&cable, &lexicon, 1000.0);
        cable.with(|line| {
            line.filter = Some(Box::new(move |message, frame| {
                let mut frame = frame.to_vec();
                if is_decision(message) {
                    let place = at % (frame.len() - 1);
                    frame[place] ^= 0x11;
                }
                frame
            }));
        });
        session
            .observe(showing("pick can", &lexicon).unwrap())
            .unwrap();
        let happened = until(&mut session, |h| *h == Happening::NoDecision);
        assert!(!moved(&happened), "{happened:#?}");
        assert_eq!(session.holding(), None);
        cable.with(|line| line.filter = None);
        // The unit is loaded anew, so that nothing of before can come late.
        until(&mut session, back);
        session
            .observe(showing("pick can", &lexicon).unwrap())
            .unwrap();
        settle(&mut session);
        assert_eq!(session.holding(), Some("can"));
    }
}

#[test]
fn a_scene_that_does_not_arrive_is_noticed_and_sent_again() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    cable.with(|line| line.swallow = Some(|said| matches!(said, ToUnit::Scene(_))));
    session
        .observe(showing("pick can", &lexicon).unwrap())
        .unwrap();
    let happened = until(&mut session, lost);
    assert!(
        happened.contains(&Happening::Lost(Loss::Stale)),
        "{happened:#?}"
    );
    cable.with(|line| line.swallow = None);
    until(&mut session, back);
    session
        .observe(showing("put-into can drawer", &lexicon).unwrap())
        .unwrap();
    let happened = settle(&mut session);
    assert!(happened.iter().any(is_done), "{happened:#?}");
}

#[test]
fn noise_between_frames_neither_moves_the_robot_nor_holds_it_up() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    let mut seed = 7_u32;
    cable.with(|line| {
        line.filter = Some(Box::new(move |_, frame| {
            let noise = (0..40).map(|_| {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (seed >> 24) as u8
            });
            let mut arrived: Vec<u8> = noise.collect();
            arrived.push(0);
            arrived.extend(frame);
            arrived
        }));
    });
    for text in ["push cube", "unglue box"] {
        session.observe(showing(text, &lexicon).unwrap()).unwrap();
        let happened = settle(&mut session);
        let accepted = |h: &&Happening| matches!(h, Happening::Accepted(_));
        assert_eq!(happened.iter().filter(accepted).count(), 1, "{happened:#?}");
        assert_eq!(happened.iter().filter(|h| is_done(h)).count(), 1);
    }
}

/// A line on which nothing arrives before this moment, and then all at once.
struct Late(Cable, std::time::Instant);

impl Wire for Late {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<()> {
        self.0.write(bytes)
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> std::io::Result<usize> {
        if std::time::Instant::now() < self.1 {
            std::thread::sleep(patience.min(Duration::from_millis(5)));
            return Ok(0);
        }
        self.0.read(buffer, patience)
    }
}

#[test]
fn a_unit_that_answers_several_greetings_at_once_has_not_restarted() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let table = table(&lexicon);
    let wire = cable.clone();
    let opener = Box::new(move || {
        // The unit is greeted every half second.
        let late = std::time::Instant::now() + Duration::from_millis(1_200);
        Ok(Box::new(Late(wire.clone(), late)) as Box<dyn Wire>)
    });
    let robot = Box::new(deictic::robot::sim::Sim::new(1000.0));
    let configuration = deictic_core::protocol::message::Configuration::DEFAULT;
    let mut session = Session::open(opener, robot, table, &lexicon, configuration).unwrap();
    session.observe(surely_said("pick can", &lexicon)).unwrap();
    let happened = settle(&mut session);
    let lost = |h: &Happening| matches!(h, Happening::Lost(_));
    assert!(!happened.iter().any(lost), "{happened:#?}");
    assert!(happened.iter().any(is_done));
}
