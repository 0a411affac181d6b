//! The table changes while a session runs: by a watched file, by lines of JSON, by other programs. The
//! unit is told, and nothing that was decided on the table before is done.

mod common;

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, Command, Stdio};

use common::*;
use deictic::scene::feed::ask;
use deictic::scene::watch::Watch;
use deictic::scene::{SceneLine, SceneProblem, Tabletop};
use deictic::session::Happening;
use deictic::showing::showing;
use deictic::unit::Distrust;
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::decide::Outcome;
use serde_json::Value;

fn after(line: &str, table: &Tabletop, lexicon: &Lexicon) -> Result<Tabletop, SceneProblem> {
    let mut table = table.clone();
    if let Some(things) = SceneLine::parse(line.as_bytes())?.things(&table, lexicon)? {
        table
            .replace(things, lexicon)
            .map_err(SceneProblem::Refused)?;
    }
    Ok(table)
}

#[test]
fn lines_change_add_remove_and_replace_things() {
    let lexicon = lexicon();
    let table = table(&lexicon);
    let can = lexicon.option(Category::OBJECT, "can").unwrap();
    let full = lexicon.feature("full-liquid").unwrap();
    let pickable = lexicon.feature("pickable").unwrap();
    let line = r#"{"change": {"object": "can", "features": {"full-liquid": 0.25}}}"#;
    let changed = after(line, &table, &lexicon).unwrap();
    let thing = changed.find(Category::OBJECT, can).unwrap();
    assert_eq!(
        (thing.features[full], thing.features[pickable]),
        (0.25, 1.0)
    );
    assert_eq!(thing.position, [0.45, 0.10, 0.06]);
    assert!(changed.version() > table.version());

    let removed = after(r#"{"remove": {"object": "can"}}"#, &changed, &lexicon).unwrap();
    assert_eq!(removed.find(Category::OBJECT, can), None);
    let line = r#"{"change": {"object": "can", "position": [0.5, 0, 0.06]}}"#;
    let back = after(line, &removed, &lexicon).unwrap();
    assert_eq!(
        back.find(Category::OBJECT, can).unwrap().position,
        [0.5, 0.0, 0.06]
    );

    let line = r#"{"things": [{"storage": "bowl", "position": [0.5, 0, 0.06], "features": {"container": true}}]}"#;
    assert_eq!(
        after(line, &back, &lexicon)
            .unwrap()
            .scene()
            .entities()
            .len(),
        1
    );
    assert_eq!(after("\"show\"", &back, &lexicon).unwrap(), back);
}

#[test]
fn a_line_that_is_wrong_is_refused_wholly() {
    let lexicon = lexicon();
    let table = table(&lexicon);
    for line in [
        "",
        "{}",
        "{\"change\": 7}",
        r#"{"change": {"object": "can", "storage": "bowl"}}"#,
        r#"{"change": {"position": [0, 0, 0]}}"#,
        r#"{"change": {"object": "dragon", "position": [0, 0, 0]}}"#,
        r#"{"change": {"object": "can", "features": {"heavy": 1}}}"#,
        r#"{"change": {"object": "can", "features": {"glued": 1.5}}}"#,
        r#"{"change": {"object": "can", "colour": "red"}}"#,
        r#"{"change": {"object": "can", "position": [0, 1e99, 0]}}"#,
        r#"{"things": [{"object": "can", "position": [0,0,0]}, {"object": "can", "position": [1,0,0]}]}"#,
        r#"{"things": [{"object": "can"}]}"#,
        r#"{"remove": {"object": "dragon"}}"#,
    ] {
        use deictic::diagnose::Problem;
        let problem = after(line, &table, &lexicon).unwrap_err();
        assert!(!problem.remedy().is_empty(), "{line}: {problem}");
    }
}

#[test]
fn the_next_decision_is_made_on_the_changed_table() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    let line = br#"{"change": {"object": "box", "features": {"glued": false}}}"#;
    let line = SceneLine::parse(line).unwrap();
    let things = line.things(session.table(), &lexicon).unwrap().unwrap();
    session.lay(things).unwrap();
    let version = session.table().version();
    session.observe(surely_said("pick box", &lexicon)).unwrap();
    let happened = settle(&mut session);
    let decided = happened.iter().find_map(|h| match h {
        Happening::Decided {
            scene, decision, ..
        } => Some((*scene, decision.outcome.clone())),
        _ => None,
    });
    let (scene, outcome) = decided.unwrap();
    assert_eq!(scene, version);
    assert!(matches!(outcome, Outcome::Execute(_)), "{outcome:?}");
    assert!(happened.iter().any(is_done));
}

#[test]
fn what_was_decided_on_an_older_table_is_not_done() {
    let (cable, lexicon) = (Cable::new(), lexicon());
    let mut session = open(&cable, &lexicon, 1000.0);
    session
        .observe(showing("pick can", &lexicon).unwrap())
        .unwrap();
    // Nothing that the unit is told of the new table gets through until it has decided.
    cable.with(|line| {
        line.swallow = Some(|said| matches!(said, deictic_core::large::ToUnit::Scene(_)));
    });
    let line = SceneLine::parse(br#"{"remove": {"object": "can"}}"#).unwrap();
    let things = line.things(session.table(), &lexicon).unwrap().unwrap();
    session.lay(things).unwrap();
    let happened = until(&mut session, |h| {
        matches!(h, Happening::Distrusted(_) | Happening::Lost(_))
    });
    assert!(
        happened
            .iter()
            .any(|h| matches!(h, Happening::Distrusted(Distrust::StaleScene { .. }))),
        "{happened:#?}"
    );
    assert!(!moved(&happened));
}

#[test]
fn a_watched_file_is_read_when_it_has_changed() {
    let clock = deictic::clock::Simulated::start();
    let lexicon = lexicon();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let scene = |x: f32| format!("[[object]]\nname = \"can\"\nposition = [{x}, 0.0, 0.06]\n");
    std::fs::write(&path, scene(0.4)).unwrap();
    let mut watch = Watch::new(&path);
    let mut look = || {
        clock.advance(std::time::Duration::from_millis(250));
        watch.look(&lexicon)
    };
    assert!(look().unwrap().is_none());
    std::fs::write(&path, scene(0.45123)).unwrap();
    assert!(look().unwrap().is_none(), "it may still be being written");
    let things = look().unwrap().unwrap();
    assert_eq!(things[0].position[0], 0.45123);
    assert!(look().unwrap().is_none());
    std::fs::write(
        &path,
        "[[object]]\nname = \"dragon\"\nposition = [0, 0, 0]\n",
    )
    .unwrap();
    assert!(look().unwrap().is_none());
    let problem = look().unwrap_err();
    assert!(matches!(
        problem.problem(),
        SceneProblem::UnknownThing { .. }
    ));
    assert!(look().unwrap().is_none(), "it is told once");
    std::fs::remove_file(&path).unwrap();
    assert!(look().unwrap().is_none() && look().unwrap().is_none());
    std::fs::write(&path, scene(0.5)).unwrap();
    assert!(look().unwrap().is_none());
    assert_eq!(look().unwrap().unwrap()[0].position[0], 0.5);
}

/// A session in a program of its own.
struct Running(Child, BufReader<std::process::ChildStdout>);

impl Running {
    fn start(arguments: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_deictic"))
            .args([
                "run", "--board", "inside", "--haste", "1000", "--window", "50", "--json",
            ])
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let output = BufReader::new(child.stdout.take().unwrap());
        Self(child, output)
    }

    fn event(&mut self, event: &str) -> Value {
        loop {
            let mut line = String::new();
            assert!(self.1.read_line(&mut line).unwrap() > 0, "no {event}");
            let value: Value = serde_json::from_str(&line).unwrap();
            if value["event"] == event {
                return value;
            }
        }
    }

    fn say(&mut self, line: &str) {
        let input = self.0.stdin.as_mut().unwrap();
        writeln!(input, "{line}").unwrap();
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        drop(self.0.stdin.take());
        let _ = self.0.wait();
    }
}

fn scene(port: u64, arguments: &[&str]) -> (bool, String, String) {
    let (what, rest) = arguments.split_first().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_deictic"))
        .args(["scene", what, "--port", &port.to_string()])
        .args(rest)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        output.status.success(),
        text(output.stdout),
        text(output.stderr),
    )
}

#[test]
fn other_programs_change_the_table_of_a_session() {
    let mut session = Running::start(&["--scene-port", "0"]);
    let port = session.event("listening")["port"].as_u64().unwrap();
    let (well, shown, _) = scene(port, &["show"]);
    assert!(well && shown.lines().count() == 9, "{shown}");
    let unglued = ["set", "--object", "box", "--feature", "glued=false"];
    assert!(scene(port, &unglued).0);
    session.event("table");
    session.say("pick the box");
    session.event("done");
    let (well, _, error) = scene(port, &["set", "--object", "box", "--feature", "heavy=1"]);
    assert!(!well && error.contains("heavy"), "{error}");
    let (well, shown, _) = scene(port, &["set", "--remove", "--object", "cup"]);
    assert!(well && !shown.contains("cup"), "{shown}");
    // A line too long for anything is refused, and the next one is taken.
    let long = format!("{{\"change\": \"{}\"}}", "x".repeat(20_000));
    let answer = ask(u16::try_from(port).unwrap(), &long).unwrap();
    assert!(answer.contains("error"), "{answer}");
    assert!(scene(port, &["show"]).0);
}

#[test]
fn lines_typed_among_the_commands_change_the_table() {
    let mut session = Running::start(&[]);
    session.event("ready");
    session.say(r#"{"change": {"object": "box", "features": {"glued": false}}}"#);
    session.event("table");
    session.say("pick the box");
    session.event("done");
    session.say(r#"{"change": {"object": "dragon"}}"#);
    session.event("not-understood");
}
