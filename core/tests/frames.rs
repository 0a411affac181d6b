//! The bits of every message, held to `tests/expected/frames-v1.txt`, and the digest of them that
//! both ends exchange. `BLESS=1 cargo test -p deictic-core --test frames` writes the file anew.

mod common;
#[path = "common/to_host.rs"]
mod to_host;
#[path = "common/to_unit.rs"]
mod to_unit;

use deictic_core::board::{ToHost, ToUnit, Word};
use deictic_core::category::Category;
use deictic_core::gesture::frame::Side;
use deictic_core::gesture::mapping::Gesture;
use deictic_core::protocol::hand::*;
use deictic_core::protocol::link::{Link, Opening};
use deictic_core::protocol::message::*;
use deictic_core::protocol::seal::TAG;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::sentence::LANGUAGE;
use serde::{Serialize, de::DeserializeOwned};
use to_host::to_host;
use to_unit::to_unit;

const GOLDEN: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../tests/expected/frames-v1.txt"
);

fn frame(message: &(impl Serialize + Opening)) -> Vec<u8> {
    let mut link = Link::<256>::new();
    let mut out = Outbox::<300>::new();
    assert!(link.send(message, &mut out), "a message does not fit");
    // A seal takes room for its tag in the receiver's buffer; stuffing adds two bytes and one for every 254.
    assert!(out.waiting().len() <= 256 - TAG, "no room for a tag");
    out.waiting().to_vec()
}

fn read<M: DeserializeOwned + Opening>(bytes: &[u8]) -> Option<M> {
    let mut link = Link::<256>::new();
    bytes
        .iter()
        .fold(None, |got, b| link.receive(*b).map(|r| r.message).or(got))
}

#[test]
fn every_message_has_its_golden_bits() {
    let mut text = String::new();
    let mut add = |name: &str, frame: Vec<u8>| {
        let hex: String = frame.iter().map(|b| format!("{b:02x}")).collect();
        text += &format!("{name} {hex}\n");
    };
    for (name, message) in to_unit() {
        add(name, frame(&message));
    }
    for (name, message) in to_host() {
        add(name, frame(&message));
    }
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(GOLDEN, &text).expect("the golden file can be written");
    }
    let golden = std::fs::read_to_string(GOLDEN).expect("tests/expected/frames-v1.txt is there");
    for (ours, theirs) in text.lines().zip(golden.lines()) {
        assert_eq!(
            ours, theirs,
            "a message has changed its form: raise VERSION, then bless"
        );
    }
    assert_eq!(text.lines().count(), golden.lines().count());
    let digest = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(golden.as_bytes());
    assert_eq!(SCHEMA, digest, "SCHEMA must be {digest:#010x}");
    assert_eq!(VERSION, 1);
}

#[test]
fn every_golden_frame_is_read_back_by_its_size_of_build_and_a_larger_one() {
    for (name, message) in to_unit() {
        let bytes = frame(&message);
        assert_eq!(read::<ToUnit>(&bytes), Some(message), "{name}");
        assert!(
            read::<deictic_core::large::ToUnit>(&bytes).is_some(),
            "{name}"
        );
    }
    for (name, message) in to_host() {
        let bytes = frame(&message);
        assert_eq!(read::<ToHost>(&bytes), Some(message), "{name}");
        assert!(
            read::<deictic_core::large::ToHost>(&bytes).is_some(),
            "{name}"
        );
    }
}

#[test]
fn the_largest_messages_fit_a_boards_frame() {
    let full = Word::new(&[0.125; 8], &[1.0; 16])
        .unwrap()
        .with_quantity(1.0);
    let words = [full.clone(), full].into_iter().collect();
    frame(&ToUnit::Sentence(SentencePart {
        modality: LANGUAGE,
        answers: Some(u32::MAX),
        total: u8::MAX,
        first: u8::MAX,
        words,
    }));
    let all = || [1.0; 16].into_iter().collect();
    frame(&ToHost::WhyActions(WhyActions {
        number: u32::MAX,
        heard: all(),
        alpha: all(),
        beta: all(),
    }));
    let all = || {
        let guess = |number| Guess { number, p: 1.0 };
        (0..8).map(guess).collect()
    };
    let glimpse = Glimpse {
        category: Category::STORAGE,
        option: u8::MAX,
        likelihood: 1.0,
    };
    frame(&ToHost::Hand(HandView {
        hand: Some(Side::Right),
        shown: Some(8),
        strokes: all(),
        pointed: all(),
        words: core::iter::repeat_n(glimpse, 8).collect(),
        ..HandView::default()
    }));
    let gesture = Gesture::Stroke(u8::MAX);
    let action = u8::MAX;
    let meanings = core::iter::repeat_n(Meaning { gesture, action }, MEANINGS);
    frame(&ToUnit::Meanings(meanings.collect()));
}
