//! Messages over a wire: saying, hearing, and loading a unit from the beginning.

use std::io;
use std::time::{Duration, Instant};

use deictic_core::large::{self, Scene, Sentence, ToHost, ToUnit, Vocabulary};
use deictic_core::protocol::message::{
    ACTIONS_PART, Capacities, Configuration, ENTITIES_PART, Fault, Heartbeat, Hello, Loaded, Proof,
    ScenePart, SentencePart, VocabularyPart, WORDS_PART,
};
use deictic_core::protocol::seal::{Nonces, Way};
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::protocol::{SCHEMA, VERSION};
use deictic_core::time::Micros;

use super::{PATIENCE, UnitError};
use crate::clock;
use crate::hand::meaning::HandSetup;
use crate::link::Wire;
use crate::sensor_model::SensorModel;

/// How often an unanswered Hello is said again: a board may be in the middle of starting.
const AGAIN: Duration = Duration::from_millis(500);

/// How often loading begins anew at most.
const ATTEMPTS: usize = 3;

/// One open wire with its sequence numbers.
pub struct Conversation {
    wire: Box<dyn Wire>,
    link: Box<large::Link>,
    began: Instant,
    heard_at: Instant,
    /// Messages that came while something else was waited for.
    pending: Vec<(ToHost, u16)>,
    /// What is said in one piece, while it is being put together.
    gathered: Option<Vec<u8>>,
}

impl Conversation {
    /// Nothing has been said.
    pub fn new(wire: Box<dyn Wire>) -> Self {
        let now = clock::now();
        let mut link = Box::<large::Link>::default();
        if let Some(key) = wire.key() {
            link.lock(key, Way::ToUnit);
        }
        Self {
            wire,
            link,
            began: now,
            heard_at: now,
            pending: Vec::new(),
            gathered: None,
        }
    }

    /// Says in one piece what `act` says, so that the unit hears it at one moment, however slow this machine is.
    pub fn together(
        &mut self,
        act: impl FnOnce(&mut Self) -> Result<(), UnitError>,
    ) -> Result<(), UnitError> {
        self.gathered = Some(Vec::new());
        let said = act(self);
        let gathered = self.gathered.take().unwrap_or_default();
        said?;
        self.wire.write(&gathered).map_err(UnitError::Broken)
    }

    /// For how long nothing was heard.
    pub fn silence(&self) -> Duration {
        clock::since(self.heard_at)
    }

    /// Says a message.
    pub fn say(&mut self, message: &ToUnit) -> Result<(), UnitError> {
        let mut out = Outbox::<8192>::new();
        if !self.link.send(message, &mut out) {
            return Err(UnitError::Broken(io::Error::other(
                "a message does not fit a frame",
            )));
        }
        match &mut self.gathered {
            Some(gathered) => {
                gathered.extend_from_slice(out.waiting());
                Ok(())
            }
            None => self.wire.write(out.waiting()).map_err(UnitError::Broken),
        }
    }

    /// Shows that the host lives.
    pub fn beat(&mut self, vocabulary: &Vocabulary, scene: &Scene) -> Result<(), UnitError> {
        let now = Micros(u64::try_from(clock::since(self.began).as_micros()).unwrap_or(u64::MAX));
        let (vocabulary, scene) = (vocabulary.fingerprint(), scene.version());
        self.say(&ToUnit::Heartbeat(Heartbeat {
            now,
            vocabulary,
            scene,
        }))
    }

    /// What was heard, each with how many frames before it were lost, waiting up to `patience`.
    pub fn hear(&mut self, patience: Duration) -> Result<Vec<(ToHost, u16)>, UnitError> {
        if !self.pending.is_empty() {
            return Ok(std::mem::take(&mut self.pending));
        }
        let mut buffer = [0; 4096];
        let n = self
            .wire
            .read(&mut buffer, patience)
            .map_err(UnitError::Broken)?;
        let mut heard = Vec::new();
        for &byte in buffer.iter().take(n) {
            heard.extend(self.link.receive(byte).map(|r| (r.message, r.missed)));
        }
        if !heard.is_empty() {
            self.heard_at = clock::now();
        }
        Ok(heard)
    }

    /// Opens the conversation and loads everything.
    pub fn load(
        &mut self,
        vocabulary: &Vocabulary,
        scene: &Scene,
        configuration: &Configuration,
    ) -> Result<Hello, UnitError> {
        // A unit that was still starting answers every Hello that was said meanwhile, and each of
        // them empties it.
        for _ in 0..ATTEMPTS {
            self.pending.clear();
            let hello = self.greet()?;
            if !self.prove()? {
                continue;
            }
            check_capacities(&hello.capacities, vocabulary, scene)?;
            self.say_vocabulary(vocabulary)?;
            if !self.is_loaded(Loaded::Vocabulary(vocabulary.fingerprint()))? {
                continue;
            }
            self.say_scene(scene)?;
            if !self.is_loaded(Loaded::Scene(scene.version()))? {
                continue;
            }
            self.say(&ToUnit::Configure(*configuration))?;
            if self.is_loaded(Loaded::Configuration)? {
                return Ok(hello);
            }
        }
        Err(UnitError::NoAnswer)
    }

    fn greet(&mut self) -> Result<Hello, UnitError> {
        let ours = Hello {
            version: VERSION,
            schema: SCHEMA,
            boot: std::process::id(),
            capacities: large::Unit::capacities(),
        };
        self.link.shut();
        // Ends whatever half a frame the unit may have heard of an earlier host.
        self.wire.write(&[0]).map_err(UnitError::Broken)?;
        let until = clock::now() + PATIENCE;
        while clock::now() < until {
            self.say(&ToUnit::Hello(ours))?;
            let again = clock::now() + AGAIN;
            while let Some(left) = clock::until(again) {
                let mut heard = self.hear(left)?.into_iter();
                while let Some((message, _)) = heard.next() {
                    if let ToHost::Hello(theirs) = message {
                        let (unit, host) = ((theirs.version, theirs.schema), (VERSION, SCHEMA));
                        if unit != host {
                            return Err(UnitError::Schema { unit, host });
                        }
                        // A unit that was late answers all that was asked at once: nothing was loaded in between.
                        let further = heard.filter(|(m, _)| !matches!(m, ToHost::Hello(_)));
                        self.pending = further.collect();
                        return Ok(theirs);
                    }
                }
            }
        }
        Err(UnitError::NoAnswer)
    }

    /// Shows the unit that this end has the key, and has it show the same; nothing to do without one. `false` when it
    /// began anew instead.
    fn prove(&mut self) -> Result<bool, UnitError> {
        let Some(mut key) = self.link.key().cloned() else {
            let is_challenge = |(m, _): &(ToHost, u16)| matches!(m, ToHost::Challenge(_));
            return match self.pending.iter().any(is_challenge) {
                true => Err(UnitError::WantsKey),
                false => Ok(true),
            };
        };
        let until = clock::now() + PATIENCE;
        let mut asked = false;
        while let Some(left) = clock::until(until) {
            for (message, _) in self.hear(left.min(AGAIN))? {
                match message {
                    ToHost::Hello(_) => return Ok(false),
                    ToHost::Challenge(unit) if !asked => {
                        asked = true;
                        let host = getrandom::u64().map_err(|e| {
                            UnitError::Broken(io::Error::other(format!("no random numbers: {e}")))
                        })?;
                        let nonces = Nonces { unit, host };
                        let proof = key.proof(nonces);
                        self.say(&ToUnit::Prove(Proof { nonce: host, proof }))?;
                        self.link.seal(nonces);
                    }
                    ToHost::Proven => return Ok(true),
                    _ => {}
                }
            }
        }
        Err(if asked {
            UnitError::OtherKey
        } else {
            UnitError::NoKey
        })
    }

    fn say_vocabulary(&mut self, vocabulary: &Vocabulary) -> Result<(), UnitError> {
        let actions = vocabulary.actions();
        for (i, part) in actions.chunks(ACTIONS_PART).enumerate() {
            self.say(&ToUnit::Vocabulary(VocabularyPart {
                fingerprint: vocabulary.fingerprint(),
                parameters: vocabulary.options().iter().skip(1).copied().collect(),
                features: small(vocabulary.features()),
                stop: vocabulary.stop(),
                total: small(actions.len()),
                first: small(i * ACTIONS_PART),
                actions: part.iter().copied().collect(),
            }))?;
        }
        Ok(())
    }

    /// Says how to read a hand.
    pub fn say_hand(&mut self, setup: &HandSetup) -> Result<(), UnitError> {
        self.say(&ToUnit::Meanings(setup.meanings.clone()))?;
        self.say(&ToUnit::Hand(setup.settings))?;
        for part in setup.taught.parts() {
            self.say(&ToUnit::Templates(part))?;
        }
        Ok(())
    }

    /// Says what sensors report.
    pub fn say_sensors(&mut self, sensors: &SensorModel) -> Result<(), UnitError> {
        let mut parts = sensors.parts().iter().cloned();
        parts.try_for_each(|part| self.say(&ToUnit::Sensor(part)))
    }

    /// Says a sentence in as many parts as it needs; `answers` is the decision whose question it
    /// answers, if it does.
    pub fn tell(&mut self, sentence: &Sentence, answers: Option<u32>) -> Result<(), UnitError> {
        let words = sentence.words();
        for i in 0..words.len().div_ceil(WORDS_PART).max(1) {
            self.say(&ToUnit::Sentence(SentencePart {
                modality: sentence.modality(),
                answers,
                total: small(words.len()),
                first: small(i * WORDS_PART),
                words: words
                    .iter()
                    .skip(i * WORDS_PART)
                    .take(WORDS_PART)
                    .cloned()
                    .collect(),
            }))?;
        }
        Ok(())
    }

    /// Says a scene in as many parts as it needs.
    pub fn say_scene(&mut self, scene: &Scene) -> Result<(), UnitError> {
        let entities = scene.entities();
        let parts = entities.len().div_ceil(ENTITIES_PART).max(1);
        for i in 0..parts {
            self.say(&ToUnit::Scene(ScenePart {
                version: scene.version(),
                total: small(entities.len()),
                first: small(i * ENTITIES_PART),
                entities: entities
                    .iter()
                    .skip(i * ENTITIES_PART)
                    .take(ENTITIES_PART)
                    .cloned()
                    .collect(),
            }))?;
        }
        Ok(())
    }

    /// Waits for the unit to have taken something over; keeps what else it says for later. `false`
    /// when it opened the conversation anew instead, or did not answer.
    fn is_loaded(&mut self, what: Loaded) -> Result<bool, UnitError> {
        let until = clock::now() + PATIENCE;
        let mut others = std::mem::take(&mut self.pending);
        while let Some(left) = clock::until(until) {
            let mut heard = self.hear(left.min(AGAIN))?.into_iter();
            while let Some((message, missed)) = heard.next() {
                match message {
                    ToHost::Loaded(loaded) if loaded == what => {
                        others.extend(heard);
                        self.pending = others;
                        return Ok(true);
                    }
                    ToHost::Fault(fault) if refuses(&fault, what) => {
                        return Err(UnitError::Refused(fault));
                    }
                    ToHost::Hello(_) => return Ok(false),
                    ToHost::Challenge(_) => return Err(UnitError::WantsKey),
                    other => others.push((other, missed)),
                }
            }
        }
        Ok(false)
    }
}

/// Whether a fault is about what is being loaded, and not about a sentence said before.
fn refuses(fault: &Fault, what: Loaded) -> bool {
    match fault {
        Fault::Vocabulary(_) => matches!(what, Loaded::Vocabulary(_)),
        Fault::Scene(_) | Fault::OldScene { .. } => matches!(what, Loaded::Scene(_)),
        Fault::Configuration(_) => what == Loaded::Configuration,
        Fault::PartOutOfOrder { .. } => what != Loaded::Configuration,
        Fault::NoHello | Fault::NoVocabulary | Fault::HostLost => true,
        _ => false,
    }
}

/// A count that the vocabulary's and scene's own bounds keep below 256.
fn small(count: usize) -> u8 {
    u8::try_from(count).unwrap_or(u8::MAX)
}

fn check_capacities(
    unit: &Capacities,
    vocabulary: &Vocabulary,
    scene: &Scene,
) -> Result<(), UnitError> {
    let most = vocabulary.options().iter().copied().max().unwrap_or(0);
    for (what, capacity, wanted) in [
        ("options in a category", unit.options, usize::from(most)),
        ("categories", unit.categories, vocabulary.options().len()),
        ("features", unit.features, vocabulary.features()),
        ("things in a scene", unit.entities, scene.entities().len()),
    ] {
        if wanted > usize::from(capacity) {
            return Err(UnitError::TooLarge {
                what,
                capacity,
                wanted,
            });
        }
    }
    Ok(())
}
