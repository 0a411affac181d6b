//! The commands that score what the unit knows of hands.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use deictic_eval::gestures::sessions::Bench;
use deictic_eval::gestures::{dynamics, hands, statics, telling};
use serde_json::Value;

fn eval(arguments: &[&str]) -> Output {
    let command = Command::new(env!("CARGO_BIN_EXE_deictic-eval"))
        .arg("gestures")
        .args(arguments)
        .output();
    command.expect("the program runs")
}

/// What the program prints, which must have the keys that other programs read.
fn score(output: &Output) -> Value {
    let score: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)));
    assert!(
        score["accuracy"].is_number() && score["n"].is_number(),
        "{score}"
    );
    assert!(score["confusion"].is_object(), "{score}");
    score
}

fn file(name: &str, text: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, text).unwrap();
    path
}

/// Strokes of made-up people as the program prints and reads them.
fn strokes(people: usize, seed: u64) -> String {
    let mut text = "subject,gesture,take,t_ms,x,y,z\n".to_owned();
    for take in dynamics::perform(&dynamics::own_names(), people, 1, seed) {
        for (t, [x, y, z]) in &take.samples {
            let (who, what) = (take.subject, &take.gesture);
            let _ = writeln!(
                text,
                "p{who},{what},{},{t:.1},{x:.1},{y:.1},{z:.1}",
                take.take
            );
        }
    }
    text
}

#[test]
fn strokes_of_strangers_are_told() {
    let train = file("train.csv", &strokes(16, 5)).display().to_string();
    let test = file("test.csv", &strokes(12, 6)).display().to_string();
    let told = score(&eval(&[
        "dynamic", "--train", &train, "--test", &test, "--json",
    ]));
    assert_eq!(told["n"], 96);
    assert!(told["accuracy"].as_f64().unwrap() >= 96.0, "{told}");
    let told = score(&eval(&["dynamic", "--train", &train, "--json"]));
    assert_eq!(told["n"], 128);
    assert!(told["accuracy"].as_f64().unwrap() >= 96.0, "{told}");
}

#[test]
fn files_that_hold_no_strokes_are_named_with_their_line() {
    for (name, text, says) in [
        (
            "no_column.csv",
            "subject,gesture,t_ms,x,y\n",
            "no column `z`",
        ),
        (
            "nan.csv",
            "subject,gesture,t_ms,x,y,z\na,b,0,1,2,3\na,b,9,NaN,2,3\n",
            "line 3",
        ),
        ("empty.csv", "subject,gesture,t_ms,x,y,z\n", "needs two"),
    ] {
        let path = file(name, text).display().to_string();
        let output = eval(&["dynamic", "--train", &path, "--json"]);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            !output.status.success() && error.contains(says),
            "{name}: {error}"
        );
    }
}

#[test]
fn recorded_shapes_are_told_and_so_are_other_peoples() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/hands");
    let (shapes, frames) = (
        folder.join("leap_static.csv.xz"),
        folder.join("leapjs_frames.csv.xz"),
    );
    if !shapes.is_file() || !frames.is_file() {
        eprintln!("skipped: {} is absent", folder.display());
        return;
    }
    let hands::Hands::Frames(recordings) = hands::read(&frames).unwrap() else {
        panic!("frames");
    };
    // The unit's own network, which `deictic-eval gestures train` has made of these shapes.
    let network = &deictic_core::gesture::shape_table::NETWORK;
    for (recording, order) in [
        ("grab right", &["five", "grab", "five", "grab", "five"][..]),
        ("pinch right", &["five", "pinch", "five"]),
        ("gun right", &["point"]),
        ("wave right", &["five"]),
    ] {
        let told = telling::tell(network, &recordings[recording]);
        assert_eq!(told.order, order, "{recording}");
    }
    let hands::Hands::Labelled(labelled) = hands::read(&shapes).unwrap() else {
        panic!("shapes");
    };
    let told = statics::score(&statics::answers(
        network,
        &labelled.iter().collect::<Vec<_>>(),
    ));
    assert!(told.accuracy >= 99.0, "{}", told.accuracy);
}

#[test]
fn whole_sessions_are_read_but_for_things_that_lie_side_by_side() {
    let score = Bench::new().unwrap().score(5_000, 200, 0.035, None);
    let near = "pointing at one thing taken for another near to it";
    let wrong: usize = score
        .causes
        .iter()
        .filter(|(cause, _)| *cause != near)
        .map(|c| c.1.sessions)
        .sum();
    assert!(wrong <= 12, "{score:?}");
    assert!(score.accuracy >= 86.0, "{score:?}");
}

#[test]
fn a_wave_stops_and_nothing_else_does() {
    let bench = Bench::new().unwrap();
    assert!(bench.of("wave moon").is_none());
    let wave = bench.of("wave").unwrap();
    let waved = bench.score(7_000, 200, 0.035, Some(&wave));
    assert!(waved.accuracy >= 97.0, "{waved:?}");
    for other in ["swipe-right", "swipe-left", "circle", "thumbsup cup drawer"] {
        let Some(script) = bench.of(other) else {
            continue;
        };
        let score = bench.score(7_000, 200, 0.035, Some(&script));
        let stopped = score.causes.get("stopped without a stop gesture");
        assert!(stopped.is_none(), "{other}: {stopped:?}");
    }
}
