//! What a person says to a question, and what is not for the unit to decide, as it is typed into a session.

use std::io::Write;
use std::process::{Command, Stdio};

use serde_json::Value;

/// What is printed of a session into which these lines are typed.
fn session(lines: &[&str], more: &[&str]) -> String {
    let mut child = Command::new(env!("CARGO_BIN_EXE_deictic"))
        .args(["run", "--board", "inside", "--haste", "200"])
        .args(more)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let text = lines.join("\n") + "\n";
    child
        .stdin
        .take()
        .unwrap()
        .write_all(text.as_bytes())
        .unwrap();
    String::from_utf8(child.wait_with_output().unwrap().stdout).unwrap()
}

fn decide(more: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_deictic"))
        .arg("decide")
        .args(more)
        .output()
        .unwrap();
    let (out, err) = (output.stdout, output.stderr);
    let text = String::from_utf8(out).unwrap() + &String::from_utf8(err).unwrap();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

const TORN: &str = "pick it // cup|cube";
const WHICH: &str = "Which object for pick: cup or cube?";

#[test]
fn what_does_not_say_which_is_asked_again_and_then_answered() {
    for unclear in [
        "I don't know",
        "both",
        "maybe",
        "yes",
        "yep",
        "hmm",
        "blorptang",
    ] {
        let printed = session(&[TORN, unclear, "the cup"], &[]);
        assert_eq!(printed.matches(WHICH).count(), 2, "{unclear}: {printed}");
        assert!(!printed.contains("forbidden"), "{printed}");
        assert!(
            printed.contains("decided  pick cup"),
            "{unclear}: {printed}"
        );
    }
}

#[test]
fn no_in_any_words_withdraws_the_question() {
    for no in ["no", "nope", "neither"] {
        let printed = session(&[TORN, no, "the cup"], &[]);
        assert_eq!(printed.matches(WHICH).count(), 1, "{no}: {printed}");
        assert!(printed.contains("withdrawn"), "{no}: {printed}");
        assert!(!printed.contains("decided  pick"), "{no}: {printed}");
    }
}

#[test]
fn yep_and_nope_answer_a_yes_or_no() {
    let joint = ["--model", "joint"];
    let yes = session(&[TORN, "yep"], &joint);
    assert!(
        yes.contains("Do you mean: pick cup?") && yes.contains("decided  pick cup"),
        "{yes}"
    );
    let no = session(&[TORN, "nope"], &joint);
    assert!(!no.contains("decided  pick cup"), "{no}");
}

#[test]
fn a_yes_with_more_behind_it_is_a_clear_yes_only_when_that_says_nothing() {
    let joint = ["--model", "joint"];
    for yes in [
        "yes please",
        "yes, thank you",
        "yes yes",
        "Yes, that's right.",
        "yess please",
    ] {
        let printed = session(&[TORN, yes], &joint);
        assert!(printed.contains("decided  pick cup"), "{yes}: {printed}");
    }
    for other in [
        "yes but not now",
        "yes, tomorrow",
        "yes, the cube",
        "no, the cube",
        "yes no",
    ] {
        let printed = session(&[TORN, other], &joint);
        assert!(!printed.contains("decided  pick cup"), "{other}: {printed}");
        let corrects = other.contains("cube");
        assert_eq!(
            printed.contains("decided  pick cube"),
            corrects,
            "{other}: {printed}"
        );
    }
}

#[test]
fn none_of_it_withdraws_the_whole_intent() {
    for none in ["neither", "none of them", "No, thanks", "none, please"] {
        let printed = session(&[TORN, none], &["--model", "joint"]);
        assert!(printed.contains("withdrawn"), "{none}: {printed}");
        assert!(!printed.contains("decided  pick"), "{none}: {printed}");
    }
}

#[test]
fn a_command_instead_of_an_answer_is_said_to_be_one() {
    let printed = session(&[TORN, "push the can"], &[]);
    assert!(
        printed.contains("said     push the can (a new command"),
        "{printed}"
    );
    assert!(
        !printed.contains("answered") && printed.contains("decided  push can"),
        "{printed}"
    );
    let printed = session(&[TORN, "push the can"], &["--json"]);
    let objects = printed
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).unwrap());
    let instead: Vec<_> = objects.filter(|o| o["instead_of_answer"] == true).collect();
    assert_eq!(instead.len(), 1, "{printed}");
}

#[test]
fn orders_for_the_robot_are_orders_wherever_they_are_said() {
    for (order, told) in [
        ("hold", "does not hold"),
        ("resume", "does not resume"),
        ("home", "told     the robot to go home"),
        ("clear", "told     the robot to clear its fault"),
    ] {
        let printed = session(&[], &["--say", order]);
        assert!(printed.contains(told), "{order}: {printed}");
        assert!(
            !printed.contains("decided") && !printed.contains("asks"),
            "{order}: {printed}"
        );
        let decided = decide(&["--say", order]);
        assert!(
            decided.starts_with("nothing it tells the robot itself"),
            "{order}: {decided}"
        );
    }
}

#[test]
fn a_distance_that_is_none_is_refused_with_its_unit() {
    let printed = session(&["move up minus 5 cm"], &[]);
    assert!(
        printed.contains("refuses: the arm does not go -5 cm in one motion"),
        "{printed}"
    );
    assert!(printed.contains("a figure above 0"), "{printed}");
}

#[test]
fn a_unit_that_is_not_known_is_named_with_those_that_are() {
    let error = decide(&["--say", "move up 5 parsecs"]);
    assert!(error.contains("\"parsecs\" is no unit"), "{error}");
    for unit in ["mm", "cm", "inch", "degree"] {
        assert!(error.contains(unit), "{unit}: {error}");
    }
    let error = decide(&["--say", "move up 5"]);
    assert!(error.contains("\"5\" has no unit"), "{error}");
}

#[test]
fn a_question_for_something_to_be_done_says_how_to_have_it_done() {
    for (question, request) in [
        ("can you pick the cup?", "pick the cup"),
        (
            "could you put the can in the drawer",
            "put the can in the drawer",
        ),
    ] {
        let told = decide(&["--say", question]);
        assert!(
            told.contains(&format!("to have it done, say \"{request}\"")),
            "{told}"
        );
        let polite = question.replacen("you ", "you please ", 1);
        let done = [decide(&["--say", request]), decide(&["--say", &polite])];
        assert!(done.iter().all(|d| d.starts_with("execute ")), "{done:?}");
        assert_eq!(done[0], done[1]);
    }
    for question in [
        "can you see the cup?",
        "is the cup full?",
        "what can you pick up?",
    ] {
        let told = decide(&["--say", question]);
        assert!(
            told.starts_with("nothing") && !told.contains("to have it done"),
            "{told}"
        );
    }
}

#[test]
fn figures_are_printed_as_short_as_they_are() {
    let printed = decide(&["--say", "move up 5 cm", "--json"]);
    assert!(printed.contains("\"quantity\":0.05}"), "{printed}");
    let printed = session(&[], &["--json", "--say", "pick the can"]);
    assert!(printed.contains("[0.45,0.1,0.06]"), "{printed}");
}
