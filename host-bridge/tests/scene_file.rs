//! A scene file becomes a table, what is wrong with one is found at its place, and a table changes
//! as a whole or not at all.

use deictic::scene::{Change, SceneFile, SceneProblem as P};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::scene::SceneError;

fn lexicon() -> Lexicon {
    Lexicon::tabletop().unwrap()
}

fn refused(text: &str) -> (P, String) {
    let lexicon = lexicon();
    let found = SceneFile::parse("test.toml", text).and_then(|file| file.tabletop(&lexicon));
    let error = found.unwrap_err();
    assert!(
        !miette::Diagnostic::help(&error)
            .unwrap()
            .to_string()
            .is_empty()
    );
    let place = error.place().map_or("", |p| &text[p]).to_owned();
    (error.into_problem(), place)
}

#[test]
fn the_shipped_scenes_are_sound() {
    let lexicon = lexicon();
    let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
    assert_eq!((table.version(), table.scene().entities().len()), (1, 9));
    let can = table.find(Category::OBJECT, 0).unwrap();
    assert_eq!(can.features[lexicon.feature("full-liquid").unwrap()], 0.9);
    assert_eq!(can.features[lexicon.feature("glued").unwrap()], 0.0);

    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/data/scenes/crowded.toml");
    let file = SceneFile::read(folder.as_ref()).unwrap();
    let lexicon = Lexicon::read(&file.vocabulary().unwrap()).unwrap();
    assert_eq!(file.tabletop(&lexicon).unwrap().scene().entities().len(), 8);
}

#[test]
fn what_is_wrong_is_found_at_its_place() {
    let can = |line: &str| format!("[[object]]\nname = \"can\"\nposition = [0.4, 0, 0.1]\n{line}");
    let (p, place) = refused("[[object]]\nname = \"cann\"\nposition = [0, 0, 0]");
    assert!(matches!(p, P::UnknownThing { .. }) && place == "\"cann\"");
    let (p, place) = refused(&can("features = { gluedd = 1 }"));
    assert!(
        matches!(p, P::UnknownFeature { .. }) && place == "gluedd",
        "{place}"
    );
    let (p, place) = refused(&can("features = { glued = 1.5 }"));
    assert!(matches!(p, P::BadLikelihood(_)) && place == "1.5");
    let (p, place) = refused(&can("features = { glued = nan }"));
    assert!(matches!(p, P::BadLikelihood(_)) && place == "nan");
    let (p, _) = refused(&can("features = { glued = \"yes\" }"));
    assert!(matches!(p, P::Syntax(_)));
    let (p, _) = refused("[[object]]\nname = \"can\"");
    assert!(matches!(p, P::Syntax(_)));
    let (p, _) = refused("[[object]]\nname = \"can\"\nposition = [0, inf, 0]");
    assert!(matches!(p, P::Refused(SceneError::BadPosition { .. })));
    let twice = format!("{}\n{}", can(""), can(""));
    let (p, place) = refused(&twice);
    assert!(matches!(p, P::Twice(thing) if thing == "can") && place == "\"can\"");
}

#[test]
fn an_empty_table_is_a_table() {
    let table = SceneFile::parse("x", "")
        .unwrap()
        .tabletop(&lexicon())
        .unwrap();
    assert!(table.scene().entities().is_empty());
}

#[test]
fn a_table_changes_as_a_whole_or_not_at_all() {
    let lexicon = lexicon();
    let mut table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
    let glued = lexicon.feature("glued").unwrap();
    let unglued = Change::Feature {
        thing: "box".into(),
        feature: glued,
        likelihood: 0.0,
    };
    let lost = Change::Moved {
        thing: "can".into(),
        position: [f32::NAN; 3],
    };
    let before = table.clone();
    assert!(table.apply(&[unglued.clone(), lost], &lexicon).is_err());
    assert_eq!(table, before);
    table.apply(&[], &lexicon).unwrap();
    assert_eq!(table.version(), 1);
    table.apply(&[unglued], &lexicon).unwrap();
    assert_eq!(table.version(), 2);
    assert_eq!(
        table.find(Category::OBJECT, 3).unwrap().features[glued],
        0.0
    );
}

#[test]
fn a_thing_in_two_categories_is_one_thing() {
    let lexicon = Lexicon::parse(
        "x",
        r#"
        name = "x"
        features = ["full"]
        [[action]]
        name = "stop"
        [[object]]
        name = "bowl"
        [[storage]]
        name = "bowl"
        "#,
    )
    .unwrap();
    let both = "[[object]]\nname = \"bowl\"\nposition = [0.4, 0, 0]\n[[storage]]\nname = \"bowl\"\nposition = [0.4, 0, 0]";
    let mut table = SceneFile::parse("x", both)
        .unwrap()
        .tabletop(&lexicon)
        .unwrap();
    let full = Change::Feature {
        thing: "bowl".into(),
        feature: 0,
        likelihood: 1.0,
    };
    table.apply(&[full], &lexicon).unwrap();
    assert!(
        table
            .scene()
            .entities()
            .iter()
            .all(|e| e.features[0] == 1.0)
    );
}
