//! Messages over a wire: saying and hearing.

use std::io;
use std::time::{Duration, Instant};

use deictic_core::large::{self, Scene, Sentence, ToHost, ToUnit, Vocabulary};
use deictic_core::protocol::message::{
    ENTITIES_PART, Heartbeat, ScenePart, SentencePart, WORDS_PART,
};
use deictic_core::protocol::seal::Way;
use deictic_core::protocol::stuffing::Outbox;
use deictic_core::time::Micros;

use super::UnitError;
use crate::clock;
use crate::hand::meaning::HandSetup;
use crate::link::Wire;
use crate::sensor_model::SensorModel;

/// One open wire with its sequence numbers.
pub struct Conversation {
    pub(super) wire: Box<dyn Wire>,
    pub(super) link: Box<large::Link>,
    began: Instant,
    heard_at: Instant,
    /// Messages that came while something else was waited for.
    pub(super) pending: Vec<(ToHost, u16)>,
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
}

/// A count that the vocabulary's and scene's own bounds keep below 256.
pub(super) fn small(count: usize) -> u8 {
    u8::try_from(count).unwrap_or(u8::MAX)
}
