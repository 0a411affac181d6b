//! A session joins unit, robot and table: what is decided is done, what was done is there for the
//! next decision, the person is asked, and a stop waits for nobody.

mod common;

use common::*;
use deictic::answering::certainly;
use deictic::robot::{Event, Refusal};
use deictic::scene::SceneFile;
use deictic::session::Happening;
use deictic::showing::showing;
use deictic_core::category::Category;
use deictic_core::decide::{Outcome, Reason};
use deictic_core::large::{Sentence, Word};
use deictic_core::protocol::message::Fault;
use deictic_core::sentence::{LANGUAGE, SentenceError};

#[test]
fn what_is_said_and_shown_is_done_and_the_next_decision_knows() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    session
        .observe(said("put the can into the drawer", &lexicon))
        .unwrap();
    session
        .observe(showing("put-into can drawer", &lexicon).unwrap())
        .unwrap();
    let happened = settle(&mut session);
    assert!(happened.iter().any(is_done), "{happened:#?}");
    let version = session.table().version();
    assert!(version > 1);

    session
        .observe(said("put the cup into the drawer", &lexicon))
        .unwrap();
    let happened = settle(&mut session);
    let asked = happened.iter().find_map(|h| match h {
        Happening::Decided {
            scene, decision, ..
        } => Some((*scene, decision.outcome.clone())),
        _ => None,
    });
    let (scene, outcome) = asked.unwrap();
    assert_eq!(
        scene, version,
        "the unit knows the table as the robot left it"
    );
    assert!(
        matches!(&outcome, Outcome::Ask(q) if q.reason == Reason::Infeasible),
        "{outcome:?}"
    );
    assert!(!moved(&happened));
}

#[test]
fn a_question_is_answered_and_the_answer_prevails() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    // The box is glued, and both modalities are certain of it.
    session.observe(surely_said("pick box", &lexicon)).unwrap();
    session
        .observe(showing("pick box", &lexicon).unwrap())
        .unwrap();
    let happened = settle(&mut session);
    assert!(!moved(&happened));
    let question = session.question().unwrap().clone();
    assert_eq!(
        (question.category, question.reason),
        (Category::OBJECT, Reason::Infeasible)
    );
    let cup = lexicon.option(Category::OBJECT, "cup").unwrap();
    session
        .answer(certainly(Category::OBJECT, cup, &lexicon).unwrap())
        .unwrap();
    let happened = settle(&mut session);
    assert!(happened.iter().any(is_done), "{happened:#?}");
    assert_eq!(session.holding(), Some("cup"));
    assert_eq!(session.question(), None);
}

#[test]
fn a_stop_is_at_the_robot_before_the_unit_has_heard_of_it() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1.0);
    session
        .observe(showing("pick can", &lexicon).unwrap())
        .unwrap();
    let begun = |h: &Happening| matches!(h, Happening::Robot(Event::Begun { number: 2, .. }));
    until(&mut session, begun);
    cable.with(|line| line.dead = true);
    session.observe(said("stop", &lexicon)).unwrap();
    let happened = session.turn(std::time::Duration::ZERO);
    let stopped = |h: &Happening| matches!(h, Happening::Robot(Event::Stopped { .. }));
    assert!(happened.iter().any(stopped), "{happened:#?}");
    assert_eq!(session.progress(), None);
}

#[test]
fn the_unit_decides_on_a_stop_among_other_words_while_the_robot_moves() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1.0);
    session
        .observe(showing("pick can", &lexicon).unwrap())
        .unwrap();
    let begun = |h: &Happening| matches!(h, Happening::Robot(Event::Begun { number: 2, .. }));
    until(&mut session, begun);
    session
        .observe(showing("stop can", &lexicon).unwrap())
        .unwrap();
    let happened = until(&mut session, is_done);
    let stopped = |h: &Happening| matches!(h, Happening::Robot(Event::Stopped { .. }));
    assert!(happened.iter().any(stopped), "{happened:#?}");
    assert_eq!(session.progress(), None);
}

#[test]
fn the_robot_has_the_last_word() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    for text in ["pick can", "pick cup"] {
        session.observe(surely_said(text, &lexicon)).unwrap();
        session.observe(showing(text, &lexicon).unwrap()).unwrap();
        let happened = settle(&mut session);
        let refused = happened.iter().find_map(|h| match h {
            Happening::Refused { refusal, .. } => Some(refusal.clone()),
            _ => None,
        });
        match text {
            "pick can" => assert_eq!(refused, None),
            _ => assert_eq!(refused, Some(Refusal::Holding("can".into()))),
        }
    }
    assert_eq!(session.holding(), Some("can"));
}

#[test]
fn queued_commands_follow_each_other_until_one_fails() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    session.queue([
        said("unglue the box", &lexicon),
        said("put the box into the drawer", &lexicon),
        said("pick the cleaner", &lexicon),
        said("pick the can", &lexicon),
    ]);
    let dropped = |h: &Happening| matches!(h, Happening::Dropped(1));
    let happened = until(&mut session, dropped);
    assert_eq!(
        happened.iter().filter(|h| is_done(h)).count(),
        2,
        "{happened:#?}"
    );
    assert_eq!(session.holding(), None);
}

#[test]
fn on_an_empty_table_nothing_moves() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let empty = SceneFile::parse("x", "")
        .unwrap()
        .tabletop(&lexicon)
        .unwrap();
    let mut session = open_on(&cable, &lexicon, 1000.0, empty);
    for text in [
        "pick the can",
        "put the cup into the drawer",
        "unglue the box",
    ] {
        session.observe(said(text, &lexicon)).unwrap();
        let happened = settle(&mut session);
        assert!(!moved(&happened), "{text}: {happened:#?}");
    }
}

#[test]
fn what_the_unit_refuses_is_told_and_moves_nothing() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    let mut bad = Sentence::new(LANGUAGE);
    bad.push(Word::certain(Category::ACTION, &[f32::NAN; 9]).unwrap())
        .unwrap();
    session.observe(bad).unwrap();
    let happened = settle(&mut session);
    let fault = Fault::Sentence {
        modality: LANGUAGE,
        error: SentenceError::BadLikelihood { word: 0 },
    };
    assert!(happened.contains(&Happening::Fault(fault)), "{happened:#?}");
    assert!(!moved(&happened));
    session
        .observe(showing("pick can", &lexicon).unwrap())
        .unwrap();
    assert!(settle(&mut session).iter().any(is_done));
}

#[test]
fn what_is_said_and_shown_together_is_one_decision_on_however_slow_a_machine() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    // Longer than the window.
    cable.with(|line| line.slow = std::time::Duration::from_millis(80));
    let shown = showing("pick can", &lexicon).unwrap();
    session
        .observe_together(&[shown, said("pick the can", &lexicon)])
        .unwrap();
    cable.with(|line| line.slow = std::time::Duration::ZERO);
    let happened = settle(&mut session);
    let decided = |h: &&Happening| matches!(h, Happening::Decided { .. });
    assert_eq!(happened.iter().filter(decided).count(), 1, "{happened:#?}");
    assert!(happened.iter().any(is_done));
    assert!(
        !happened
            .iter()
            .any(|h| matches!(h, Happening::Refused { .. }))
    );
}
