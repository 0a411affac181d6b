//! What a person types and speaks apart from what they show, and while the arm moves, through the program: on the unit in
//! this process, and on the emulated board where there is an image.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use deictic::link::IMAGE_VARIABLE;
use serde_json::Value;

/// A session of the program, whose lines are written when something has happened.
struct Talk {
    child: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    heard: Vec<Value>,
}

/// The units to try.
fn boards() -> Vec<&'static str> {
    let named = std::env::var_os(IMAGE_VARIABLE).is_some();
    if !named {
        eprintln!("not on a board: no image is named in {IMAGE_VARIABLE}");
    }
    ["inside", "qemu"][..=usize::from(named)].to_vec()
}

impl Talk {
    /// A session with a pairing window of a minute, so that no machine is too slow for what lies apart.
    fn begin(board: &str, arguments: &[&str]) -> Self {
        Self::begin_within("60000", board, arguments)
    }

    fn begin_within(window: &str, board: &str, arguments: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_deictic"))
            .args(["run", "--board", board, "--json", "--window", window])
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let input = child.stdin.take();
        let output = BufReader::new(child.stdout.take().unwrap());
        let mut talk = Self {
            child,
            input,
            output,
            heard: Vec::new(),
        };
        talk.until(|event| event["event"] == "ready");
        talk
    }

    fn say(&mut self, line: &str) {
        let input = self.input.as_mut().unwrap();
        writeln!(input, "{line}").unwrap();
    }

    /// Reads on until something has happened.
    fn until(&mut self, wanted: impl Fn(&Value) -> bool) {
        loop {
            let mut line = String::new();
            let read = self.output.read_line(&mut line).unwrap();
            assert!(read > 0, "it does not come: {:#?}", self.heard);
            let event: Value = serde_json::from_str(&line).unwrap();
            let found = wanted(&event);
            self.heard.push(event);
            if found {
                return;
            }
        }
    }

    fn until_event(&mut self, name: &str) {
        self.until(|event| event["event"] == name);
    }

    /// Until the arm is in the middle of something.
    fn until_moving(&mut self) {
        self.until(|event| event["event"] == "step" && event["number"] == 2);
    }

    /// Nothing more is typed; all that was said, and the exit code.
    fn end(mut self) -> (Vec<Value>, i32) {
        self.input = None;
        for line in self.output.lines() {
            self.heard
                .push(serde_json::from_str(&line.unwrap()).unwrap());
        }
        (self.heard, self.child.wait().unwrap().code().unwrap())
    }
}

fn has(heard: &[Value], event: &str) -> bool {
    heard.iter().any(|e| e["event"] == event)
}

/// What was decided to be done, as the robot was told.
fn accepted(heard: &[Value]) -> Vec<String> {
    let accepted = heard.iter().filter(|e| e["event"] == "accepted");
    let named = accepted.map(|e| {
        let parameters = e["intent"]["parameters"].as_array().unwrap().iter();
        let names = parameters.map(|p| p["option"].as_str().unwrap());
        let action = std::iter::once(e["intent"]["action"].as_str().unwrap());
        action.chain(names).collect::<Vec<_>>().join(" ")
    });
    named.collect()
}

#[test]
fn what_is_typed_apart_from_what_is_shown_holds_it_back_in_either_order() {
    for board in boards() {
        for said in [
            "don't pick the cup",
            "could you pick the cup?",
            "no",
            "pikc xyzzy",
            "never mind",
        ] {
            let mut talk = Talk::begin(board, &["--haste", "1000"]);
            talk.say("// pick cup");
            talk.until_event("heard");
            talk.say(said);
            talk.until_event("withheld");
            talk.say("// pick cup");
            talk.until_event("withheld");
            let (heard, code) = talk.end();
            assert!(!has(&heard, "decided"), "{said}: {heard:#?}");
            assert_eq!(code, 2, "{said}");
        }
    }
}

#[test]
fn what_is_done_after_a_prohibition_is_a_command_of_its_own() {
    for board in boards() {
        let mut talk = Talk::begin(board, &["--haste", "1000"]);
        talk.say("don't pick the cup");
        talk.say("// pick cup");
        talk.until_event("withheld");
        talk.say("pick the can // pick can");
        talk.until_event("done");
        let (heard, code) = talk.end();
        assert_eq!(accepted(&heard), ["pick can"]);
        assert_eq!(code, 0);
    }
}

#[test]
fn what_is_spoken_holds_back_what_is_shown() {
    let lines = [
        "echo \"don't pick the cup\"",
        r#"echo '{"alternatives": [{"text": "pick the cup", "confidence": 0.7}, {"text": "do not pick the cup", "confidence": 0.3}]}'"#,
        r#"echo '{"alternatives": [{"text": "pick the cup", "confidence": 0.9}, {"text": "do not pick the cup", "confidence": 0.1}]}'"#,
        "echo 'could you pick the cup?'",
        "echo 'xyzzy'",
    ];
    for board in boards() {
        for line in lines {
            // What is shown is there before the first word is.
            let speech = format!("lines:sleep 1; {line}");
            let mut talk = Talk::begin(board, &["--show", "pick cup", "--speech", &speech]);
            talk.until_event("withheld");
            let (heard, _) = talk.end();
            assert!(!has(&heard, "decided"), "{line}: {heard:#?}");
        }
    }
}

#[test]
fn a_hand_that_still_shows_is_held_back_too() {
    for board in boards() {
        let hand = "made-up:1:pinch cup";
        let arguments = ["--say", "don't pick the cup", "--hand", hand];
        let talk = Talk::begin(board, &arguments);
        let (heard, code) = talk.end();
        assert!(
            has(&heard, "shown") && has(&heard, "withheld"),
            "{heard:#?}"
        );
        assert!(!has(&heard, "decided"), "{heard:#?}");
        assert_eq!(code, 2);
    }
}

#[test]
fn a_refusal_stops_the_arm_at_once_and_what_waits() {
    for board in boards() {
        for said in ["no", "don't", "don't pick the can", "never mind"] {
            let mut talk = Talk::begin(board, &[]);
            talk.say("pick the can // pick can");
            talk.until_moving();
            talk.say("push the box // push box");
            talk.say(said);
            talk.until_event("stopped");
            let (heard, code) = talk.end();
            assert_eq!(accepted(&heard)[0], "pick can", "{said}");
            assert!(!accepted(&heard).contains(&"push box".to_owned()), "{said}");
            assert!(has(&heard, "dropped") && !has(&heard, "done"), "{said}");
            assert_eq!(code, 2, "{said}");
        }
    }
}

#[test]
fn a_spoken_no_stops_the_arm_even_when_it_is_not_sure() {
    let both = r#"{"alternatives": [{"text": "now", "confidence": 0.7}, {"text": "no", "confidence": 0.3}]}"#;
    let speech = format!("lines:echo 'pick the can'; sleep 5; echo '{both}'; sleep 1");
    let mut talk = Talk::begin_within("100", "inside", &["--speech", &speech]);
    talk.until_event("stopped");
    let (heard, code) = talk.end();
    assert!(has(&heard, "told-to-stop") && !has(&heard, "done"));
    assert_eq!(code, 2);
}

#[test]
fn a_question_does_not_stop_the_arm() {
    let mut talk = Talk::begin("inside", &["--haste", "3"]);
    talk.say("pick the can // pick can");
    talk.until_moving();
    talk.say("is it full?");
    talk.until_event("nothing");
    talk.until_event("done");
    let (heard, _) = talk.end();
    assert!(!has(&heard, "stopped"));
}

#[test]
fn a_correction_stops_the_arm_and_is_done_instead() {
    for board in boards() {
        let mut talk = Talk::begin(board, &["--haste", "3"]);
        talk.say("pick the can // pick can");
        talk.until_moving();
        talk.say("no, the cube");
        talk.until_event("stopped");
        talk.until_event("corrected");
        talk.say("// cube");
        talk.until_event("done");
        let (heard, code) = talk.end();
        assert_eq!(accepted(&heard), ["pick can", "pick cube"]);
        assert_eq!(code, 0);
    }
}

#[test]
fn leaving_and_looking_wait_for_nothing() {
    let mut talk = Talk::begin("inside", &[]);
    talk.say("pick the can // pick can");
    talk.until_moving();
    talk.say("table");
    talk.until_event("thing");
    talk.say("quit");
    let (heard, code) = talk.end();
    assert!(has(&heard, "stopped") && !has(&heard, "done"), "{heard:#?}");
    assert_eq!(code, 2);
}

#[test]
fn a_no_to_a_question_withdraws_it_at_the_unit_too() {
    let mut talk = Talk::begin("inside", &["--haste", "1000"]);
    talk.say("pick it // pick can|cup");
    talk.until_event("asked");
    talk.say("no");
    talk.until_event("nothing");
    talk.say("// cup");
    let (heard, _) = talk.end();
    assert_eq!(accepted(&heard), [] as [&str; 0]);
}
