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
