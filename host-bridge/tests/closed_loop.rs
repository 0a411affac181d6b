//! A long session in which every command depends on what the ones before it did to the table: each
//! decision is made on the scene that the last one left.

mod common;

use common::*;
use deictic::explain;
use deictic::scene::SceneFile;
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

/// Plays commands one after the other, each decided on the scene that the last one left.
fn play(session: &mut Session<'_>, commands: &[(&str, &str, Comes)]) {
    let lexicon = session.lexicon();
    for (i, &(text, shown, comes)) in commands.iter().enumerate() {
        let before = session.table().version();
        let sentences = [showing(shown, lexicon).unwrap(), said(text, lexicon)];
        session.observe_together(&sentences).unwrap();
        let happened = settle(session);
        let (scene, outcome) = decision(&happened);
        assert_eq!(scene, before, "{i} {text}: made on the present scene");
        match comes {
            ToPass => {
                let done = intent_of(&outcome).map(|i| explain::intent(i, lexicon));
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
}

#[test]
fn every_decision_sees_the_scene_that_the_last_one_made() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    play(&mut session, &SESSION);
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

/// A can of 0.33 l and a cup of 0.25 l, both full, and a bowl that takes half a litre.
const DRINKS: &str = r#"
[[object]]
name = "can"
position = [0.45, 0.10, 0.06]
features = { reachable = true, pickable = true, full-liquid = true }
holds = 0.33
liquid = 0.33

[[object]]
name = "cup"
position = [0.40, -0.12, 0.05]
features = { reachable = true, pickable = true, full-liquid = true }
holds = 0.25
liquid = 0.25

[[storage]]
name = "bowl"
position = [0.44, -0.24, 0.04]
features = { reachable = true, container = true, liquid-container = true }
holds = 0.5
"#;

#[test]
fn a_container_fills_up_and_what_is_poured_from_runs_empty() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let table = SceneFile::parse("drinks", DRINKS).unwrap();
    let table = table.tabletop(&lexicon).unwrap();
    let mut session = open_on(&cable, &lexicon, 1000.0, table);
    let (object, storage) = (Category::OBJECT, Category::STORAGE);
    let pour_can = ("pour the can into the bowl", "pour can bowl");
    let pour_cup = ("pour the cup into the bowl", "pour cup bowl");
    let comes = |(said, shown), comes| (said, shown, comes);
    play(&mut session, &[comes(pour_can, ToPass)]);
    assert_eq!(feature(&session, object, "can", "full-liquid"), 0.0);
    assert_eq!(feature(&session, storage, "bowl", "full-liquid"), 0.0);
    play(
        &mut session,
        &[
            // Nothing is left in the can, but the bowl takes 0.17 l more.
            comes(pour_can, ToAsking),
            comes(pour_cup, ToPass),
            // 0.08 l are left in the cup, and the bowl takes no more.
            comes(pour_cup, ToAsking),
        ],
    );
    assert_eq!(feature(&session, object, "cup", "full-liquid"), 1.0);
    assert_eq!(feature(&session, storage, "bowl", "full-liquid"), 1.0);
}
