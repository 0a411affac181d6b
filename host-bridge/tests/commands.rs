//! The program as a user calls it: what it prints for people and programs, and how it ends.

use std::io::Write;
use std::process::{Command, Output, Stdio};

use serde_json::Value;

fn deictic(arguments: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_deictic"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The program may end before it has read everything.
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn objects(output: &Output) -> Vec<Value> {
    let lines = text(&output.stdout);
    lines
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

fn events<'a>(objects: &'a [Value], event: &str) -> Vec<&'a Value> {
    objects.iter().filter(|o| o["event"] == event).collect()
}

#[test]
fn decide_says_what_and_why() {
    let output = deictic(
        &["decide", "--say", "pick the cup", "--show", "pick cup"],
        b"",
    );
    assert_eq!(text(&output.stdout), "execute  pick cup\n");
    let output = deictic(&["decide", "--say", "pick it up", "--show", "can|cup"], b"");
    assert_eq!(
        text(&output.stdout),
        "ask      Which object for pick: can or cup?\n"
    );
    let output = deictic(
        &[
            "decide",
            "--say",
            "don't pick the cup",
            "--show",
            "pick cup",
        ],
        b"",
    );
    assert!(text(&output.stdout).starts_with("nothing"));
    let output = deictic(&["decide", "--say", "stop", "--show", "pick cup"], b"");
    assert_eq!(text(&output.stdout), "execute  stop\n");
    let output = deictic(
        &[
            "decide",
            "--say",
            "pick the cup",
            "--show",
            "pick cup",
            "--explain",
            "--json",
        ],
        b"",
    );
    let [object] = &objects(&output)[..] else {
        panic!()
    };
    assert_eq!(object["outcome"], "execute");
    assert_eq!(object["intent"]["parameters"][0]["option"], "cup");
    assert_eq!(object["why"]["words"][0]["category"], "action");
    assert_eq!(object["why"]["actions"][3]["alpha"], 1.0);
}

#[test]
fn the_same_seed_decides_the_same_and_profiles_differ() {
    let with = |extra: &[&str]| {
        let noisy = [
            "decide",
            "--say",
            "push the cube",
            "--show",
            "push cube",
            "--noise",
            "n3",
        ];
        text(&deictic(&[&noisy, extra].concat(), b"").stdout)
    };
    assert_eq!(
        with(&["--seed", "5", "--explain"]),
        with(&["--seed", "5", "--explain"])
    );
    assert_ne!(
        with(&["--seed", "5", "--explain"]),
        with(&["--seed", "6", "--explain"])
    );
    let profiles = [
        vec!["--model", "m1"],
        vec!["--model", "baseline"],
        vec!["--merge", "mul"],
        vec!["--threshold", "fixed"],
        vec!["--profile", "reference"],
    ];
    let paper = with(&["--seed", "5", "--explain"]);
    for profile in profiles {
        let other = with(&[&["--seed", "5", "--explain"], &profile[..]].concat());
        assert_ne!(paper, other, "{profile:?}");
    }
}

#[test]
fn what_is_wrong_is_said_with_a_remedy() {
    let cases: [(&[&str], &str); 6] = [
        (
            &["decide", "--say", "pick the wibblewobble"],
            "wibblewobble",
        ),
        (&["decide", "--show", "picc cup"], "did you mean \"pick\""),
        (
            &["decide", "--show", "pick", "--scene", "none.toml"],
            "none.toml",
        ),
        (
            &["decide", "--show", "pick", "--vocabulary", "none.toml"],
            "none.toml",
        ),
        (&["run", "--board", "usb:1"], "tcp:127.0.0.1:7700"),
        (&["run", "--board", "tcp:127.0.0.1:1"], "cargo xtask qemu"),
    ];
    for (arguments, expected) in cases {
        let output = deictic(arguments, b"");
        assert!(!output.status.success(), "{arguments:?}");
        // The report is broken into lines wherever the terminal ends.
        let said = text(&output.stderr).replace(['\n', '│'], " ");
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(expected), "{arguments:?}: {said}");
    }
}

#[test]
fn run_does_one_command_and_tells_how_it_ended() {
    let run = [
        "run", "--board", "inside", "--haste", "500", "--json", "--window", "50",
    ];
    let say = |text: &str| deictic(&[&run[..], &["--say", text]].concat(), b"");
    let output = say("pick the can");
    assert_eq!(output.status.code(), Some(0));
    let happened = objects(&output);
    assert_eq!(events(&happened, "step").len(), 5);
    assert_eq!(events(&happened, "done").len(), 1);
    let output = say("pick the box");
    assert_eq!(
        output.status.code(),
        Some(2),
        "a question that nobody answers"
    );
    assert_eq!(events(&objects(&output), "step").len(), 0);
    let output = say("don't pick the can");
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(events(&objects(&output), "decided").len(), 0);
}

#[test]
fn run_takes_lines_and_answers_and_survives_anything() {
    let input: Vec<u8> = [
        &b"pick the box\n"[..],
        b"the can\n",
        b"\xff\xfe\n",
        b"\n",
        b"put it down in the drawer // put-into can drawer\n",
        &vec![b'x'; 100_000],
        b"\n\x1b[2J\x07\n",
        b"pick the cup // pick cup\n",
    ]
    .concat();
    let run = [
        "run", "--board", "inside", "--haste", "500", "--json", "--window", "50",
    ];
    let output = deictic(&run, &input);
    let happened = objects(&output);
    assert_eq!(
        events(&happened, "asked").len(),
        1,
        "{}",
        text(&output.stdout)
    );
    assert_eq!(
        events(&happened, "done").len(),
        3,
        "{}",
        text(&output.stdout)
    );
    assert!(events(&happened, "not-understood").len() >= 2);
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn the_demo_plays_as_it_is_told() {
    let output = deictic(
        &["play", "--board", "inside", "--haste", "8", "--json"],
        b"",
    );
    assert!(output.status.success(), "{}", text(&output.stderr));
    let happened = objects(&output);
    let summary = events(&happened, "summary");
    let rows = summary[0]["rows"].as_array().unwrap();
    let short = |row: &Value| {
        let decided = row["decided"].as_array().unwrap().iter();
        let decided: Vec<_> = decided.map(|d| d.as_str().unwrap()).collect();
        format!(
            "{}: {}: {}",
            row["kind"].as_str().unwrap(),
            decided.join(", "),
            row["robot"].as_str().unwrap()
        )
    };
    let mut played: Vec<_> = rows.iter().map(short).collect();
    // In which motion the stop finds the arm is a matter of milliseconds.
    for row in &mut played {
        if let Some((stopped, _)) = row.split_once(": stopped: ") {
            *row = format!("{stopped}: stopped");
        }
    }
    assert_eq!(
        played,
        [
            "hand: push cup: done",
            "aligned: pour can bowl: done",
            "aligned: put-into can drawer: done",
            "contradicting: stack cube foam: done",
            "contradicting: unglue box: done",
            "aligned: pick box: done",
            "infeasible: asks which storage: stands still",
            "aligned: release: done",
            "ambiguous: asks which object, pick cup: done",
            "incomplete: asks which storage, stack cup crackers: done",
            "noisy (n1): push box left: done",
            "noisy (n3): move-up 10 cm: done",
            "unsure (n4): asks yes or no, push box: done",
            "hopeless: asks to repeat: stands still",
            "infeasible: asks which object: stands still",
            "forbidden: : stands still",
            "stop: pick can, stop: stopped",
            "refused: release: refuses: the hand holds nothing",
            "infeasible: asks which storage: stands still",
            "aligned: move-up 5 cm: done",
        ]
    );
}

#[test]
fn the_chosen_action_is_among_the_reasons() {
    let printed = text(&deictic(&["play", "--haste", "200"], b"").stdout);
    let turns = printed
        .split("\n\n")
        .filter(|turn| turn.contains("\ndecided  ") && !turn.contains("stopped at"));
    let mut seen = 0;
    for turn in turns {
        for line in turn.lines().filter(|line| line.starts_with("because")) {
            let (_, told) = line.split_once(": ").expect(line);
            assert!(!told.trim().is_empty(), "{turn}");
        }
        let decided = turn
            .lines()
            .rev()
            .find_map(|l| l.strip_prefix("decided  "))
            .unwrap();
        let actions = turn
            .lines()
            .rev()
            .find_map(|l| l.strip_prefix("because  action: "));
        let Some(actions) = actions.filter(|_| turn.contains("robot ")) else {
            continue;
        };
        let action = decided.split(' ').next().unwrap();
        assert!(actions.contains(action), "{turn}");
        seen += 1;
    }
    assert!(seen > 8, "{seen} turns: {printed}");
}
