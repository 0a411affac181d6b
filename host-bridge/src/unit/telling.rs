//! What the host tells a unit, as far as it is there.

use deictic_core::gesture::wire::{Sample, encode};
use deictic_core::large::{Scene, Sentence, ToUnit};
use deictic_core::profile::Model;
use deictic_core::protocol::hand::SampleBytes;
use deictic_core::protocol::message::{Answer, Configuration, RobotStatus};

use super::conversation::Conversation;
use super::event::Loss;
use super::{GestureUnit, SCENE_PATIENCE, UnitError};
use crate::clock;
use crate::hand::meaning::HandSetup;
use crate::sensor_model::SensorModel;

impl GestureUnit {
    /// Tells the unit of a new scene, without waiting for it to take it over. Decisions made on an
    /// older one are distrusted from now on; a unit that does not take it over counts as lost.
    ///
    /// # Errors
    /// [`UnitError`]; the scene is sent again when the unit comes back.
    pub fn set_scene(&mut self, scene: &Scene) -> Result<(), UnitError> {
        self.scene = scene.clone();
        self.trust.set_scene(scene.version());
        self.scene_due = Some(clock::now() + SCENE_PATIENCE);
        self.with(|c| c.say_scene(scene))
    }

    /// Tells the unit what modalities observed at the same time.
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it.
    pub fn observe(&mut self, sentences: &[Sentence]) -> Result<(), UnitError> {
        self.with(|c| c.together(|c| sentences.iter().try_for_each(|s| c.tell(s, None))))
    }

    /// Tells the unit what the person answered to the question of decision `decision`.
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it.
    pub fn answer(&mut self, decision: u32, sentence: Sentence) -> Result<(), UnitError> {
        self.with(|c| c.tell(&sentence, Some(decision)))
    }

    /// Tells the unit how the answer to the question of decision `question` sounded.
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it.
    pub fn reply(&mut self, question: u32, likelihoods: &[f32]) -> Result<(), UnitError> {
        self.with(|c| {
            c.say(&ToUnit::Answer(Answer {
                question,
                likelihoods: likelihoods.iter().copied().collect(),
            }))
        })
    }

    /// Tells the unit that this modality forbade, asked or told something, or was not understood: what waits, and what
    /// others show within the pairing window, is not to be done. The answer is an [`super::Event::Withheld`] that
    /// confirms it.
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it.
    pub fn forbid(&mut self, modality: u8) -> Result<(), UnitError> {
        self.with(|c| c.say(&ToUnit::Forbid(modality)))
    }

    /// Tells the unit how the robot fares.
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it.
    pub fn report(&mut self, status: RobotStatus) -> Result<(), UnitError> {
        self.with(|c| c.say(&ToUnit::Robot(status)))
    }

    /// Tells the unit how to read a hand, now and whenever it comes back.
    ///
    /// # Errors
    /// [`UnitError`]; the unit is told when it comes back.
    pub fn set_hand(&mut self, setup: HandSetup) -> Result<(), UnitError> {
        self.hand = Some(setup.clone());
        self.with(|c| c.say_hand(&setup))
    }

    /// Tells the unit what the sensors in use report, now and whenever it comes back. Only the joint
    /// model goes by it.
    ///
    /// # Errors
    /// [`UnitError`]; the unit is told when it comes back.
    pub fn set_sensors(&mut self, sensors: SensorModel) -> Result<(), UnitError> {
        self.sensors = Some(sensors);
        self.say_sensors()
    }

    fn say_sensors(&mut self) -> Result<(), UnitError> {
        match (self.configuration.profile.model, self.sensors.clone()) {
            (Model::Joint, Some(sensors)) => self.with(|c| c.say_sensors(&sensors)),
            _ => Ok(()),
        }
    }

    /// Has the unit decide in another way from now on.
    ///
    /// # Errors
    /// [`UnitError`]; the unit is told when it comes back.
    pub fn configure(&mut self, configuration: Configuration) -> Result<(), UnitError> {
        self.configuration = configuration;
        self.with(|c| c.say(&ToUnit::Configure(configuration)))?;
        self.say_sensors()
    }

    /// Tells the unit what a hand sensor saw.
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it. A sample that cannot be is left out.
    pub fn sense(&mut self, sample: &Sample) -> Result<(), UnitError> {
        let Ok(bytes) = encode(sample) else {
            return Ok(());
        };
        let bytes = SampleBytes::from_slice(&bytes).unwrap_or_default();
        self.with(|c| c.say(&ToUnit::Sample(bytes)))
    }

    /// Asks the unit what it sees of a hand; the answers are an [`super::Event::Hand`] and an
    /// [`super::Event::HandStatistics`].
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it.
    pub fn ask_hand(&mut self) -> Result<(), UnitError> {
        self.with(|c| c.say(&ToUnit::AskHand))
    }

    /// Has the unit pass on what its own hand sensor sends, from now on and whenever it comes back; every sample is an
    /// [`super::Event::Sample`].
    ///
    /// # Errors
    /// [`UnitError`]; the unit is told when it comes back.
    pub fn relay(&mut self) -> Result<(), UnitError> {
        self.relays = true;
        self.with(|c| c.say(&ToUnit::Relay(true)))
    }

    /// Asks the unit what it has counted; the answer is an [`super::Event::Statistics`].
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it.
    pub fn ask_statistics(&mut self) -> Result<(), UnitError> {
        self.with(|c| c.say(&ToUnit::AskStatistics))
    }

    /// Does something with the unit when it is there; one that cannot be told counts as lost.
    fn with(
        &mut self,
        act: impl FnOnce(&mut Conversation) -> Result<(), UnitError>,
    ) -> Result<(), UnitError> {
        let Some(conversation) = self.conversation.as_mut().filter(|_| self.loaded) else {
            return Err(UnitError::NoAnswer);
        };
        let done = act(conversation);
        if let Err(error) = &done {
            let lost = self.lose(Loss::Wire(error.in_full()));
            self.happened.push(lost);
        }
        done
    }
}
