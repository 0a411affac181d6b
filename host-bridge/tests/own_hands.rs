//! What a person teaches: gestures of their own, and how they aim.

use std::path::Path;
use std::process::{Command, Output};

use deictic::hand::aim::{Pointings, aim, read};
use deictic::hand::session::{Act, Session};
use deictic::hand::source::recording::Recorder;
use deictic::scene::{SceneFile, Tabletop};
use deictic::vocabulary::Lexicon;
use deictic_core::gesture::pointing::{Aim, meant};
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::wire::Sample;
use deictic_core::large;
use deictic_core::protocol::hand::HandSettings;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

/// Six degrees to the right, four down.
const BIAS: [f64; 2] = [0.105, -0.07];

fn deictic(arguments: &[&str]) -> Output {
    let command = Command::new(env!("CARGO_BIN_EXE_deictic"))
        .args(arguments)
        .output();
    command.expect("the program runs")
}

fn said(output: &Output) -> String {
    let text = [&output.stdout[..], &output.stderr].concat();
    String::from_utf8_lossy(&text).into_owned()
}

fn scene() -> (Tabletop, Lexicon) {
    let lexicon = Lexicon::tabletop().unwrap();
    let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
    (table, lexicon)
}

/// A person who always misses by [`BIAS`], a degree more or less, and points at these places.
fn pointing(seed: u64, table: &Tabletop, places: &[[f32; 3]]) -> Vec<Sample> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let acts: Vec<Act> = places
        .iter()
        .flat_map(|place| [Act::Point(*place), Act::Show(Shape::Grab)])
        .collect();
    let session = Session::new(table.hand().mount, 0.0175, &mut rng);
    session.biased(BIAS).perform(&acts, 110.0)
}

fn save(samples: &[Sample], path: &Path) {
    let mut recorder = Recorder::create(path).unwrap();
    for sample in samples {
        recorder.push(sample).unwrap();
    }
    recorder.finish().unwrap();
}

/// Of all things that the person points at, the share that is the likeliest for these settings.
fn right(settings: HandSettings, seed: u64, table: &Tabletop, lexicon: &Lexicon) -> usize {
    let things = table.scene().entities();
    let places: Vec<[f32; 3]> = things.iter().map(|t| t.position).collect();
    let there = table.clone().with_hand(settings);
    // Each in a session of its own, so that no fist has to be told from a thumb up.
    let rays: Vec<_> = (seed..)
        .zip(&places)
        .filter_map(|(seed, place)| {
            let mut pointings = Pointings::new(&there, lexicon);
            let samples = pointing(seed, table, &[*place]);
            samples.iter().find_map(|s| pointings.push(s))
        })
        .collect();
    assert_eq!(rays.len(), places.len(), "seed {seed}");
    let best = rays.iter().map(|ray| {
        let m = meant::<{ large::ENTITIES }>(ray, places.iter().copied(), &settings.aim);
        deictic_core::math::argmax(&m.points)
    });
    best.zip(0..).filter(|(best, i)| *best == Some(*i)).count()
}

#[test]
fn an_aim_that_was_found_makes_more_pointing_right() {
    let (table, lexicon) = scene();
    let (mut before, mut after, mut all) = (0, 0, 0);
    for seed in [21, 23, 24, 25, 26, 27] {
        let things = table.scene().entities();
        let known: Vec<[f32; 3]> = things.iter().step_by(2).map(|t| t.position).collect();
        let mut pointings = Pointings::new(&table, &lexicon);
        let samples = pointing(seed, &table, &known);
        let rays: Vec<_> = samples.iter().filter_map(|s| pointings.push(s)).collect();
        if rays.len() != known.len() {
            continue;
        }
        let pointed: Vec<_> = rays.into_iter().zip(known).collect();
        let found = aim(table.hand(), &pointed).unwrap();
        assert!(found.settings.mount.check().is_ok() && found.settings.aim.is_sound());
        before += right(table.hand(), 100 * seed, &table, &lexicon);
        after += right(found.settings, 100 * seed, &table, &lexicon);
        all += things.len();
        assert!(found.settings.aim.sigma < Aim::DEFAULT.sigma);
    }
    println!("{before} of {all} before, {after} after");
    assert!(
        after * 10 >= all * 8 && after > before + all / 5,
        "{before} {after} {all}"
    );
}

#[test]
fn an_aim_is_found_written_and_used() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let (table, _) = scene();
    let of = |name: &str, lexicon: &Lexicon| {
        let category = deictic_core::category::Category::OBJECT;
        let option = lexicon.option(category, name).unwrap();
        table.find(category, option).unwrap().position
    };
    let (_, lexicon) = scene();
    let places = ["can", "cup", "cube"].map(|name| of(name, &lexicon));
    save(
        &pointing(21, &table, &places),
        Path::new(&at("points.hand")),
    );
    let hand = format!("file:{}", at("points.hand"));
    let out = at("anna.aim");
    let output = deictic(&[
        "gestures", "aim", "can", "cup", "cube", "--hand", &hand, "--out", &out,
    ]);
    assert!(output.status.success(), "{}", said(&output));
    assert!(
        said(&output).contains("3 things pointed at"),
        "{}",
        said(&output)
    );
    let found = read(Path::new(&out)).unwrap();
    assert_ne!(found.mount, table.hand().mount);

    // Too few, none, and a file that holds no aim are named.
    let output = deictic(&[
        "gestures", "aim", "can", "cup", "--hand", &hand, "--out", &out,
    ]);
    assert!(
        said(&output).contains("an aim needs 3"),
        "{}",
        said(&output)
    );
    let output = deictic(&["gestures", "aim", "moon", "--hand", &hand, "--out", &out]);
    assert!(
        said(&output).contains("no \"moon\" on the table"),
        "{}",
        said(&output)
    );
    let output = deictic(&["hand", "--hand", &hand, "--aim", &hand]);
    assert!(
        said(&output).contains("cannot read the aim"),
        "{}",
        said(&output)
    );
}

/// A person who draws a letter some times; the first ones are the same however many there are.
fn letters(name: &str, seed: u64, times: usize) -> Vec<Sample> {
    let (table, _) = scene();
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let acts = vec![Act::Move(name.to_owned()); times];
    Session::new(table.hand().mount, 0.03, &mut rng).perform(&acts, 110.0)
}

#[test]
fn a_gesture_of_ones_own_is_learned_and_then_read() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    for (name, seed) in [("z", 31), ("m", 32)] {
        save(&letters(name, seed, 2), Path::new(&at(name)));
    }
    let (z, m, out) = (
        format!("zed={}", at("z")),
        format!("em={}", at("m")),
        at("mine.gestures"),
    );
    let output = deictic(&["gestures", "learn", &z, &m, "--out", &out]);
    assert!(output.status.success(), "{}", said(&output));

    let vocabulary =
        include_str!("../data/tabletop.toml").replace("\"pinch\"", "\"zed\", \"pinch\"");
    std::fs::write(at("mine.toml"), vocabulary).unwrap();
    // The same person again, who adds one.
    save(&letters("z", 31, 3), Path::new(&at("again")));
    let hand = format!("file:{}", at("again"));
    let arguments = [
        "hand",
        "--json",
        "--hand",
        &hand,
        "--gestures",
        &out,
        "--vocabulary",
        &at("mine.toml"),
    ];
    let output = deictic(&arguments);
    assert!(output.status.success(), "{}", said(&output));
    let lines = String::from_utf8_lossy(&output.stdout).into_owned();
    let events: Vec<Value> = lines
        .lines()
        .map(|l| serde_json::from_str(l).unwrap())
        .collect();
    let told = events.iter().filter_map(|e| e["movement"]["zed"].as_f64());
    assert!(told.fold(0.0, f64::max) > 0.9, "{lines}");
    let shown = events
        .iter()
        .find(|e| e["event"] == "shown")
        .expect("a sentence");
    assert!(shown["shown"].as_str().unwrap().contains("pick"), "{shown}");

    // Without what was learned it is no gesture that stands for anything.
    let output = deictic(&["hand", "--json", "--hand", &hand]);
    assert!(
        !said(&output).contains("\"shown\":\"pick"),
        "{}",
        said(&output)
    );
}
