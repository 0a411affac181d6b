//! A vocabulary file becomes a lexicon, and what is wrong with one is found at its place.

use deictic::vocabulary::{Lexicon, TABLETOP, VocabularyProblem as P};
use deictic_core::category::Category;
use deictic_core::sentence::{GESTURE, LANGUAGE};

fn refused(text: &str) -> (P, String) {
    let error = Lexicon::parse("test.toml", text).unwrap_err();
    let place = error.place().map_or("", |p| &text[p]).to_owned();
    let shown = format!("{error}");
    assert!(shown.starts_with("test.toml: "), "{shown}");
    assert!(
        !miette::Diagnostic::help(&error)
            .unwrap()
            .to_string()
            .is_empty()
    );
    (error.into_problem(), place)
}

#[test]
fn the_tabletop_has_the_papers_words() {
    let lexicon = Lexicon::tabletop().unwrap();
    let names = |c| {
        let entries = lexicon.entries(c).iter();
        entries.map(|e| e.name.as_str()).collect::<Vec<_>>()
    };
    assert_eq!(
        names(Category::ACTION),
        [
            "move-up", "release", "stop", "pick", "push", "unglue", "pour", "put-into", "stack"
        ]
    );
    assert_eq!(
        names(Category::OBJECT),
        ["can", "cup", "cube", "box", "cleaner"]
    );
    assert_eq!(
        names(Category::STORAGE),
        ["drawer", "foam", "crackers", "bowl"]
    );
    assert_eq!(lexicon.vocabulary().stop(), Some(2));
    assert!(lexicon.is_quantity_only(Category::DISTANCE));
    assert!(!lexicon.is_quantity_only(Category::DIRECTION));
    assert_eq!(lexicon.option(Category::DIRECTION, "back"), Some(3));
    assert_eq!(lexicon.category("direction"), Some(Category::DIRECTION));
    assert_eq!(lexicon.category("amount"), None);
    assert_eq!(lexicon.motion(7), Some("put-into"));
    let spoken: Vec<_> = lexicon.entries(Category::ACTION)[7].spoken().collect();
    assert_eq!(spoken[..2], ["put into", "put"]);
}

#[test]
fn the_language_tables_are_edit_distances_of_the_names() {
    let lexicon = Lexicon::tabletop().unwrap();
    for category in [Category::ACTION, Category::OBJECT, Category::STORAGE] {
        let entries = lexicon.entries(category);
        for (i, a) in entries.iter().enumerate() {
            let row = lexicon
                .similarity()
                .row(LANGUAGE, category, i as u8, entries.len());
            for (b, written) in entries.iter().zip(row) {
                let mut likeness = strsim::normalized_levenshtein(&a.name, &b.name) as f32;
                if category == Category::ACTION {
                    likeness = likeness / 2.0 + 0.5;
                }
                assert!((likeness - written).abs() <= 0.006, "{} {}", a.name, b.name);
            }
        }
    }
    assert!(lexicon.similarity().describes(GESTURE, Category::STORAGE));
}

#[test]
fn a_fingerprint_knows_every_name_and_requirement() {
    let of = |text: &str| {
        Lexicon::parse("x", text)
            .unwrap()
            .vocabulary()
            .fingerprint()
    };
    let same = of(TABLETOP);
    assert_eq!(same, of(&TABLETOP.replace("\"tin\"", "\"tin can\"")));
    assert_ne!(same, of(&TABLETOP.replace("\"cup\"", "\"mugful\"")));
    assert_ne!(
        same,
        of(&TABLETOP.replace("\"!glued\", \"!full-stack\"", "\"!glued\""))
    );
}

#[test]
fn parameters_can_be_the_users_own() {
    let lexicon = Lexicon::parse(
        "x",
        r#"
        name = "x"
        [[action]]
        name = "sprinkle"
        motion = "pour"
        compulsory = ["spice"]
        voluntary = ["amount"]
        [[parameter]]
        category = "spice"
        options = ["salt", { name = "pepper", words = ["black pepper"] }]
        [[parameter]]
        category = "amount"
        "#,
    )
    .unwrap();
    let spice = lexicon.category("spice").unwrap();
    assert_eq!(Some(spice), Category::user(0));
    assert_eq!(lexicon.entries(spice)[1].words, ["black pepper"]);
    assert_eq!(lexicon.vocabulary().options(), [1, 0, 0, 0, 0, 0, 1, 2]);
    assert_eq!(lexicon.motion(0), Some("pour"));
    assert_eq!(lexicon.language(), "en");
}

#[test]
fn what_is_wrong_is_found_at_its_place() {
    let with = |line: &str| format!("name = \"x\"\nfeatures = [\"glued\"]\n{line}");
    let act = |line: &str| with(&format!("[[action]]\nname = \"a\"\n{line}"));

    let (p, place) = refused(&act("object = [\"gluedd\"]"));
    assert!(
        matches!(p, P::UnknownFeature { .. }) && place == "\"gluedd\"",
        "{place}"
    );
    let (p, place) = refused(&act("object = [\"glued\", \"!glued\"]"));
    assert!(matches!(p, P::Contradiction(_)) && place == "\"!glued\"");
    let (p, place) = refused(&act("compulsory = [\"object\"]"));
    assert!(matches!(p, P::UnknownCategory { .. }) && place == "\"object\"");
    let (p, place) = refused(&with("stop = \"halt\"\n[[action]]\nname = \"stop\""));
    assert!(matches!(p, P::UnknownStop { .. }) && place == "\"halt\"");
    let (p, place) = refused(&act("[[action]]\nname = \"a\""));
    assert!(matches!(p, P::Twice { .. }) && place == "\"a\"");
    let (p, place) = refused(&act("[[parameter]]\ncategory = \"object\""));
    assert!(matches!(p, P::NotAParameter(_)) && place == "\"object\"");
    let (p, _) = refused(&act("[[object]]\nname = \"a b\""));
    assert!(matches!(p, P::BadName(_)));
    let (p, place) = refused(&act("colour = 1"));
    assert!(matches!(p, P::Syntax(_)) && place == "colour");
    let (p, _) = refused("name = ");
    assert!(matches!(p, P::Syntax(_)));
    let (p, _) = refused(&with(""));
    assert!(matches!(p, P::Refused(_)));
    let (p, place) = refused(&act("[similarity.gesture]\naction = [[1.0, 0.0]]"));
    assert!(matches!(p, P::BadTable { size: 1, .. }) && place == "[[1.0, 0.0]]");
    let (p, _) = refused(&act("[similarity.gesture]\naction = 1.5"));
    assert!(matches!(p, P::BadTable { .. }));
    let (p, _) = refused(&act("[similarity.language]\nobject = 0.5"));
    assert!(matches!(p, P::UnknownCategory { .. }));
}

#[test]
fn a_stop_with_parameters_is_refused_at_its_line() {
    let text = "name = \"x\"\nstop = \"a\"\n[[action]]\nname = \"a\"\ncompulsory = [\"object\"]\n[[object]]\nname = \"o\"";
    let (p, place) = refused(text);
    assert!(matches!(p, P::Refused(_)) && place == "\"a\"");
}

#[test]
fn more_than_the_capacities_is_refused() {
    let many: String = (0..65)
        .map(|i| format!("[[action]]\nname = \"a{i}\"\n"))
        .collect();
    let (p, _) = refused(&format!("name = \"x\"\n{many}"));
    assert!(matches!(p, P::Refused(_)));
}

#[test]
fn a_missing_file_is_said_to_be_missing() {
    let error = Lexicon::read("no/such.toml".as_ref()).unwrap_err();
    assert!(matches!(error.problem(), P::Unreadable(_)));
}
