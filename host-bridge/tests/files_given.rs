//! Files that a person gives: what is wrong with them is told with the file, the line and what to do.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const TABLETOP: &str = include_str!("../data/tabletop.toml");
const TABLE: &str = include_str!("../data/scenes/table.toml");

/// A folder of this test's own.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("files_given")
        .join(name);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn deictic(folder: &Path, arguments: &[&str]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_deictic"));
    program
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// What a command that is refused says, in one line.
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let output = deictic(folder, arguments);
    let (out, err) = (output.stdout, String::from_utf8(output.stderr).unwrap());
    assert!(
        !output.status.success(),
        "{arguments:?} was taken: {}",
        String::from_utf8_lossy(&out)
    );
    let words = err.split(|c: char| c.is_whitespace() || c == '│');
    words
        .filter(|word| !word.is_empty())
        .collect::<Vec<_>>()
        .join(" ")
}

const PICK: [&str; 3] = ["decide", "--say", "pick the can"];

fn has(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "no {part:?} in: {text}");
    }
}

#[test]
fn a_scene_whose_vocabulary_is_not_there_says_in_which_line_it_names_it() {
    let folder = folder("moved");
    std::fs::write(folder.join("table.toml"), TABLE).unwrap();
    let error = refused(&folder, &[&PICK[..], &["--scene", "table.toml"]].concat());
    has(
        &error,
        &[
            "table.toml:4:",
            "tabletop.toml cannot be read",
            "as seen from this file",
        ],
    );
    assert_eq!(error.matches("No such file").count(), 1, "{error}");
}

#[test]
fn a_vocabulary_without_its_scene_asks_for_it() {
    let folder = folder("alone");
    let own = "name = \"x\"\n[[action]]\nname = \"sweep\"\ncompulsory = [\"object\"]\n[[object]]\nname = \"crumb\"\n";
    std::fs::write(folder.join("mine.toml"), own).unwrap();
    let error = refused(
        &folder,
        &[
            "decide",
            "--say",
            "sweep the crumb",
            "--vocabulary",
            "mine.toml",
        ],
    );
    has(&error, &["mine.toml", "--scene FILE"]);
}

#[test]
fn a_language_without_a_pack_is_shown_in_its_line() {
    let folder = folder("language");
    for (language, why) in [("de", "no language pack"), ("mine.toml", "mine.toml")] {
        let text = TABLETOP.replace("language = \"en\"", &format!("language = \"{language}\""));
        std::fs::write(folder.join("words.toml"), text).unwrap();
        let error = refused(
            &folder,
            &[&PICK[..], &["--vocabulary", "words.toml"]].concat(),
        );
        has(&error, &["words.toml:3:", why]);
    }
}

/// German, as far as one sentence goes.
const GERMAN: &str = r#"language = "de"
fillers = ["den", "bitte"]
[role]
not = ["nicht"]
question = ["wo"]
"#;

#[test]
fn a_pack_beside_the_vocabulary_is_named_with_or_without_its_ending() {
    let folder = folder("beside");
    std::fs::write(folder.join("de.toml"), GERMAN).unwrap();
    // One of the user's own comes before one that is built in.
    std::fs::write(folder.join("cs.toml"), GERMAN).unwrap();
    for language in ["de", "de.toml", "cs"] {
        let text = TABLETOP
            .replace("language = \"en\"", &format!("language = \"{language}\""))
            .replace("words = [\"pick up\"", "words = [\"nimm\", \"pick up\"");
        std::fs::write(folder.join("words.toml"), text).unwrap();
        let done = deictic(
            &folder,
            &[
                "decide",
                "--vocabulary",
                "words.toml",
                "--say",
                "nimm bitte den cup",
            ],
        );
        assert_eq!(
            String::from_utf8_lossy(&done.stdout),
            "execute  pick cup\n",
            "{language}"
        );
    }
}

#[test]
fn what_is_wrong_with_a_pack_is_shown_in_the_packs_file() {
    let folder = folder("wrong-pack");
    let text = TABLETOP.replace("language = \"en\"", "language = \"de\"");
    std::fs::write(folder.join("words.toml"), text).unwrap();
    let unit = |line: &str| format!("{GERMAN}[[unit]]\n{line}\nwords = [\"cm\"]\n");
    for (pack, what) in [
        (
            GERMAN.replace("not = [\"nicht\"]", ""),
            ["de.toml", "no words for `not`", "not = "],
        ),
        (
            GERMAN.replace("question", "questions"),
            ["de.toml:5:", "unknown variant", "did you mean \"question\""],
        ),
        (
            unit("category = \"distance\"\nfactor = 0"),
            ["de.toml:8:", "a unit of 0", "0.01 for a centimetre"],
        ),
        (
            unit("category = \"distanz\"\nfactor = 0.01"),
            [
                "de.toml:7:",
                "no category \"distanz\"",
                "did you mean \"distance\"",
            ],
        ),
    ] {
        std::fs::write(folder.join("de.toml"), pack).unwrap();
        let error = refused(
            &folder,
            &[&PICK[..], &["--vocabulary", "words.toml"]].concat(),
        );
        has(&error, &what);
        assert!(!error.contains("words.toml"), "{error}");
    }
}

#[test]
fn names_that_nobody_could_say_and_motions_that_no_robot_has_are_refused() {
    let folder = folder("names");
    let of = |from: &str, to: &str| TABLETOP.replacen(from, to, 1);
    for (vocabulary, what) in [
        (
            of("\"take\"", "\"take\", \"not\""),
            ["\"not\" cannot be a name", "forbids"],
        ),
        (
            of("\"take\"", "\"take\", \"Please\""),
            ["\"please\" cannot be a name", "is polite"],
        ),
        (
            of("\"take\"", "\"take\", \"5\""),
            ["\"5\" cannot be a name", "is a number"],
        ),
        (
            of("\"take\"", "\"take\", \"seven\""),
            ["\"seven\" cannot be a name", "is a number"],
        ),
        (
            of("\"take\"", "\"take\", \"Cube\""),
            [
                "stands for the action \"pick\" and for \"cube\"",
                "take it out",
            ],
        ),
        (
            of("name = \"pick\"\n", "name = \"pick\"\nmotion = \"pikc\"\n"),
            ["no motion \"pikc\"", "did you mean \"pick\""],
        ),
    ] {
        std::fs::write(folder.join("words.toml"), vocabulary).unwrap();
        let arguments = [&PICK[..], &["--vocabulary", "words.toml"]].concat();
        let error = refused(&folder, &arguments);
        has(&error, &[&what[..], &["words.toml:"]].concat());
    }
}

#[test]
fn what_is_no_likelihood_and_no_place_is_told_so() {
    let folder = folder("likelihood");
    let thing =
        "[[object]]\nname = \"can\"\nposition = [0.4, 0, 0.1]\nfeatures = { glued = \"no\" }\n";
    std::fs::write(folder.join("desk.toml"), thing).unwrap();
    let error = refused(&folder, &[&PICK[..], &["--scene", "desk.toml"]].concat());
    has(
        &error,
        &["desk.toml:4:", "a number from 0 to 1, or true or false"],
    );
    let set = ["scene", "set", "--port", "9", "--object", "can"];
    for (option, wrong, what) in [
        ("--at", "nan,0,0", "three finite numbers, in metres"),
        ("--at", "0.4,inf,0", "three finite numbers, in metres"),
        ("--feature", "glued=nan", "a likelihood from 0 to 1"),
        ("--feature", "glued=1.5", "a likelihood from 0 to 1"),
    ] {
        has(
            &refused(&folder, &[&set[..], &[option, wrong]].concat()),
            &[wrong, what],
        );
    }
}

#[test]
fn a_thing_that_is_there_twice_is_named() {
    let folder = folder("twice");
    let (_, things) = TABLE
        .split_once("vocabulary = \"../tabletop.toml\"\n")
        .unwrap();
    let twice = format!("{things}\n[[object]]\nname = \"can\"\nposition = [0, 0, 0]\n");
    std::fs::write(folder.join("desk.toml"), twice).unwrap();
    let error = refused(&folder, &[&PICK[..], &["--scene", "desk.toml"]].concat());
    has(&error, &["the can is on the table twice", "desk.toml:"]);
}

#[test]
fn what_is_no_recording_and_no_gesture_is_said_to_be_none() {
    let folder = folder("hands");
    std::fs::write(folder.join("text.hand"), "hello\0there\0").unwrap();
    std::fs::write(folder.join("empty.hand"), "").unwrap();
    for file in ["text.hand", "empty.hand"] {
        let recording = format!("zigzag={file}");
        let error = refused(
            &folder,
            &["gestures", "learn", &recording, "--out", "x.gestures"],
        );
        has(
            &error,
            &[
                &format!("{file} is no recording of a hand"),
                "--record FILE",
            ],
        );
    }
    let error = refused(
        &folder,
        &[
            "gestures",
            "learn",
            "zigzag=none.hand",
            "--out",
            "x.gestures",
        ],
    );
    assert_eq!(error.matches("No such file").count(), 1, "{error}");
    let error = refused(&folder, &["gestures", "aim", "cup", "--out", "x.aim"]);
    has(&error, &["--hand <SENSOR>", "--board <ADDRESS>"]);
    let error = refused(&folder, &["hand", "--hand", "made-up:1:"]);
    has(&error, &["made-up:1:thumbsup cup drawer"]);
}

#[test]
fn a_taught_gesture_has_a_name_of_its_own() {
    let folder = folder("taught");
    let known = deictic::hand::taught::Taught::default();
    for names in [vec![""], vec!["zigzag", "zigzag"], vec!["wave"]] {
        let gestures = names.iter().map(|n| (*n).to_owned()).collect();
        let taught = deictic::hand::taught::Taught {
            gestures,
            ..known.clone()
        };
        std::fs::write(folder.join("x.gestures"), toml::to_string(&taught).unwrap()).unwrap();
        let error = refused(
            &folder,
            &[
                "hand",
                "--hand",
                "made-up:1:cup",
                "--gestures",
                "x.gestures",
            ],
        );
        has(&error, &["has no name of its own", "x.gestures"]);
    }
}
