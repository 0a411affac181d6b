//! What a session tells the unit: what was said, shown, seen and answered.

use std::time::Duration;

use deictic_core::gesture::wire::Sample;
use deictic_core::large::Sentence;
use deictic_core::profile::Profile;
use deictic_core::sentence::LANGUAGE;
use deictic_core::unit::pairing::HAND_PATIENCE;

use super::{PATIENCE, Session, weigh_answers};
use crate::clock;
use crate::hand::meaning::HandSetup;
use crate::sensor_model::SensorModel;
use crate::understanding::is_stop;
use crate::unit::UnitError;

impl Session<'_> {
    /// Tells the unit what a modality observed, at once. A clear stop stops the robot first.
    ///
    /// # Errors
    /// [`UnitError`] when the unit is not there; a stop has been carried out all the same.
    pub fn observe(&mut self, sentence: Sentence) -> Result<(), UnitError> {
        self.observe_together(&[sentence])
    }

    /// Tells the unit what modalities observed at the same time: it decides on all of it at once, even when this machine
    /// is so slow that between two messages the window would have closed.
    ///
    /// # Errors
    /// As [`Session::observe`].
    pub fn observe_together(&mut self, sentences: &[Sentence]) -> Result<(), UnitError> {
        for sentence in sentences {
            if is_stop(sentence, self.lexicon, &self.configuration.profile) {
                self.halt();
                self.stopping = true;
            }
            if sentence.modality() == LANGUAGE {
                self.forbidden = None;
            }
            self.hears(sentence);
            self.spoken.push(sentence.clone());
        }
        // A command ends what was forbidden before it, also for what is shown with it.
        let mut told = sentences.to_vec();
        told.sort_by_key(|sentence| sentence.modality() != LANGUAGE);
        self.unit.observe(&told)?;
        let window = Duration::from_micros(self.configuration.window.0);
        self.due = Some(clock::now() + window + PATIENCE);
        Ok(())
    }

    /// A sentence that is no answer ends the question, and what was said before by the same modality.
    pub(super) fn hears(&mut self, sentence: &Sentence) {
        let modality = sentence.modality();
        if self.question.take().is_some() || self.spoken.iter().any(|s| s.modality() == modality) {
            self.spoken.clear();
        }
    }

    /// Tells the unit how to read a hand.
    ///
    /// # Errors
    /// [`UnitError`] when the unit is not there; it is told when it comes back.
    pub fn set_hand(&mut self, setup: HandSetup) -> Result<(), UnitError> {
        self.unit.set_hand(setup)
    }

    /// As [`GestureUnit::set_sensors`](crate::unit::GestureUnit::set_sensors).
    ///
    /// # Errors
    /// [`UnitError`]; the unit is told when it comes back.
    pub fn set_sensors(&mut self, sensors: SensorModel) -> Result<(), UnitError> {
        self.unit.set_sensors(sensors)
    }

    /// Has the unit decide by another profile from now on: call it when nothing is going on.
    ///
    /// # Errors
    /// [`UnitError`]; the unit is told when it comes back.
    pub fn decide_by(&mut self, mut profile: Profile) -> Result<(), UnitError> {
        weigh_answers(&mut profile);
        if self.configuration.profile == profile {
            return Ok(());
        }
        self.configuration.profile = profile;
        self.unit.configure(self.configuration)
    }

    /// Tells the unit what a hand sensor at this machine saw.
    ///
    /// # Errors
    /// [`UnitError`] when the unit is not there.
    pub fn sense(&mut self, sample: &Sample) -> Result<(), UnitError> {
        self.unit.sense(sample)
    }

    /// Whether a hand is in the middle of something, which a decision waits for.
    pub(super) fn waits_for_hand(&self) -> bool {
        let patience = Duration::from_micros(HAND_PATIENCE.0) + PATIENCE;
        self.showing
            .is_some_and(|since| clock::now() < since + patience)
    }

    /// Tells the unit further sentences one by one, each when the robot is done with the one before.
    /// They are dropped as soon as one of them is not executed to its end.
    pub fn queue(&mut self, sentences: impl IntoIterator<Item = Sentence>) {
        self.queue.extend(sentences);
    }

    /// Takes back what was queued and not begun; what the robot is doing goes on.
    pub fn cancel(&mut self) {
        self.drop_queue();
    }

    /// Tells the unit the answer to its question.
    ///
    /// # Errors
    /// [`UnitError`] when the unit is not there.
    pub fn answer(&mut self, sentence: Sentence) -> Result<(), UnitError> {
        let Some((decision, _)) = self.question.take() else {
            return self.observe(sentence);
        };
        self.spoken.push(sentence.clone());
        self.unit.answer(decision, sentence)?;
        self.due = Some(clock::now() + PATIENCE);
        Ok(())
    }

    /// Tells the unit how likely the answer to its yes-or-no question sounded like yes and like no,
    /// 0..=1. Without a question nothing is told.
    ///
    /// # Errors
    /// [`UnitError`] when the unit is not there.
    pub fn yes_or_no(&mut self, likelihoods: [f32; 2]) -> Result<(), UnitError> {
        let Some((decision, _)) = self.question.take() else {
            return Ok(());
        };
        self.unit.reply(decision, &likelihoods)?;
        self.due = Some(clock::now() + PATIENCE);
        Ok(())
    }
}
