//! What has a moving arm stand still at once, and what is pending not begin, in whatever words.

use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// A session into which lines are typed one by one.
struct Typing {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl Typing {
    fn begin(more: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_deictic"))
            .args(["run", "--board", "inside", "--json"])
            .args(more)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let input = child.stdin.take().unwrap();
        let output = BufReader::new(child.stdout.take().unwrap());
        Self {
            child,
            input,
            output,
        }
    }

    fn say(&mut self, line: &str) {
        self.input.write_all(line.as_bytes()).unwrap();
        self.input.write_all(b"\n").unwrap();
    }

    /// What is printed up to an event.
    fn until(&mut self, event: &str) -> String {
        let wanted = format!("\"event\":\"{event}\"");
        let mut printed = String::new();
        while !printed.contains(&wanted) {
            let read = self.output.read_line(&mut printed).unwrap();
            assert!(read > 0, "no {event}: {printed}");
        }
        printed
    }

    /// What is printed to the end.
    fn end(mut self) -> String {
        drop(self.input);
        let rest: Vec<_> = self.output.lines().map_while(Result::ok).collect();
        self.child.wait().unwrap();
        rest.join("\n")
    }
}

/// What is printed after `said`, which is typed while the arm moves.
fn while_it_moves(said: &str, more: &[&str]) -> String {
    let mut typing = Typing::begin(&[&["--haste", "2", "--window", "50"], more].concat());
    typing.say("pick the can");
    typing.until("step");
    typing.say(said);
    typing.end()
}

fn stops(printed: &str) -> bool {
    printed.contains("\"event\":\"stopped\"")
}

fn data(name: &[&str]) -> String {
    let path: PathBuf = [&[env!("CARGO_MANIFEST_DIR"), "data"], name]
        .concat()
        .iter()
        .collect();
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_misspelt_stop_stops_as_stop_does() {
    for said in [
        "stop", "stpo", "stoppp", "stopp", "sotp", "stap", "stooop", "haltt", "freez",
    ] {
        let printed = while_it_moves(said, &[]);
        assert!(stops(&printed), "{said}: {printed}");
    }
}

#[test]
fn words_that_no_vocabulary_has_stop_as_well() {
    for said in [
        "cancel",
        "abort",
        "enough",
        "whoa",
        "watch out",
        "nooo",
        "that's wrong",
        "slow down",
        "abrot",
    ] {
        let printed = while_it_moves(said, &[]);
        assert!(stops(&printed), "{said}: {printed}");
    }
    for said in ["thanks", "xyzzy", "push the box"] {
        let printed = while_it_moves(said, &[]);
        assert!(!stops(&printed), "{said}: {printed}");
    }
}

#[test]
fn a_vocabulary_of_its_own_cannot_take_the_languages_words_for_stopping_away() {
    let own = std::env::temp_dir().join(format!("deictic-halts-{}.toml", std::process::id()));
    let text = include_str!("../data/tabletop.toml");
    let renamed = text
        .replace("stop = \"stop\"", "stop = \"abort\"")
        .replace("name = \"stop\"", "name = \"abort\"\nmotion = \"stop\"")
        .replace("[\"halt\", \"freeze\", \"wait\"]", "[\"cease\"]");
    assert!(renamed.contains("[\"cease\"]"), "{renamed}");
    std::fs::write(&own, renamed).unwrap();
    let own = own.to_str().unwrap();
    for said in ["stop", "Stop it!", "stpo", "freeze", "desist"] {
        let printed = while_it_moves(said, &["--vocabulary", own]);
        assert!(stops(&printed), "{said}: {printed}");
    }
    std::fs::remove_file(own).unwrap();
}

#[test]
fn czech_has_its_own_words() {
    let (vocabulary, first) = (data(&["language", "tabletop-cs.toml"]), "vezmi plechovku");
    for said in ["zastavte", "zastavteee", "dost", "pozor", "stop"] {
        let mut typing = Typing::begin(&[
            "--haste",
            "2",
            "--window",
            "50",
            "--vocabulary",
            &vocabulary,
        ]);
        typing.say(first);
        typing.until("step");
        typing.say(said);
        let printed = typing.end();
        assert!(stops(&printed), "{said}: {printed}");
    }
}

#[test]
fn what_is_pending_is_not_begun_when_the_robot_is_to_hold() {
    for said in ["hold", "pause", "stop", "stpo", "whoa", "cancel"] {
        let mut typing = Typing::begin(&["--haste", "200", "--window", "500"]);
        typing.say("pick the can");
        typing.until("heard");
        typing.say(said);
        let printed = typing.end();
        assert!(!printed.contains("\"event\":\"step\""), "{said}: {printed}");
        assert!(!printed.contains("\"event\":\"declined\""), "{printed}");
        if !said.starts_with("st") {
            assert!(
                printed.contains("\"event\":\"withheld\""),
                "{said}: {printed}"
            );
        }
    }
}

#[test]
fn what_waits_behind_what_is_pending_is_not_begun_either() {
    let mut typing = Typing::begin(&["--haste", "200", "--window", "500"]);
    typing.say("pick the can");
    typing.until("heard");
    typing.say("push the box");
    typing.say("hold");
    let printed = typing.end();
    assert!(!printed.contains("\"event\":\"step\""), "{printed}");
    assert!(printed.contains("\"event\":\"dropped\""), "{printed}");
}

#[test]
fn talk_after_a_command_takes_nothing_of_it_back() {
    let mut typing = Typing::begin(&["--haste", "200", "--window", "300"]);
    typing.say("pick the can");
    typing.until("heard");
    typing.say("thanks");
    let printed = typing.end();
    assert!(printed.contains("\"event\":\"done\""), "{printed}");
}

#[test]
fn talk_keeps_what_is_shown_with_it_from_being_done() {
    for said in ["lunch break at noon", "good morning", "thanks"] {
        let mut typing = Typing::begin(&["--haste", "200", "--window", "500"]);
        typing.say("// pick cup");
        typing.until("heard");
        typing.say(said);
        let printed = typing.end();
        assert!(!printed.contains("\"event\":\"step\""), "{said}: {printed}");
    }
}

/// What is printed when this is heard, as a recogniser's line, while the arm moves.
fn heard_while_it_moves(line: &str) -> String {
    let name = format!("deictic-heard-{}-{}", std::process::id(), line.len());
    let moves = std::env::temp_dir().join(name);
    let moves = moves.to_str().unwrap();
    let speech = format!("lines:while [ ! -e {moves} ]; do sleep 0.02; done; echo '{line}'");
    let arguments = ["--haste", "2", "--window", "50", "--speech", &speech];
    let mut typing = Typing::begin(&arguments);
    typing.say("pick the can");
    typing.until("step");
    std::fs::write(moves, "").unwrap();
    let printed = typing.end();
    std::fs::remove_file(moves).unwrap();
    printed
}

#[test]
fn whatever_may_have_been_a_refusal_stops_a_moving_arm() {
    let heard = |alternatives: &[(&str, f32)]| {
        let alternatives = alternatives.iter().map(
            |(text, confidence)| serde_json::json!({ "text": text, "confidence": confidence }),
        );
        let alternatives: Vec<_> = alternatives.collect();
        serde_json::json!({ "alternatives": alternatives }).to_string()
    };
    for alternatives in [
        &[("good morning", 0.95), ("no", 0.05)][..],
        &[("good morning", 0.95), ("stop", 0.05)],
        &[("push the box", 0.95), ("don\u{2019}t push the box", 0.05)],
        &[("no doubt", 1.0)],
        &[("whoa", 1.0)],
        &[("stpo", 1.0)],
    ] {
        let printed = heard_while_it_moves(&heard(alternatives));
        assert!(stops(&printed), "{alternatives:?}: {printed}");
    }
    let printed = heard_while_it_moves(&heard(&[("good morning", 0.995), ("no", 0.005)]));
    assert!(!stops(&printed), "{printed}");
}
