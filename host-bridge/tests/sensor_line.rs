//! A hand sensor on the unit's own line: what the unit sees is recorded, and how a person aims is found from it, on a
//! board in QEMU.

use std::io::{BufRead, BufReader, Read};
use std::net::TcpListener;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use deictic::hand::aim::read;
use deictic::hand::session::{Act, Session};
use deictic::hand::source::recording::{self, Recorder};
use deictic::link::IMAGE_VARIABLE;
use deictic::scene::{SceneFile, Tabletop};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::wire::Sample;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

/// Six degrees to the right, four down.
const BIAS: [f64; 2] = [0.105, -0.07];

/// A folder with recordings, and a board whose sensor line is at a port.
struct Bench {
    folder: tempfile::TempDir,
    table: Tabletop,
    lexicon: Lexicon,
    port: u16,
}

/// A program that runs until it is told to end, as by Ctrl-C, which ends its board as well.
struct Running(Child);

impl Running {
    fn end(&mut self) -> bool {
        let pid = self.0.id().to_string();
        let told = Command::new("kill").args(["-INT", &pid]).status();
        told.is_ok_and(|s| s.success()) && self.0.wait().is_ok_and(|s| s.success())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if matches!(self.0.try_wait(), Ok(None)) {
            self.end();
        }
    }
}

impl Bench {
    fn new() -> Self {
        let lexicon = Lexicon::tabletop().unwrap();
        let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
        let free = TcpListener::bind(("127.0.0.1", 0)).unwrap();
        Self {
            folder: tempfile::tempdir().unwrap(),
            table,
            lexicon,
            port: free.local_addr().unwrap().port(),
        }
    }

    fn at(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }

    fn board(&self) -> String {
        format!("qemu:{}", self.port)
    }

    /// A person who always misses by [`BIAS`] points at these things; the recording's name.
    fn record(&self, name: &str, seed: u64, things: &[&str]) -> String {
        let place = |name: &str| {
            let thing = [Category::OBJECT, Category::STORAGE]
                .into_iter()
                .find_map(|c| self.table.find(c, self.lexicon.option(c, name)?));
            thing.expect("on the table").position
        };
        let acts: Vec<Act> = things
            .iter()
            .flat_map(|name| [Act::Point(place(name)), Act::Show(Shape::Grab)])
            .collect();
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let session = Session::new(self.table.hand().mount, 0.0175, &mut rng);
        let path = self.at(name);
        let mut recorder = Recorder::create(Path::new(&path)).unwrap();
        for sample in session.biased(BIAS).perform(&acts, 110.0) {
            recorder.push(&sample).unwrap();
        }
        recorder.finish().unwrap();
        path
    }

    /// Streams a recording to the board's sensor line; whether all of it was taken, which a board that has been
    /// switched off meanwhile does not.
    fn stream(&self, recording: &str) -> bool {
        let (hand, line) = (
            format!("file:{recording}"),
            format!("tcp:127.0.0.1:{}", self.port),
        );
        let output = deictic(&["hand", "--hand", &hand, "--to", &line])
            .output()
            .unwrap();
        output.status.success()
    }
}

fn deictic(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_deictic"));
    command.args(arguments).stdin(Stdio::null());
    command
}

/// Starts a program and waits for its first line.
fn started(arguments: &[&str]) -> (Running, BufReader<std::process::ChildStdout>) {
    let mut child = deictic(arguments).stdout(Stdio::piped()).spawn().unwrap();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    let mut first = String::new();
    out.read_line(&mut first).unwrap();
    (Running(child), out)
}

fn has_image() -> bool {
    let named = std::env::var_os(IMAGE_VARIABLE).is_some();
    if !named {
        eprintln!(
            "skipped: no board image; `cargo xtask test` builds one and names it in {IMAGE_VARIABLE}"
        );
    }
    named
}

/// What the unit took a pointing hand on its own line to mean most, with this aim or the scene's.
fn meant(bench: &Bench, recording: &str, aim: Option<&str>) -> String {
    let board = bench.board();
    let mut arguments = vec!["hand", "--json", "--board", &board];
    arguments.extend(aim.into_iter().flat_map(|aim| ["--aim", aim]));
    let (_running, out) = started(&arguments);
    std::thread::scope(|scope| {
        scope.spawn(|| assert!(bench.stream(recording)));
        let events = out.lines().map(|line| line.unwrap());
        let mut shown = events
            .map(|line| serde_json::from_str::<Value>(&line).unwrap())
            .filter(|event| event["event"] == "shown");
        let shown = shown.next().expect("a sentence");
        shown["shown"].as_str().unwrap().to_owned()
    })
}

#[test]
fn an_aim_found_on_the_units_own_line_is_used_on_it() {
    if !has_image() {
        return;
    }
    let bench = Bench::new();
    let things = ["can", "cup", "cube"];
    let recording = bench.record("points", 21, &things);
    let (board, out) = (bench.board(), bench.at("anna.aim"));
    let mut arguments = vec!["gestures", "aim"];
    arguments.extend(things);
    arguments.extend(["--board", &board, "--out", &out]);
    let (mut aiming, mut said) = started(&arguments);
    bench.stream(&recording);
    let status = aiming.0.wait().unwrap();
    let mut rest = String::new();
    said.read_to_string(&mut rest).unwrap();
    assert!(status.success(), "{rest}");

    // What the unit passed on is what its sensor sent: a sensor at the host gives the same aim, to the last bit.
    let here = bench.at("here.aim");
    let hand = format!("file:{recording}");
    let mut arguments = vec!["gestures", "aim"];
    arguments.extend(things);
    arguments.extend(["--hand", &hand, "--out", &here]);
    assert!(deictic(&arguments).output().unwrap().status.success());
    let found = read(Path::new(&out)).unwrap();
    assert_eq!(found, read(Path::new(&here)).unwrap());
    assert_ne!(found.mount, bench.table.hand().mount);

    // The same person points at something else, before the same unit.
    let again = bench.record("again", 25, &["drawer"]);
    assert_ne!(meant(&bench, &again, None), "drawer");
    assert_eq!(meant(&bench, &again, Some(&out)), "drawer");
}

#[test]
fn what_the_units_own_sensor_sends_is_recorded() {
    if !has_image() {
        return;
    }
    let bench = Bench::new();
    let recording = bench.record("points", 3, &["can"]);
    let (board, copy) = (bench.board(), bench.at("copy"));
    let arguments = ["hand", "--json", "--board", &board, "--record", &copy];
    let (mut running, out) = started(&arguments);
    assert!(bench.stream(&recording));
    let sent = recording::read(Path::new(&recording)).unwrap();
    let is_hand = |s: &&Sample| matches!(s, Sample::Hand(_));
    let hands = sent.iter().filter(is_hand).count() as u64;
    // When the unit says that it has read them all, it has passed them on before.
    let read_all = |line: String| {
        let event: Value = serde_json::from_str(&line).unwrap();
        let counted = |name: &str| event["samples"][name].as_u64().unwrap_or(0);
        counted("used") + counted("hurried") == hands
    };
    assert!(out.lines().map(Result::unwrap).any(read_all));
    // Ctrl-C ends the recording in order.
    assert!(running.end());
    let passed: Vec<Sample> = recording::read(Path::new(&copy)).unwrap();
    assert_eq!(passed.iter().filter(is_hand).count() as u64, hands);
    assert_eq!(passed, sent[..passed.len()]);
}
