//! A unit with a key, and a host that may have it.

use deictic_core::board::{Link, ToHost, ToUnit, Unit};
use deictic_core::protocol::message::{
    ACTIONS_PART, Configuration, ENTITIES_PART, Hello, Proof, ScenePart, SentencePart,
    VocabularyPart,
};
use deictic_core::protocol::seal::{KEY, Key, Nonces, Way};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::sentence::LANGUAGE;
use deictic_core::time::Micros;

use crate::common::*;

pub const NOW: Micros = Micros(1_000_000);

pub fn key(byte: u8) -> Key {
    Key::new(&[byte; KEY]).unwrap()
}

/// A host, and all that it has said.
pub struct Host {
    pub link: Link,
    pub said: Vec<Vec<u8>>,
}

impl Host {
    pub fn new(key: Option<Key>) -> Self {
        let mut link = Link::new();
        if let Some(key) = key {
            link.lock(key, Way::ToUnit);
        }
        let said = Vec::new();
        Self { link, said }
    }

    pub fn say(&mut self, unit: &mut Unit, message: &ToUnit) -> Vec<ToHost> {
        let mut out = Outbox::<512>::new();
        assert!(self.link.send(message, &mut out));
        self.said.push(out.waiting().to_vec());
        unit.receive(NOW, out.waiting());
        self.hear(&listen(unit))
    }

    pub fn hear(&mut self, bytes: &[u8]) -> Vec<ToHost> {
        let each = bytes.iter();
        each.filter_map(|b| self.link.receive(*b).map(|r| r.message))
            .collect()
    }

    pub fn greet(&mut self, unit: &mut Unit) -> Vec<ToHost> {
        self.link.shut();
        let (version, schema) = (VERSION, SCHEMA);
        let hello = Hello {
            version,
            schema,
            boot: 3,
            capacities: Unit::capacities(),
        };
        self.say(unit, &ToUnit::Hello(hello))
    }

    /// Opens a sealed conversation.
    pub fn open(&mut self, unit: &mut Unit, key: &Key, nonce: u64) -> Vec<ToHost> {
        let heard = self.greet(unit);
        let [ToHost::Hello(_), ToHost::Challenge(challenge)] = heard[..] else {
            panic!("{heard:?}");
        };
        let nonces = Nonces {
            unit: challenge,
            host: nonce,
        };
        let proof = key.clone().proof(nonces);
        let mut out = Outbox::<512>::new();
        assert!(
            self.link
                .send(&ToUnit::Prove(Proof { nonce, proof }), &mut out)
        );
        self.link.seal(nonces);
        self.said.push(out.waiting().to_vec());
        unit.receive(NOW, out.waiting());
        self.hear(&listen(unit))
    }

    /// Everything up to a decision.
    pub fn command(&mut self, unit: &mut Unit) -> Vec<ToHost> {
        let v = vocabulary();
        for (i, actions) in v.actions().chunks(ACTIONS_PART).enumerate() {
            let part = VocabularyPart {
                fingerprint: v.fingerprint(),
                parameters: v.options().iter().skip(1).copied().collect(),
                features: v.features() as u8,
                stop: v.stop(),
                total: v.actions().len() as u8,
                first: (i * ACTIONS_PART) as u8,
                actions: actions.iter().copied().collect(),
            };
            self.say(unit, &ToUnit::Vocabulary(part));
        }
        for (i, things) in things().chunks(ENTITIES_PART).enumerate() {
            let part = ScenePart {
                version: 1,
                total: 4,
                first: (i * ENTITIES_PART) as u8,
                entities: things.iter().cloned().collect(),
            };
            self.say(unit, &ToUnit::Scene(part));
        }
        let configuration = Configuration {
            expected: 1 << LANGUAGE,
            ..Configuration::DEFAULT
        };
        self.say(unit, &ToUnit::Configure(configuration));
        let said = command(LANGUAGE, MOVE_UP, None, None);
        self.say(
            unit,
            &ToUnit::Sentence(SentencePart {
                modality: LANGUAGE,
                answers: None,
                total: 1,
                first: 0,
                words: said.words().iter().cloned().collect(),
            }),
        )
    }
}

pub fn listen(unit: &mut Unit) -> Vec<u8> {
    let bytes = unit.outgoing().to_vec();
    unit.sent(bytes.len());
    bytes
}

pub fn locked() -> Unit {
    let mut unit = Unit::new(77);
    unit.lock(key(1));
    unit
}

pub fn decides(heard: &[ToHost]) -> bool {
    heard.iter().any(|m| matches!(m, ToHost::Decision(_)))
}
