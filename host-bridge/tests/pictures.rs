//! Pictures show the arm and the things where they are.

mod common;

use std::process::Command;

use common::*;
use deictic::draw::{HEIGHT, Picture, svg, text};
use deictic::robot::Robot;
use deictic::robot::sim::Sim;
use deictic_core::time::Micros;

fn ready() -> Picture {
    let lexicon = lexicon();
    let posture = Sim::new(1.0).posture(Micros(0));
    Picture::of(
        posture,
        Some("can"),
        &table(&lexicon),
        &lexicon,
        "a < b & c",
    )
}

#[test]
fn the_arm_goes_from_its_foot_to_its_hand_and_holds_what_it_holds() {
    let picture = ready();
    assert_eq!(picture.arm.first(), Some(&[0.0; 3]));
    let hand = picture.arm.last().unwrap();
    assert!((hand[0] - 0.307).abs() < 1e-3 && (hand[2] - 0.487).abs() < 1e-3);
    let can = picture.things.iter().find(|t| t.name == "can").unwrap();
    assert!(can.held && can.at == *hand);
    let apart = (picture.tips[0][1] - picture.tips[1][1]).abs();
    assert!((apart - 0.08).abs() < 1e-3, "{apart}");
}

#[test]
fn an_svg_names_every_thing_in_both_views_and_is_well_formed() {
    let drawn = svg(&ready());
    for name in ["can", "cup", "cube", "drawer", "bowl"] {
        assert_eq!(
            drawn.matches(&format!(">{name}</text>")).count(),
            2,
            "{name}"
        );
    }
    assert!(drawn.contains("a &lt; b &amp; c"));
    assert_eq!(drawn.matches("<g ").count(), drawn.matches("</g>").count());
    assert!(!drawn.contains("NaN"));
}

#[test]
fn a_text_shows_the_hand_and_the_things() {
    let lines = text(&ready());
    assert_eq!(lines.len(), HEIGHT);
    let all = lines.join("\n");
    assert_eq!(all.matches('+').count(), 2, "{all}");
    for name in ["cu", "dr", "bo"] {
        assert!(all.contains(name), "{all}");
    }
    let width = lines[0].chars().count();
    assert!(lines.iter().all(|line| line.chars().count() == width));
}

#[test]
fn a_session_draws_every_step() {
    let folder = tempfile::tempdir().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_deictic"))
        .args([
            "run", "--board", "inside", "--haste", "100", "--window", "50",
        ])
        .args(["--say", "pick the can", "--draw"])
        .arg(folder.path())
        .output()
        .unwrap();
    assert!(output.status.success());
    let files = std::fs::read_dir(folder.path()).unwrap();
    let mut names: Vec<_> = files
        .map(|f| f.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names.len(), 6, "{names:?}");
    assert_eq!(names[2], "0003-lower-to-the-can.svg");
    let pictures: Vec<_> = names
        .iter()
        .map(|name| std::fs::read_to_string(folder.path().join(name)).unwrap())
        .collect();
    assert!(pictures.iter().all(|p| p.starts_with("<svg ")));
    assert_ne!(pictures[1], pictures[3], "the arm has moved");
}
