//! Hand sensors at this machine, against servers and files of the documented forms.

#[path = "common/sensed.rs"]
mod sensed;

use std::io::Write;
use std::net::TcpListener;

use deictic::hand::source::recording::{self, Recorder};
use deictic::hand::source::{SourceError, leap, mediapipe};
use deictic_core::gesture::frame::HandFrame;
use deictic_core::gesture::shape::{self, Shape};
use deictic_core::gesture::shape_table::NETWORK;
use deictic_core::gesture::vector;
use deictic_core::gesture::wire::{Sample, WireError};
use sensed::{all, leap_json, mediapipe_json, open, person, shown};
use serde_json::json;
use tungstenite::Message;

fn near(a: &HandFrame, b: &HandFrame) -> bool {
    let joints = |f: &HandFrame| {
        let fingers = f.fingers.iter().flatten();
        let joints = fingers.flat_map(|f| [f.knuckle, f.middle, f.tip]);
        joints.chain([f.palm]).collect::<Vec<_>>()
    };
    let far = joints(a).into_iter().zip(joints(b));
    a.side == b.side
        && a.time == b.time
        && far.into_iter().all(|(a, b)| vector::distance(a, b) < 0.05)
}

#[test]
fn the_leap_motions_service_is_read() {
    let samples = person();
    let messages: Vec<String> = samples.iter().map(|s| leap_json(s).to_string()).collect();
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    let service = std::thread::spawn(move || {
        let (stream, _) = listener.accept().unwrap();
        let mut socket = tungstenite::accept(stream).unwrap();
        let version = r#"{"serviceVersion":"2.3.1+33747","version":6}"#;
        socket.send(Message::text(version)).unwrap();
        let said: Vec<String> = (0..2)
            .map(|_| socket.read().unwrap().into_text().unwrap().to_string())
            .collect();
        let event = r#"{"event":{"type":"deviceEvent","state":{"attached":true}}}"#;
        socket.send(Message::text(event)).unwrap();
        for message in messages {
            socket.send(Message::text(message)).unwrap();
        }
        socket.send(Message::text("{\"hands\": 3}")).unwrap();
        socket.close(None).unwrap();
        // The closing handshake.
        while socket.read().is_ok() {}
        said
    });
    let seen = all(&open(&format!("leap:ws://127.0.0.1:{port}/v6.json")).unwrap());
    let said = service.join().unwrap();
    assert_eq!(
        said,
        [r#"{"enableGestures":false}"#, r#"{"background":true}"#]
    );
    let (good, odd): (Vec<_>, Vec<_>) = seen.into_iter().partition(Result::is_ok);
    assert_eq!(good.len(), samples.len());
    for (got, meant) in good.iter().zip(&samples) {
        let same = match (got, meant) {
            (Ok(Sample::Hand(got)), Sample::Hand(meant)) => near(got, meant),
            (Ok(Sample::Nothing(got)), Sample::Nothing(meant)) => got == meant,
            _ => false,
        };
        assert!(same, "{got:?} {meant:?}");
    }
    assert!(
        matches!(
            &odd[..],
            [Err(SourceError::Form { .. }), Err(SourceError::LeapGone(_))]
        ),
        "{odd:?}"
    );
}

#[test]
fn a_service_that_is_not_there_is_named() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    drop(listener);
    let url = format!("leap:ws://127.0.0.1:{port}/v6.json");
    let error = open(&url).err().unwrap();
    assert!(error.to_string().contains(&port.to_string()), "{error}");
}

#[test]
fn mediapipes_landmarks_are_read_from_a_server() {
    let frames: Vec<HandFrame> = person()
        .into_iter()
        .filter_map(|s| match s {
            Sample::Hand(frame) => Some(frame),
            Sample::Nothing(_) => None,
        })
        .collect();
    // In the middle the hand pinches.
    let shown = frames[frames.len() / 2];
    let lines = format!(
        "{}\n\n{}\nnot json\n{}\n",
        mediapipe_json(&shown, 0.0, 0.5),
        mediapipe_json(&shown, 33.0, 0.5),
        json!({"timestamp_ms": 66.0, "hands": []}),
    );
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    std::thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        stream.write_all(lines.as_bytes()).unwrap();
    });
    let seen = all(&open(&format!("mediapipe:tcp:127.0.0.1:{port}")).unwrap());
    let [
        Ok(Sample::Hand(first)),
        Ok(Sample::Hand(second)),
        Err(odd),
        Ok(Sample::Nothing(66_000)),
    ] = &seen[..]
    else {
        panic!("{seen:?}");
    };
    assert!(matches!(odd, SourceError::Form { number: 4, .. }), "{odd}");
    assert_eq!(first.side, shown.side);
    assert_eq!((first.time, second.time), (0, 33_000));
    assert!((first.palm[2] + 500.0).abs() < 60.0, "{:?}", first.palm);
    assert!(vector::length(second.velocity) < 1.0);
    assert!(
        vector::dot(first.normal, shown.normal) > 0.9,
        "{:?}",
        first.normal
    );
    let p = NETWORK.classify(&shape::features(first).unwrap());
    assert!(p[Shape::Pinch as usize] > 0.5, "{p:?}");
}

#[test]
fn numbers_that_cannot_be_are_named_and_fingers_that_are_missing_are_missing() {
    let bad = |seen: Vec<Result<Sample, SourceError>>| {
        assert!(
            matches!(
                &seen[..],
                [Err(SourceError::Unsound {
                    number: 1,
                    error: WireError::Frame(_)
                })]
            ),
            "{seen:?}"
        );
    };
    let sound = leap_json(&Sample::Hand(shown()));
    for (field, value) in [
        // Beyond what 32-bit floats hold; JSON has no NaN.
        ("palmPosition", json!([1e39, 0, 0])),
        ("palmVelocity", json!([0, -1e39, 0])),
        ("palmNormal", json!([0, 0, 0])),
        ("confidence", json!(2)),
    ] {
        let mut message = sound.clone();
        message["hands"][0][field] = value;
        bad(leap::samples(1, &message.to_string()));
    }
    let mut message = sound.clone();
    message["pointables"][3]["tipPosition"] = json!([9e3, 0, 0]);
    bad(leap::samples(1, &message.to_string()));
    let mut landmarks = mediapipe_json(&shown(), 0.0, 0.5);
    landmarks["hands"][0]["world_landmarks"][8] = json!([1e39, 0, 0]);
    bad(mediapipe::Reader::default().read(landmarks.to_string().as_bytes()));

    // A finger that the sensor does not follow, and a second hand with none.
    let mut message = sound;
    message["pointables"].as_array_mut().unwrap().remove(1);
    let mut other = message["hands"][0].clone();
    other["id"] = json!(8);
    message["hands"].as_array_mut().unwrap().push(other);
    let seen = leap::samples(1, &message.to_string());
    let [Ok(Sample::Hand(first)), Ok(Sample::Hand(second))] = &seen[..] else {
        panic!("{seen:?}");
    };
    let followed = |frame: &HandFrame| frame.fingers.map(|f| f.is_some());
    assert_eq!(followed(first), [true, false, true, true, true]);
    assert_eq!(followed(second), [false; 5]);
}

#[test]
fn a_recording_gives_back_what_was_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pinch.hand");
    let samples: Vec<Sample> = person().into_iter().take(60).collect();
    let mut recorder = Recorder::create(&path).unwrap();
    for sample in &samples {
        recorder.push(sample).unwrap();
    }
    recorder.finish().unwrap();
    assert_eq!(recording::read(&path).unwrap().len(), samples.len());
    let seen = all(&open(&format!("file:{}", path.display())).unwrap());
    assert_eq!(seen.len(), samples.len());

    let mut bytes = std::fs::read(&path).unwrap();
    bytes[200] ^= 4;
    std::fs::write(&path, bytes).unwrap();
    let error = recording::read(&path).unwrap_err();
    assert!(
        matches!(error, SourceError::Unsound { number: 3, .. }),
        "{error}"
    );
    std::fs::write(&path, b"").unwrap();
    assert!(matches!(
        recording::read(&path),
        Err(SourceError::NoRecording(_))
    ));
}

#[test]
fn a_made_up_person_can_only_point_at_what_is_there() {
    let error = open("made-up:1:thumbsup teapot").err().unwrap();
    assert!(error.to_string().contains("teapot"), "{error}");
}
