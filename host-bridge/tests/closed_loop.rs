//! A long session in which every command depends on what the ones before it did to the table: each
//! decision is made on the scene that the last one left.

mod common;

use common::*;
use deictic::explain;
use deictic::session::{Happening, Session};
use deictic::showing::showing;
use deictic_core::category::Category;
use deictic_core::decide::Outcome;
use deictic_core::large::Intent;

/// What a command comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Comes {
    /// The robot does what was said and shown.
    ToPass,
    /// The unit sees in the scene that it cannot be done, and asks.
    ToAsking,
}
use Comes::{ToAsking, ToPass};

/// What is said, what is shown, what it comes to.
const SESSION: [(&str, &str, Comes); 20] = [
    ("pick the box", "pick box", ToAsking),
    ("unglue the box", "unglue box", ToPass),
    ("put the box into the drawer", "put-into box drawer", ToPass),
    // The drawer is full now.
    (
        "put the can into the drawer",
        "put-into can drawer",
        ToAsking,
    ),
    ("pour the can into the bowl", "pour can bowl", ToPass),
    // The can is empty, and the bowl is full.
    ("pour the can into the bowl", "pour can bowl", ToAsking),
    ("stack the cube on the foam", "stack cube foam", ToPass),
    ("stack the cup on the foam", "stack cup foam", ToAsking),
    ("pick the cube", "pick cube", ToPass),
    (
        "stack the cube on the crackers",
        "stack cube crackers",
        ToPass,
    ),
    // The foam is free again.
    ("stack the cup on the foam", "stack cup foam", ToPass),
    // The box comes out of the drawer and goes back into it as the hand opens over it.
    ("pick the box", "pick box", ToPass),
    ("release", "release", ToPass),
    (
        "put the can into the drawer",
        "put-into can drawer",
        ToAsking,
    ),
    ("pick the box", "pick box", ToPass),
    (
        "stack the box on the crackers",
        "stack box crackers",
        ToAsking,
    ),
    ("release", "release", ToPass),
    ("unglue the box", "unglue box", ToAsking),
    ("push the can to the left", "push can left", ToPass),
    ("pick the can", "pick can", ToPass),
];

/// The scene and outcome of the only decision in `happened`.
fn decision(happened: &[Happening]) -> (u32, Outcome<16>) {
    let mut decided = happened.iter().filter_map(|h| match h {
        Happening::Decided {
            scene, decision, ..
        } => Some((*scene, decision.outcome.clone())),
        _ => None,
    });
    let first = decided.next().expect("a decision");
    assert!(decided.next().is_none(), "one decision for one command");
    first
}

fn intent_of(outcome: &Outcome<16>) -> Option<&Intent> {
    match outcome {
        Outcome::Execute(intent) => Some(intent),
        _ => None,
    }
}

fn feature(session: &Session<'_>, category: Category, name: &str, feature: &str) -> f32 {
    let lexicon = session.lexicon();
    let option = lexicon.option(category, name).unwrap();
    let thing = session.table().find(category, option).unwrap();
    thing.features[lexicon.feature(feature).unwrap()]
}

#[test]
fn every_decision_sees_the_scene_that_the_last_one_made() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    for (i, (text, shown, comes)) in SESSION.into_iter().enumerate() {
        let before = session.table().version();
        session.observe(said(text, &lexicon)).unwrap();
        session.observe(showing(shown, &lexicon).unwrap()).unwrap();
        let happened = settle(&mut session);
        let (scene, outcome) = decision(&happened);
        assert_eq!(scene, before, "{i} {text}: made on the present scene");
        match comes {
            ToPass => {
                let done = intent_of(&outcome).map(|i| explain::intent(i, &lexicon));
                assert!(
                    happened.iter().any(is_done),
                    "{i} {text}: {done:?} {happened:#?}"
                );
                assert!(session.table().version() > before, "{i} {text}");
            }
            ToAsking => {
                assert!(
                    matches!(outcome, Outcome::Ask(_)),
                    "{i} {text}: {outcome:?}"
                );
                assert!(!moved(&happened), "{i} {text}");
                assert_eq!(session.table().version(), before, "{i} {text}");
                session.stop();
            }
        }
    }
    let (object, storage) = (Category::OBJECT, Category::STORAGE);
    for (category, thing, name, likelihood) in [
        (object, "box", "glued", 0.0),
        (storage, "drawer", "full-container", 1.0),
        (storage, "bowl", "full-liquid", 1.0),
        (object, "can", "full-liquid", 0.0),
        (storage, "foam", "full-stack", 1.0),
        (storage, "crackers", "full-stack", 1.0),
    ] {
        let is = feature(&session, category, thing, name);
        assert_eq!(is, likelihood, "{thing} {name}");
    }
    assert_eq!(session.holding(), Some("can"));
}
