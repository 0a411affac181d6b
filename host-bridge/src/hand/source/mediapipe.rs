//! MediaPipe's 21 landmarks of a hand, as JSON lines of any program that runs it.
//!
//! ```text
//! {"timestamp_ms": 33.3, "width": 640, "height": 480, "hands": [{"handedness": "Right", "score": 0.98,
//!   "landmarks": [[0.51, 0.62, 0.0], ...21], "world_landmarks": [[0.01, -0.02, 0.003], ...21]}]}
//! ```
//!
//! `landmarks` are shares of the image (x right, y down), `world_landmarks` metres about the hand's
//! middle, as the Hand Landmarker gives them; points may be `{"x": .., "y": .., "z": ..}` as well. The
//! world's landmarks tell the hand's shape and turn; where it is follows from how large it is in the
//! image. The axes are the camera's: x to the image's right, y up, z towards the camera.

use std::io::{BufRead, BufReader, Read};
use std::net::TcpStream;
use std::path::PathBuf;

use deictic_core::gesture::frame::{Finger, HandFrame, Side};
use deictic_core::gesture::vector::{self, Vector};
use deictic_core::gesture::wire::{Sample, encode};
use deictic_core::math;
use serde::Deserialize;

use super::{Source, SourceError};

/// Where lines come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Input {
    /// Standard input.
    Standard,
    /// A file or a named pipe.
    File(PathBuf),
    /// A server at `HOST:PORT`.
    Tcp(String),
}

/// Focal length in image widths of a camera with a field of view of 60 degrees, as most webcams
/// have: 1 / (2 tan 30 degrees).
const FOCAL: f32 = 0.866;

/// Longest line; 21 points twice take 3 kB.
const LONGEST: u64 = 64 * 1024;

/// MediaPipe's numbers of the joints that a frame holds: knuckle, middle, tip, thumb first.
const JOINTS: [[usize; 3]; 5] = [
    [2, 3, 4],
    [5, 6, 8],
    [9, 10, 12],
    [13, 14, 16],
    [17, 18, 20],
];
const WRIST: usize = 0;
const INDEX: usize = 5;
const MIDDLE: usize = 9;
const LITTLE: usize = 17;

#[derive(Deserialize)]
struct Line {
    timestamp_ms: f64,
    #[serde(default = "wide")]
    width: f32,
    #[serde(default = "high")]
    height: f32,
    #[serde(default)]
    hands: Vec<Hand>,
}

fn wide() -> f32 {
    640.0
}

fn high() -> f32 {
    480.0
}

#[derive(Deserialize)]
struct Hand {
    handedness: String,
    #[serde(default)]
    score: f32,
    landmarks: [Point; 21],
    world_landmarks: [Point; 21],
}

#[derive(Clone, Copy, Deserialize)]
#[serde(untagged)]
enum Point {
    List([f32; 3]),
    Named { x: f32, y: f32, z: f32 },
}

impl Point {
    fn xyz(self) -> Vector {
        match self {
            Self::List(xyz) => xyz,
            Self::Named { x, y, z } => [x, y, z],
        }
    }
}

/// Opens what lines come from.
///
/// # Errors
/// [`SourceError::Unopened`]
pub fn open(input: &Input) -> Result<Source, SourceError> {
    let unopened = |what: String| move |cause| SourceError::Unopened { what, cause };
    Ok(match input {
        Input::Standard => of_lines(std::io::stdin()),
        Input::File(path) => {
            let what = path.display().to_string();
            of_lines(std::fs::File::open(path).map_err(unopened(what))?)
        }
        Input::Tcp(address) => {
            of_lines(TcpStream::connect(address).map_err(unopened(address.clone()))?)
        }
    })
}

fn of_lines(input: impl Read + Send + 'static) -> Source {
    Source::running(move |out| {
        let mut input = BufReader::new(input);
        let mut reader = Reader::default();
        loop {
            let mut line = Vec::new();
            let seen = match input.by_ref().take(LONGEST).read_until(b'\n', &mut line) {
                Ok(0) => return,
                Ok(_) => reader.read(&line),
                Err(error) => vec![Err(SourceError::Broken(error))],
            };
            for sample in seen {
                let broken = matches!(sample, Err(SourceError::Broken(_)));
                if out.send(sample).is_err() || broken {
                    return;
                }
            }
        }
    })
}

/// Turns lines into samples; velocities come from the line before.
#[derive(Default)]
pub struct Reader {
    number: u64,
    /// Time and palm of each side's hand.
    before: [Option<(f64, Vector)>; 2],
}

impl Reader {
    /// The samples of one line: one per hand, or one that there is none.
    pub fn read(&mut self, line: &[u8]) -> Vec<Result<Sample, SourceError>> {
        self.number += 1;
        let number = self.number;
        if line.iter().all(u8::is_ascii_whitespace) {
            return Vec::new();
        }
        let line: Line = match serde_json::from_slice(line) {
            Ok(line) => line,
            Err(why) => {
                let why = why.to_string();
                return vec![Err(SourceError::Form { number, why })];
            }
        };
        let time = (line.timestamp_ms * 1e3) as u64 as u32;
        if line.hands.is_empty() {
            self.before = [None; 2];
            return vec![Ok(Sample::Nothing(time))];
        }
        let hands = line.hands.iter();
        hands
            .map(|hand| {
                let sample = Sample::Hand(self.follow(time, &line, hand));
                match encode(&sample) {
                    Ok(_) => Ok(sample),
                    Err(error) => Err(SourceError::Unsound { number, error }),
                }
            })
            .collect()
    }

    fn follow(&mut self, time: u32, line: &Line, hand: &Hand) -> HandFrame {
        let side = if hand.handedness.eq_ignore_ascii_case("left") {
            Side::Left
        } else {
            Side::Right
        };
        // Metres, y down, z away from the camera, to mm, y up, z towards it.
        let world = hand.world_landmarks.map(|p| {
            let [x, y, z] = p.xyz();
            [1e3 * x, -1e3 * y, -1e3 * z]
        });
        let middle =
            |points: &[Vector; 21]| vector::scale(vector::add(points[WRIST], points[MIDDLE]), 0.5);
        let inside = middle(&world);
        let at = place(line, hand, &world);
        let put = |p: Vector| vector::add(at, vector::sub(p, inside));
        let knuckle = vector::scale(vector::add(world[INDEX], world[LITTLE]), 0.5);
        let across = vector::sub(world[INDEX], world[LITTLE]);
        let along = vector::sub(knuckle, world[WRIST]);
        let out = match side {
            Side::Right => vector::cross(across, along),
            Side::Left => vector::cross(along, across),
        };
        let before = &mut self.before[usize::from(side == Side::Left)];
        let velocity = match *before {
            Some((t, from)) if line.timestamp_ms > t => {
                let seconds = ((line.timestamp_ms - t) / 1e3) as f32;
                vector::scale(vector::sub(at, from), 1.0 / seconds.max(1e-3))
            }
            _ => [0.0; 3],
        };
        *before = Some((line.timestamp_ms, at));
        let tips = vector::distance(world[JOINTS[0][2]], world[JOINTS[1][2]]);
        HandFrame {
            time,
            side,
            confidence: hand.score.clamp(0.0, 1.0),
            // 40 mm between thumb and index are no pinch any more. A grab is the core's to see.
            pinch: (1.0 - tips / 40.0).clamp(0.0, 1.0),
            grab: 0.0,
            palm: at,
            velocity,
            normal: vector::unit(out).unwrap_or([0.0, -1.0, 0.0]),
            direction: vector::unit(along).unwrap_or([0.0, 0.0, -1.0]),
            fingers: JOINTS.map(|[knuckle, middle, tip]| {
                Some(Finger {
                    knuckle: put(world[knuckle]),
                    middle: put(world[middle]),
                    tip: put(world[tip]),
                })
            }),
        }
    }
}

/// Where the palm is, mm from the camera: as far as its landmarks in the image are smaller than those
/// of the world.
fn place(line: &Line, hand: &Hand, world: &[Vector; 21]) -> Vector {
    let image = hand.landmarks.map(|p| {
        let [x, y, _] = p.xyz();
        // Image widths from its middle, y up.
        [x - 0.5, (0.5 - y) * line.height / line.width, 0.0]
    });
    let spread = |points: &[Vector; 21]| -> f32 {
        let mut mean = [0.0; 3];
        for p in points {
            mean = vector::add(mean, vector::scale(*p, 1.0 / 21.0));
        }
        let flat = |p: &Vector| {
            let [x, y, _] = vector::sub(*p, mean);
            x * x + y * y
        };
        math::sqrt(points.iter().map(flat).sum())
    };
    let depth = FOCAL * spread(world) / spread(&image).max(1e-4);
    let palm = vector::scale(vector::add(image[WRIST], image[MIDDLE]), 0.5);
    let far = depth.clamp(50.0, 3_000.0);
    [palm[0] * far / FOCAL, palm[1] * far / FOCAL, -far]
}
