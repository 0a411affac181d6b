//! A host reduced to its protocol: it says messages over a wire and waits for what it expects.

use std::time::{Duration, Instant};

use deictic_core::board::{Entity, Link, Scene, Sentence, ToHost, ToUnit, Unit, Vocabulary, Word};
use deictic_core::protocol::message::{
    ACTIONS_PART, Configuration, ENTITIES_PART, Hello, Loaded, ScenePart, SentencePart,
    VocabularyPart, WORDS_PART,
};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::time::Micros;

/// How long an emulated board may take on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// Something that carries bytes to a unit and back.
pub trait Wire {
    /// Gives bytes to the unit.
    fn write(&mut self, bytes: &[u8]);
    /// What the unit said, waiting up to `patience` for the first byte.
    fn read(&mut self, patience: Duration) -> Vec<u8>;
}

/// A unit in this process, whose clock is that of this machine.
pub struct Inside {
    unit: Box<Unit>,
    start: Instant,
}

impl Default for Inside {
    fn default() -> Self {
        Self {
            unit: Box::new(Unit::new(1)),
            start: Instant::now(),
        }
    }
}

impl Inside {
    fn now(&self) -> Micros {
        Micros(u64::try_from(self.start.elapsed().as_micros()).unwrap_or(u64::MAX))
    }
}

impl Wire for Inside {
    fn write(&mut self, bytes: &[u8]) {
        let now = self.now();
        self.unit.receive(now, bytes);
    }

    fn read(&mut self, patience: Duration) -> Vec<u8> {
        let patience = Instant::now() + patience;
        loop {
            let now = self.now();
            self.unit.poll(now);
            let bytes = self.unit.outgoing().to_vec();
            self.unit.sent(bytes.len());
            if !bytes.is_empty() || Instant::now() >= patience {
                return bytes;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

/// One end of a conversation with a unit.
pub struct Host<W> {
    /// The wire to the unit.
    pub wire: W,
    link: Link,
    heard: Vec<ToHost>,
}

impl<W: Wire> Host<W> {
    /// A host that has not said anything.
    pub fn new(wire: W) -> Self {
        Self {
            wire,
            link: Link::new(),
            heard: Vec::new(),
        }
    }

    /// Says one message.
    ///
    /// # Panics
    /// When the message does not fit a frame.
    pub fn say(&mut self, message: &ToUnit) {
        let frame = self.frame(message);
        self.wire.write(&frame);
    }

    /// The frame that the next message would be, which counts as said.
    ///
    /// # Panics
    /// When the message does not fit a frame.
    pub fn frame(&mut self, message: &ToUnit) -> Vec<u8> {
        let mut out = Outbox::<2048>::new();
        assert!(
            self.link.send(message, &mut out),
            "{message:?} does not fit"
        );
        out.waiting().to_vec()
    }

    /// Waits for the first message that `wanted` takes, and gives what it makes of it. Messages
    /// before it are dropped.
    ///
    /// # Panics
    /// When none comes in time.
    pub fn wait_for<T>(&mut self, wanted: impl Fn(&ToHost) -> Option<T>) -> T {
        let patience = Instant::now() + PATIENCE;
        loop {
            while !self.heard.is_empty() {
                if let Some(found) = wanted(&self.heard.remove(0)) {
                    return found;
                }
            }
            assert!(
                Instant::now() < patience,
                "the unit does not say what was expected"
            );
            for byte in self.wire.read(Duration::from_millis(100)) {
                self.heard
                    .extend(self.link.receive(byte).map(|r| r.message));
            }
        }
    }

    /// Takes what the unit has said, to be looked at later.
    pub fn hear(&mut self) {
        for byte in self.wire.read(Duration::ZERO) {
            self.heard
                .extend(self.link.receive(byte).map(|r| r.message));
        }
    }

    /// What the unit has said that nobody has looked at.
    pub fn heard(&mut self) -> Vec<ToHost> {
        self.hear();
        std::mem::take(&mut self.heard)
    }

    /// Opens the conversation and gives the unit's Hello.
    pub fn hello(&mut self) -> Hello {
        let capacities = Unit::capacities();
        self.say(&ToUnit::Hello(Hello {
            version: VERSION,
            schema: SCHEMA,
            boot: 1,
            capacities,
        }));
        self.wait_for(|m| match m {
            ToHost::Hello(hello) => Some(*hello),
            _ => None,
        })
    }

    /// Loads a vocabulary, part by part.
    pub fn load_vocabulary(&mut self, vocabulary: &Vocabulary) {
        let fingerprint = vocabulary.fingerprint();
        for (i, actions) in vocabulary.actions().chunks(ACTIONS_PART).enumerate() {
            self.say(&ToUnit::Vocabulary(VocabularyPart {
                fingerprint,
                parameters: vocabulary.options().iter().skip(1).copied().collect(),
                features: u8::try_from(vocabulary.features()).expect("at most 32 features"),
                stop: vocabulary.stop(),
                total: u8::try_from(vocabulary.actions().len()).expect("at most 64 actions"),
                first: u8::try_from(i * ACTIONS_PART).expect("at most 64 actions"),
                actions: actions.iter().copied().collect(),
            }));
        }
        self.wait_for(|m| (*m == ToHost::Loaded(Loaded::Vocabulary(fingerprint))).then_some(()));
    }

    /// Loads the things of a scene under a version, part by part.
    pub fn load_scene(&mut self, version: u32, scene: &Scene) {
        let total = u8::try_from(scene.entities().len()).expect("at most 128 things");
        let mut parts: Vec<&[Entity]> = scene.entities().chunks(ENTITIES_PART).collect();
        if parts.is_empty() {
            parts.push(&[]);
        }
        for (i, entities) in parts.into_iter().enumerate() {
            self.say(&ToUnit::Scene(ScenePart {
                version,
                total,
                first: u8::try_from(i * ENTITIES_PART).expect("at most 128 things"),
                entities: entities.iter().cloned().collect(),
            }));
        }
        self.wait_for(|m| (*m == ToHost::Loaded(Loaded::Scene(version))).then_some(()));
    }

    /// Says a sentence, part by part.
    ///
    /// # Panics
    /// When a part does not fit a frame.
    pub fn tell(&mut self, sentence: &Sentence) {
        for part in sentence_parts(sentence) {
            self.say(&part);
        }
    }

    /// Sets how to decide.
    pub fn configure(&mut self, configuration: Configuration) {
        self.say(&ToUnit::Configure(configuration));
        self.wait_for(|m| (*m == ToHost::Loaded(Loaded::Configuration)).then_some(()));
    }
}

/// The messages that a sentence is said with.
///
/// # Panics
/// Never: a sentence has fewer than 256 words.
#[must_use]
pub fn sentence_parts(sentence: &Sentence) -> Vec<ToUnit> {
    let small = |n: usize| u8::try_from(n).expect("fewer than 256 words");
    let part = |(i, words): (usize, &[Word])| {
        ToUnit::Sentence(SentencePart {
            modality: sentence.modality(),
            answers: None,
            total: small(sentence.words().len()),
            first: small(i * WORDS_PART),
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
