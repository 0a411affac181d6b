//! The Leap Motion's service: frames as JSON over a WebSocket, version 6 of its protocol
//! (developer-archive.leapmotion.com, supplement "Leap Motion JSON").
//!
//! A hand has its palm, and fingers that name it by `handId` and themselves by `type`, 0 the thumb.
//! Coordinates are the service's own: mm, x right, y up, z towards the person, as the core's.

use std::time::Duration;

use deictic_core::gesture::frame::{Finger, HandFrame, Side};
use deictic_core::gesture::wire::{Sample, encode};
use serde::Deserialize;
use serde_json::Value;
use tungstenite::stream::MaybeTlsStream;
use tungstenite::{Message, connect};

use super::{Out, Source, SourceError};

/// Where the service listens.
pub const URL: &str = "ws://127.0.0.1:6437/v6.json";

/// A service that sends nothing for this long has hung up: it sends frames without hands too.
const PATIENCE: Duration = Duration::from_secs(5);

/// What a client says first: no gestures of the service's own, but frames even though this program
/// has no window in front.
const OPENING: [&str; 2] = [r#"{"enableGestures":false}"#, r#"{"background":true}"#];

#[derive(Deserialize)]
struct Frame {
    /// us
    timestamp: f64,
    hands: Vec<Hand>,
    #[serde(default)]
    pointables: Vec<Pointable>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Hand {
    id: i64,
    #[serde(rename = "type")]
    side: String,
    palm_position: [f32; 3],
    palm_velocity: [f32; 3],
    palm_normal: [f32; 3],
    direction: [f32; 3],
    #[serde(default)]
    grab_strength: f32,
    #[serde(default)]
    pinch_strength: f32,
    #[serde(default = "sure")]
    confidence: f32,
}

fn sure() -> f32 {
    1.0
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Pointable {
    hand_id: i64,
    /// Which finger; a tool has none.
    #[serde(rename = "type")]
    finger: Option<usize>,
    mcp_position: Option<[f32; 3]>,
    pip_position: Option<[f32; 3]>,
    tip_position: [f32; 3],
}

/// Connects to the service.
///
/// # Errors
/// [`SourceError::Leap`]
pub fn open(url: &str) -> Result<Source, SourceError> {
    let refused = |why: String| SourceError::Leap {
        url: url.to_owned(),
        why,
    };
    let (mut socket, _) = connect(url).map_err(|e| refused(e.to_string()))?;
    if let MaybeTlsStream::Plain(stream) = socket.get_ref() {
        let set = stream.set_read_timeout(Some(PATIENCE));
        set.map_err(|e| refused(e.to_string()))?;
    }
    for text in OPENING {
        let said = socket.send(Message::text(text));
        said.map_err(|e| refused(e.to_string()))?;
    }
    Ok(Source::running(move |out| {
        for number in 1.. {
            let done = match socket.read() {
                Ok(Message::Text(text)) => forward(number, text.as_str(), out),
                Ok(Message::Close(_)) => Err("it said goodbye".to_owned()),
                Ok(_) => Ok(()),
                Err(error) => Err(error.to_string()),
            };
            if let Err(why) = done {
                // Nobody may be listening any more, which is why it ended then.
                let _ = out.send(Err(SourceError::LeapGone(why)));
                return;
            }
        }
    }))
}

/// Sends what a message holds; an error when nobody listens any more.
fn forward(number: u64, text: &str, out: &Out) -> Result<(), String> {
    for sample in samples(number, text) {
        out.send(sample).map_err(|_| "nobody listens".to_owned())?;
    }
    Ok(())
}

/// The samples of one message: one per hand, one that there is none, or nothing for a message that
/// is no frame.
pub fn samples(number: u64, text: &str) -> Vec<Result<Sample, SourceError>> {
    let form = |why: serde_json::Error| {
        let why = why.to_string();
        vec![Err(SourceError::Form { number, why })]
    };
    let value: Value = match serde_json::from_str(text) {
        Ok(value) => value,
        Err(why) => return form(why),
    };
    // The version's announcement and events of devices have no hands.
    if value.get("hands").is_none() {
        return Vec::new();
    }
    let frame: Frame = match serde_json::from_value(value) {
        Ok(frame) => frame,
        Err(why) => return form(why),
    };
    let time = frame.timestamp as u64 as u32;
    if frame.hands.is_empty() {
        return vec![Ok(Sample::Nothing(time))];
    }
    let hands = frame.hands.iter();
    hands
        .map(|hand| {
            let sample = Sample::Hand(followed(time, hand, &frame.pointables));
            match encode(&sample) {
                Ok(_) => Ok(sample),
                Err(error) => Err(SourceError::Unsound { number, error }),
            }
        })
        .collect()
}

fn followed(time: u32, hand: &Hand, pointables: &[Pointable]) -> HandFrame {
    let mut fingers = [None; 5];
    for pointable in pointables.iter().filter(|p| p.hand_id == hand.id) {
        let place = pointable.finger.and_then(|finger| fingers.get_mut(finger));
        if let (Some(place), Some(knuckle), Some(middle)) =
            (place, pointable.mcp_position, pointable.pip_position)
        {
            *place = Some(Finger {
                knuckle,
                middle,
                tip: pointable.tip_position,
            });
        }
    }
    HandFrame {
        time,
        side: if hand.side == "left" {
            Side::Left
        } else {
            Side::Right
        },
        confidence: hand.confidence,
        grab: hand.grab_strength,
        pinch: hand.pinch_strength,
        palm: hand.palm_position,
        velocity: hand.palm_velocity,
        normal: hand.palm_normal,
        direction: hand.direction,
        fingers,
    }
}
