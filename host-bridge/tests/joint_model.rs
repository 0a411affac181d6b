//! The joint model over what is typed: sure where words and hand agree, a question where they do
//! not, and the same here and on a unit.

use std::process::Command;

fn deictic(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_deictic"))
        .args(arguments)
        .output()
        .unwrap();
    String::from_utf8(output.stdout).unwrap()
}

fn told(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_deictic"))
        .args(arguments)
        .output()
        .unwrap();
    assert!(!output.status.success(), "{arguments:?} was taken");
    let text = String::from_utf8(output.stderr).unwrap();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn decided(say: &str, show: &str) -> String {
    let mut arguments = vec!["decide", "--model", "joint", "--say", say];
    if !show.is_empty() {
        arguments.extend(["--show", show]);
    }
    deictic(&arguments).trim().to_owned()
}

#[test]
fn what_is_typed_is_taken_for_what_it_says() {
    for (say, show, expected) in [
        (
            "put the can into the drawer",
            "",
            "execute  put-into can drawer",
        ),
        ("pick up the cup", "", "execute  pick cup"),
        ("pick the kup", "", "execute  pick cup"),
        ("put it there", "can drawer", "execute  put-into can drawer"),
        (
            "put the can there",
            "can=0.5|cup=0.5 drawer",
            "execute  put-into can drawer",
        ),
        ("stop", "pick can", "execute  stop"),
    ] {
        assert_eq!(decided(say, show), expected, "{say} // {show}");
    }
}

#[test]
fn a_contradiction_is_asked_about() {
    for shown in ["pick cup", "push can"] {
        let asked = decided("pick the can", shown);
        assert_eq!(asked, "ask      Do you mean: pick can?", "{shown}");
    }
}

#[test]
fn what_cannot_be_is_said_of_the_thing_that_was_named() {
    let asked = decided("push the box", "");
    assert!(
        asked.starts_with("ask      The box does not do for push: it is glued."),
        "{asked}"
    );
}

#[test]
fn a_unit_decides_likewise() {
    for (say, show, expected) in [
        ("pick up the cup", "pick cup", "pick"),
        ("put the can there", "can=0.5|cup=0.5 drawer", "put-into"),
    ] {
        let printed = deictic(&[
            "run", "--board", "inside", "--model", "joint", "--haste", "50", "--json", "--say",
            say, "--show", show,
        ]);
        let mut events = printed
            .lines()
            .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
        let decided = events.find(|event| event["event"] == "decided").unwrap();
        let decision = &decided["decision"];
        assert_eq!(decision["outcome"], "execute", "{printed}");
        assert_eq!(decision["intent"]["action"], expected, "{printed}");
    }
}

const SURE: [&str; 4] = ["--say", "pick up the cup", "--show", "pick cup"];
const TORN: [&str; 4] = ["--say", "pick it up", "--show", "can|cup"];

/// The figures of the line on the whole intent: posterior, confidence, cut.
fn whole(printed: &str) -> [f32; 3] {
    let line = printed
        .lines()
        .find(|l| l.contains("whole intent"))
        .expect(printed);
    let figures = line.split([' ', ',']).filter_map(|word| word.parse().ok());
    figures.collect::<Vec<_>>().try_into().expect(line)
}

#[test]
fn it_says_how_sure_it_is_and_how_sure_it_has_to_be() {
    for (what, executes) in [(SURE, true), (TORN, false)] {
        let printed = deictic(&[&["decide", "--model", "joint", "--explain"], &what[..]].concat());
        assert_eq!(printed.starts_with("execute"), executes, "{printed}");
        let [posterior, confidence, cut] = whole(&printed);
        assert_eq!(confidence >= cut, executes, "{printed}");
        assert_eq!(posterior > 0.9, executes, "{printed}");
        assert!(
            !printed.contains("entropy") && !printed.contains("heard"),
            "{printed}"
        );
    }
    let one = deictic(&[&["decide", "--model", "joint", "--explain"], &TORN[..]].concat());
    let share = |thing: &str| {
        let line = one
            .lines()
            .find(|l| l.trim_start().starts_with(thing))
            .expect(&one);
        line.split_whitespace()
            .nth(1)
            .and_then(|p| p.parse::<f32>().ok())
            .expect(line)
    };
    assert!((share("can") + share("cup") - 1.0).abs() < 0.01, "{one}");
}

#[test]
fn a_unit_says_the_same_of_itself() {
    let here = deictic(&[&["decide", "--model", "joint", "--explain"], &TORN[..]].concat());
    let there = deictic(
        &[
            &["run", "--board", "inside", "--model", "joint", "--explain"],
            &TORN[..],
        ]
        .concat(),
    );
    assert_eq!(whole(&there), whole(&here), "{there}");
}

#[test]
fn a_smaller_risk_has_a_higher_cut() {
    let cut = |risk| {
        let more = ["decide", "--model", "joint", "--explain", "--risk", risk];
        whole(&deictic(&[&more, &SURE[..]].concat()))[2]
    };
    assert!(cut("0.003") > cut("0.01") && cut("0.01") > cut("0.1"));
}

#[test]
fn a_risk_that_cannot_be_is_refused_with_its_range() {
    for risk in ["2", "1", "0.001", "0", "-1", "NaN"] {
        let risk = format!("--risk={risk}");
        let error = told(&[&["decide", "--model", "joint", &risk], &SURE[..]].concat());
        assert!(error.contains("from 0.003 to below 1"), "{error}");
        assert!(error.contains("0.01 is 1 %"), "{error}");
    }
}

#[test]
fn what_the_model_does_not_go_by_is_refused() {
    for (command, option, value) in [
        ("decide", "--risk", "0.01"),
        ("decide", "--questions", "1"),
        ("run", "--risk", "0.01"),
    ] {
        let board: &[&str] = if command == "run" {
            &["--board", "inside"]
        } else {
            &[]
        };
        let error = told(&[&[command, option, value], board, &SURE[..]].concat());
        assert!(
            error.contains(option) && error.contains("--model joint"),
            "{error}"
        );
    }
}
