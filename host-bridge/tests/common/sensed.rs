//! Hand sensors to be read, and what they send of a made-up person's hand.

use std::time::{Duration, Instant};

use deictic::hand::session::{Act, made_up};
use deictic::hand::source::{Address, Seen, Source, SourceError};
use deictic::scene::{SceneFile, Tabletop};
use deictic::vocabulary::Lexicon;
use deictic_core::gesture::frame::HandFrame;
use deictic_core::gesture::pointing::Mount;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::vector;
use deictic_core::gesture::wire::Sample;
use serde_json::{Value, json};

fn table() -> (Tabletop, Lexicon) {
    let lexicon = Lexicon::tabletop().unwrap();
    let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
    (table, lexicon)
}

pub fn open(address: &str) -> Result<Source, SourceError> {
    let (table, lexicon) = table();
    let address: Address = address.parse().unwrap();
    Source::open(&address, &table, &lexicon)
}

/// Everything that a source gives until it ends.
pub fn all(source: &Source) -> Vec<Result<Sample, SourceError>> {
    let until = Instant::now() + Duration::from_secs(20);
    let mut seen = Vec::new();
    while Instant::now() < until {
        match source.next() {
            Seen::Sample(sample) => seen.push(Ok(*sample)),
            Seen::Bad(error) => seen.push(Err(error)),
            Seen::Nothing => std::thread::sleep(Duration::from_millis(2)),
            Seen::End => return seen,
        }
    }
    panic!("the source does not end")
}

pub fn person() -> Vec<Sample> {
    let acts = [Act::Show(Shape::Pinch)];
    made_up(4, Mount::DEFAULT, 0.03, &acts, 110.0)
}

/// A frame of a hand in the middle of what a person does.
pub fn shown() -> HandFrame {
    let mut hands = person().into_iter().filter_map(|s| match s {
        Sample::Hand(frame) => Some(frame),
        Sample::Nothing(_) => None,
    });
    hands.nth(100).unwrap()
}

/// A frame as the Leap Motion's service sends it, version 6.
pub fn leap_json(sample: &Sample) -> Value {
    let frame = match sample {
        Sample::Nothing(time) => {
            return json!({"id": 1, "timestamp": time, "hands": [], "pointables": [],
                "currentFrameRate": 110.0});
        }
        Sample::Hand(frame) => frame,
    };
    let side = format!("{:?}", frame.side).to_lowercase();
    let fingers = frame.fingers.iter().flatten().enumerate();
    let pointables: Vec<Value> = fingers
        .map(|(i, f)| {
            json!({"id": 70 + i, "handId": 7, "type": i, "tool": false, "extended": true,
                "tipPosition": f.tip, "mcpPosition": f.knuckle, "pipPosition": f.middle,
                "dipPosition": f.tip, "carpPosition": f.knuckle, "length": 50.0})
        })
        .collect();
    json!({"id": 1, "timestamp": frame.time, "currentFrameRate": 110.0,
        "hands": [{"id": 7, "type": side, "palmPosition": frame.palm,
            "palmVelocity": frame.velocity, "palmNormal": frame.normal,
            "direction": frame.direction, "grabStrength": frame.grab,
            "pinchStrength": frame.pinch, "confidence": frame.confidence,
            "armWidth": 60.0, "timeVisible": 1.0}],
        "pointables": pointables})
}

/// A hand as MediaPipe's Hand Landmarker tells it, seen by a camera of 60 degrees at this distance
/// (m): the joints of a made-up hand, with the outer joints where the line from middle to tip is.
pub fn mediapipe_json(frame: &HandFrame, time: f64, distance: f32) -> Value {
    let mut points = [frame.palm; 21];
    points[0] = vector::sub(frame.palm, vector::scale(frame.direction, 60.0));
    for (i, finger) in frame.fingers.iter().flatten().enumerate() {
        let first = 1 + 4 * i;
        let half = vector::scale(vector::add(finger.middle, finger.tip), 0.5);
        let joints = match i {
            0 => [frame.palm, finger.knuckle, finger.middle, finger.tip],
            _ => [finger.knuckle, finger.middle, half, finger.tip],
        };
        points[first..first + 4].copy_from_slice(&joints);
    }
    // mm about the palm, y up, z towards the camera, to metres, y down, z away from it.
    let world = points.map(|p| {
        let [x, y, z] = vector::sub(p, frame.palm);
        [x * 1e-3, -y * 1e-3, -z * 1e-3]
    });
    let image = world.map(|[x, y, z]| {
        let far = distance + z;
        json!({"x": 0.5 + 0.866 * x / far, "y": 0.5 + 0.866 * (y / far) * 640.0 / 480.0, "z": z})
    });
    json!({"timestamp_ms": time, "width": 640, "height": 480, "hands": [{
        "handedness": format!("{:?}", frame.side), "score": 0.97,
        "landmarks": image, "world_landmarks": world,
    }]})
}
