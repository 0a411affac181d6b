//! What the host says, and what becomes of it on the line.

use deictic_core::board::{Scene, ToUnit};
use deictic_core::gesture::frame::{FINGERS, Finger, HandFrame};
use deictic_core::gesture::line::send;
use deictic_core::gesture::wire::Sample;
use deictic_core::protocol::message::{
    ACTIONS_PART, ENTITIES_PART, ScenePart, SentencePart, VocabularyPart, WORDS_PART,
};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::time::Micros;

use super::Host;
use crate::fuzz::situation;
use crate::fuzz::source::Source;

impl Host {
    pub(super) fn say(&mut self, message: &ToUnit) {
        self.hellos += u32::from(matches!(message, ToUnit::Hello(_)));
        let mut out = Outbox::<2048>::new();
        assert!(self.mouth.send(message, &mut out));
        self.line.extend(out.waiting());
    }

    pub(super) fn say_vocabulary(&mut self) {
        let vocabulary = self.vocabulary.clone();
        for (i, part) in vocabulary.actions().chunks(ACTIONS_PART).enumerate() {
            self.say(&ToUnit::Vocabulary(VocabularyPart {
                fingerprint: vocabulary.fingerprint(),
                parameters: vocabulary.options().iter().skip(1).copied().collect(),
                features: vocabulary.features() as u8,
                stop: vocabulary.stop(),
                total: vocabulary.actions().len() as u8,
                first: (i * ACTIONS_PART) as u8,
                actions: part.iter().copied().collect(),
            }));
        }
    }

    pub(super) fn say_scene(&mut self, source: &mut Source<'_>) {
        let scene: Scene = situation::scene(source, &self.vocabulary);
        self.version += 1 + u32::from(source.small(3));
        let entities = scene.entities();
        for i in 0..entities.len().div_ceil(ENTITIES_PART).max(1) {
            self.say(&ToUnit::Scene(ScenePart {
                version: self.version,
                total: entities.len() as u8,
                first: (i * ENTITIES_PART) as u8,
                entities: entities
                    .iter()
                    .skip(i * ENTITIES_PART)
                    .take(ENTITIES_PART)
                    .cloned()
                    .collect(),
            }));
        }
    }

    pub(super) fn say_sentence(&mut self, source: &mut Source<'_>) {
        let modality = source.small(5);
        let sentence = situation::sentence(source, modality, &self.vocabulary);
        let answers = source
            .flag()
            .then(|| self.newest.wrapping_add(u32::from(source.small(2))));
        let words = sentence.words();
        for i in 0..words.len().div_ceil(WORDS_PART).max(1) {
            self.say(&ToUnit::Sentence(SentencePart {
                modality,
                answers,
                total: words.len() as u8,
                first: (i * WORDS_PART) as u8,
                words: words
                    .iter()
                    .skip(i * WORDS_PART)
                    .take(WORDS_PART)
                    .cloned()
                    .collect(),
            }));
        }
    }

    /// The sensor's line sees a hand for some frames, or nothing.
    pub(super) fn show(&mut self, source: &mut Source<'_>) {
        let mut out = Outbox::<128>::new();
        for _ in 0..1 + source.small(12) {
            self.now = self.now.after(Micros(9_000));
            let time = self.now.0 as u32;
            let sample = match source.byte() {
                0..=200 => Sample::Hand(hand(source, time)),
                _ => Sample::Nothing(time),
            };
            if send(&sample, &mut out).is_ok() {
                self.unit.sense(self.now, out.waiting());
                out.clear();
            }
        }
    }

    /// Changes one byte of what is on the line, leaves one out or doubles it.
    pub(super) fn damage(&mut self, source: &mut Source<'_>) {
        if self.line.is_empty() {
            return;
        }
        let at = (source.word() as usize) % self.line.len();
        match source.small(3) {
            0 => self.line[at] ^= source.byte(),
            1 => drop(self.line.remove(at)),
            _ => self.line.insert(at, source.byte()),
        }
    }
}

/// A hand with its fingers straight or folded, somewhere above the sensor.
fn hand(source: &mut Source<'_>, time: u32) -> HandFrame {
    let mut place = |reach: f32| (f32::from(source.byte()) - 128.0) / 128.0 * reach;
    let palm = [place(200.0), 200.0 + place(100.0), place(200.0)];
    let velocity = [place(500.0), place(500.0), place(500.0)];
    let odd = source.byte();
    let mut fingers = [None; FINGERS];
    for (i, finger) in (0_u8..).zip(&mut fingers) {
        let straight = source.flag();
        let [x, y, z] = palm;
        let side = (f32::from(i) - 2.0) * 20.0;
        let point = |along: f32, down: f32| [x + side, y - down, z - along];
        *finger = (odd != i).then(|| Finger {
            knuckle: point(40.0, 0.0),
            middle: point(80.0, 0.0),
            tip: if straight {
                point(130.0, 0.0)
            } else {
                point(50.0, 30.0)
            },
        });
    }
    HandFrame {
        time,
        confidence: 1.0,
        palm,
        velocity,
        normal: [0.0, -1.0, 0.0],
        direction: [0.0, 0.0, -1.0],
        fingers,
        ..HandFrame::default()
    }
}
