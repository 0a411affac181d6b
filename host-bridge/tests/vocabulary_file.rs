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
    let (p, place) = refused(&act("[[object]]\nname = \"a b\""));
    assert!(matches!(p, P::BadName(_)) && place == "\"a b\"");
    let (p, place) = refused(&act(
        "words = [\"box up\"]\n[[storage]]\nname = \"b\"\nwords = [\"Box-up\"]",
    ));
    assert!(matches!(p, P::DoneAndNamed { .. }) && place == "\"Box-up\"");
    let (p, place) = refused(&act("colour = 1"));
    assert!(matches!(p, P::Syntax(_)) && place == "colour");
    let (p, _) = refused("name = ");
    assert!(matches!(p, P::Syntax(_)));
    let (p, _) = refused(&with(""));
    assert!(matches!(p, P::Refused(_)));
    let (p, place) = refused(&act("[similarity.gesture]\naction = [[1.0, 0.0]]"));
    assert!(matches!(
        p,
        P::TableSize {
            rows: 1,
            columns: 2,
            size: 1,
            ..
        }
    ));
    assert_eq!(place, "[[1.0, 0.0]]");
    let (p, _) = refused(&act("[similarity.gesture]\naction = 1.5"));
    assert!(matches!(p, P::NoLikelihood { value: 1.5, .. }));
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

#[test]
fn an_action_more_than_its_similarity_table_has_is_told_what_to_do() {
    let wipe = "[[action]]\nname = \"wipe\"\n\n[[object]]";
    let (p, place) = refused(&TABLETOP.replacen("[[object]]", wipe, 1));
    assert!(matches!(
        p,
        P::TableSize {
            rows: 9,
            columns: 9,
            size: 10,
            ..
        }
    ));
    assert!(place.starts_with("[\n    [1.00"), "{place}");
    let advice = deictic::diagnose::Problem::remedy(&p);
    assert!(
        advice.contains("may be left out") && advice.contains("a row and a column"),
        "{advice}"
    );
    // And so they may.
    let (without, _) = TABLETOP.split_once("# What recognisers make").unwrap();
    let lexicon = Lexicon::parse("x", &without.replacen("[[object]]", wipe, 1)).unwrap();
    assert_eq!(lexicon.entries(Category::ACTION).len(), 10);
}

#[test]
fn a_word_or_gesture_stands_for_one_option_of_a_category() {
    let two = |first: &str, second: &str| {
        format!(
            "name = \"x\"\n[[action]]\nname = \"a\"\n{first}\n[[action]]\nname = \"b\"\n{second}\n"
        )
    };
    for (first, second, at) in [
        ("words = [\"go\"]", "words = [\"run\", \"Go\"]", "\"Go\""),
        ("words = [\"B\"]", "", "\"b\""),
        ("words = [\"go on\"]", "words = [\"go-on\"]", "\"go-on\""),
        (
            "gestures = [\"wave\"]",
            "gestures = [\"nod\", \"wave\"]",
            "\"wave\"",
        ),
    ] {
        let (p, place) = refused(&two(first, second));
        let P::Shared { first, second, .. } = p else {
            panic!("{p}")
        };
        assert_eq!((&first[..], &second[..], &place[..]), ("a", "b", at));
    }
    for words in [
        "words = [\"\"]",
        "words = [\"go\", \" ?\"]",
        "gestures = [\" \"]",
    ] {
        let (p, _) = refused(&two(words, ""));
        assert!(matches!(p, P::EmptyWord(_)), "{words}: {p}");
    }
    // One of another category is another thing, as a box that one can put things into.
    let both = "name = \"x\"\n[[action]]\nname = \"a\"\n[[object]]\nname = \"box\"\n[[storage]]\nname = \"box\"\n";
    assert!(Lexicon::parse("x", both).is_ok());
}

#[test]
fn a_gesture_that_is_misspelt_is_refused_and_one_of_the_users_own_is_not() {
    let with = |gesture: &str| {
        format!("name = \"x\"\n[[action]]\nname = \"a\"\ngestures = [\"{gesture}\"]\n")
    };
    for (wrong, right) in [
        ("swip-up", "swipe-up"),
        ("swipe-rihgt", "swipe-right"),
        ("pinhc", "pinch"),
    ] {
        let (p, place) = refused(&with(wrong));
        let P::UnknownGesture { nearest, .. } = p else {
            panic!("{p}")
        };
        assert_eq!((nearest, place), (right, format!("\"{wrong}\"")));
    }
    for own in ["zigzag", "open-hand", "wave2", "point-left", "nod"] {
        assert!(Lexicon::parse("x", &with(own)).is_ok(), "{own}");
    }
    for reserved in ["grab", "point"] {
        let (p, _) = refused(&with(reserved));
        assert!(matches!(p, P::Reserved(_)), "{p}");
    }
}
