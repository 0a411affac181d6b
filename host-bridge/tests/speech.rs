//! Sessions that listen: recordings spoken by espeak-ng, and lines of another recogniser.

#[path = "common/voice.rs"]
mod voice;

use std::path::Path;
use std::process::Command;

use deictic::language::pack::Pack;
use deictic::session::Order;
use tempfile::TempDir;
use voice::{installed, sox, speak};

#[test]
fn every_word_for_the_robot_itself_is_one() {
    let pack = Pack::built_in("en").unwrap();
    let orders = pack.speech.unwrap().order;
    assert!(
        !orders.is_empty() && orders.iter().all(|o| Order::of(o).is_some()),
        "{orders:?}"
    );
}

#[test]
fn what_is_told_the_robot_itself_is_done_when_it_was_heard_clearly() {
    let home = |share: f64| {
        let rest = 1.0 - share;
        let line = format!(
            r#"{{"alternatives": [{{"text": "go home", "confidence": {share}}}, {{"text": "pick the can", "confidence": {rest}}}]}}"#
        );
        run(&["--speech", &format!("lines:echo '{line}'")])
    };
    assert_eq!(count(&home(0.999), "homing"), 1);
    for doubtful in [0.9, 0.5, 0.1] {
        let events = home(doubtful);
        assert_eq!(
            count(&events, "homing") + count(&events, "step"),
            0,
            "{events}"
        );
        assert_eq!(count(&events, "not-understood"), 1, "{events}");
    }
    // Holding when nothing goes on moves nothing.
    let events = run(&["--speech", "lines:echo hold; echo resume"]);
    assert_eq!(count(&events, "declined"), 2, "{events}");
    assert_eq!(count(&events, "step"), 0, "{events}");
}

#[test]
fn a_session_does_what_a_recording_says() {
    if !installed() {
        return;
    }
    let folder = TempDir::new().unwrap();
    let (first, then) = (
        speak(&folder, "1.wav", "pick the cube"),
        speak(&folder, "2.wav", "release"),
    );
    let both = folder.path().join("both.wav");
    let pause = folder.path().join("pause.wav");
    let text = |path: &Path| path.to_str().unwrap().to_owned();
    sox(&[
        "-n",
        "-r",
        "22050",
        "-c",
        "1",
        "-b",
        "16",
        &text(&pause),
        "trim",
        "0",
        "1.5",
    ]);
    sox(&[
        &text(&pause),
        &text(&first),
        &text(&pause),
        &text(&then),
        &text(&both),
    ]);
    let events = run(&["--speech", &text(&both)]);
    assert_eq!(count(&events, "done"), 2, "{events}");
}

fn run(arguments: &[&str]) -> String {
    let mut deictic = Command::new(env!("CARGO_BIN_EXE_deictic"));
    deictic
        .args(["run", "--board", "inside", "--haste", "50", "--json"])
        .args(arguments);
    let output = deictic.stdin(std::process::Stdio::null()).output().unwrap();
    String::from_utf8(output.stdout).unwrap()
}

fn count(events: &str, event: &str) -> usize {
    let wanted = format!("\"event\":\"{event}\"");
    events.lines().filter(|line| line.contains(&wanted)).count()
}

#[test]
fn another_recogniser_is_plugged_in_by_its_lines() {
    let script = r#"printf '%s\n' 'pick the can' '{"alternatives": [{"text": "release", "confidence": 0.9}]}'"#;
    let events = run(&["--speech", &format!("lines:{script}")]);
    assert_eq!(count(&events, "done"), 2, "{events}");
}

#[test]
fn lines_that_are_no_text_are_answered() {
    let script = r"printf 'a\377b\n\n\001\002\n'; head -c 100000 /dev/zero | tr '\0' a; echo; echo 'do not pick the can'; echo 'pick the can'";
    let events = run(&["--speech", &format!("lines:{script}")]);
    assert_eq!(count(&events, "not-understood"), 4, "{events}");
    assert_eq!(count(&events, "nothing"), 1, "{events}");
    assert_eq!(count(&events, "done"), 1, "{events}");
}

#[test]
fn what_a_hand_shows_meanwhile_belongs_to_what_is_said() {
    let mut deictic = Command::new(env!("CARGO_BIN_EXE_deictic"));
    deictic.args(["run", "--board", "inside", "--haste", "50", "--json"]);
    // The hand is typed at once, the words come a while after it.
    deictic.args(["--speech", "lines:sleep 1; echo pick this"]);
    deictic
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped());
    let mut child = deictic.spawn().unwrap();
    let mut hand = child.stdin.take().unwrap();
    std::io::Write::write_all(&mut hand, b"// cube\n").unwrap();
    let output = child.wait_with_output().unwrap();
    drop(hand);
    let events = String::from_utf8(output.stdout).unwrap();
    assert_eq!(count(&events, "done"), 1, "{events}");
    assert!(events.contains("cube"), "{events}");
}

#[test]
fn a_source_that_is_not_there_is_named() {
    let mut deictic = Command::new(env!("CARGO_BIN_EXE_deictic"));
    deictic.args(["run", "--board", "inside", "--speech", "no such file.wav"]);
    let output = deictic.output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        !output.status.success() && said.contains("no such file.wav"),
        "{said}"
    );
}
