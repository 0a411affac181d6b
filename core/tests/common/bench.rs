//! A host and a unit with a link between them, and what the host says to load the tabletop.
#![allow(dead_code, reason = "every test uses a part of it")]

use deictic_core::board::{Sentence, ToHost, ToUnit, Unit, Word};
use deictic_core::protocol::link::Link;
use deictic_core::protocol::message::*;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::time::Micros;

use super::common::*;

/// A host and a unit, with a clock of their own between them.
pub struct Bench {
    pub unit: Unit,
    pub link: Link<256>,
    pub now: Micros,
}

impl Bench {
    pub fn new() -> Self {
        Self {
            unit: Unit::new(42),
            link: Link::new(),
            now: Micros(0),
        }
    }

    /// A unit that knows the tabletop.
    pub fn ready() -> Self {
        let mut bench = Self::new();
        bench.say(&hello());
        for part in vocabulary_parts() {
            bench.say(&part);
        }
        let heard = bench.all(scene_parts(1));
        assert_eq!(heard, [ToHost::Loaded(Loaded::Scene(1))]);
        bench
    }

    pub fn frame(&mut self, message: &ToUnit) -> Vec<u8> {
        let mut out = Outbox::<2048>::new();
        assert!(self.link.send(message, &mut out));
        out.waiting().to_vec()
    }

    pub fn say(&mut self, message: &ToUnit) -> Vec<ToHost> {
        let bytes = self.frame(message);
        self.bytes(&bytes)
    }

    pub fn bytes(&mut self, bytes: &[u8]) -> Vec<ToHost> {
        self.unit.receive(self.now, bytes);
        self.heard()
    }

    pub fn wait(&mut self, ms: u64) -> Vec<ToHost> {
        self.now = self.now.after(Micros::from_millis(ms));
        self.unit.poll(self.now);
        self.heard()
    }

    pub fn heard(&mut self) -> Vec<ToHost> {
        let bytes = self.unit.outgoing().to_vec();
        self.unit.sent(bytes.len());
        let mut messages = Vec::new();
        let mut ear = Link::<4096>::new();
        for byte in bytes {
            // A fresh ear each time takes any sequence number up to the half of all.
            messages.extend(ear.receive::<ToHost>(byte).map(|r| r.message));
        }
        messages
    }

    pub fn all(&mut self, messages: Vec<ToUnit>) -> Vec<ToHost> {
        messages
            .iter()
            .flat_map(|message| self.say(message))
            .collect()
    }

    pub fn tell(&mut self, sentence: &Sentence) -> Vec<ToHost> {
        self.all(sentence_parts(sentence, None))
    }

    pub fn decision(&mut self, sentence: Sentence) -> Option<Decided<8>> {
        let heard = self.tell(&sentence);
        heard.into_iter().find_map(|m| match m {
            ToHost::Decision(d) => Some(d),
            _ => None,
        })
    }
}

pub fn hello() -> ToUnit {
    let capacities = Unit::capacities();
    ToUnit::Hello(Hello {
        version: VERSION,
        schema: SCHEMA,
        boot: 1,
        capacities,
    })
}

pub fn vocabulary_parts() -> Vec<ToUnit> {
    let vocabulary = vocabulary();
    let total = vocabulary.actions().len() as u8;
    let part = |(i, actions): (usize, &[_])| {
        ToUnit::Vocabulary(VocabularyPart {
            fingerprint: vocabulary.fingerprint(),
            parameters: vocabulary.options()[1..].iter().copied().collect(),
            features: vocabulary.features() as u8,
            stop: vocabulary.stop(),
            total,
            first: (i * ACTIONS_PART) as u8,
            actions: actions.iter().copied().collect(),
        })
    };
    vocabulary
        .actions()
        .chunks(ACTIONS_PART)
        .enumerate()
        .map(part)
        .collect()
}

pub fn scene_parts(version: u32) -> Vec<ToUnit> {
    let part = |(i, entities): (usize, &[deictic_core::board::Entity])| {
        ToUnit::Scene(ScenePart {
            version,
            total: 4,
            first: (i * ENTITIES_PART) as u8,
            entities: entities.iter().cloned().collect(),
        })
    };
    things()
        .chunks(ENTITIES_PART)
        .enumerate()
        .map(part)
        .collect()
}

pub fn sentence_parts(sentence: &Sentence, answers: Option<u32>) -> Vec<ToUnit> {
    let part = |(i, words): (usize, &[Word])| {
        ToUnit::Sentence(SentencePart {
            modality: sentence.modality(),
            answers,
            total: sentence.words().len() as u8,
            first: (i * WORDS_PART) as u8,
            words: words.iter().cloned().collect(),
        })
    };
    sentence
        .words()
        .chunks(WORDS_PART)
        .enumerate()
        .map(part)
        .collect()
}

pub fn faults(messages: &[ToHost]) -> Vec<Fault> {
    messages
        .iter()
        .filter_map(|m| match m {
            ToHost::Fault(fault) => Some(*fault),
            _ => None,
        })
        .collect()
}
