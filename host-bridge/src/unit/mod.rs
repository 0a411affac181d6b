//! The host's end of the conversation with a gesture unit: it opens it, loads vocabulary, scene and
//! configuration, keeps it alive, opens it again after a loss, and says of every decision whether it
//! may be acted upon.

mod conversation;
mod trust;

use std::time::{Duration, Instant};

use deictic_core::large::{Message, Scene, Sentence, Vocabulary};
use deictic_core::protocol::message::{
    Answer, Configuration, Decided, Fault, Hello, RobotStatus, Statistics, Why, WhyActions,
};

use crate::link::{Address, WireError, open};
use conversation::Conversation;
pub use trust::Distrust;
use trust::Trust;

/// After how long without a frame the unit counts as lost: four of its heartbeats.
pub const UNIT_LOST: Duration = Duration::from_millis(2_000);

/// How often the host shows that it lives, and how often it tries to reach a lost unit.
const HEARTBEAT: Duration = Duration::from_millis(500);

/// How long a unit may take to answer while it is being loaded.
const PATIENCE: Duration = Duration::from_secs(3);

/// What a unit has said, or what has become of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// It has decided; `trust` says whether an execution may go to the robot.
    Decision {
        /// What it has decided.
        decided: Box<Decided<16>>,
        /// Why it must not be acted upon, if so.
        trust: Result<(), Distrust>,
    },
    /// Why: one category.
    Why(Box<Why<64>>),
    /// Why: the actions' penalties.
    WhyActions(Box<WhyActions<64>>),
    /// Something was not right; nothing was done.
    Fault(Fault),
    /// What it has counted.
    Statistics(Statistics),
    /// It is gone; nothing can be decided until [`Event::Back`].
    Lost(Loss),
    /// It is there, and knows vocabulary, scene and configuration again. What was waiting in it is
    /// gone.
    Back(Hello),
}

/// How a unit was lost.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Loss {
    /// The wire failed, with these words of the system's.
    Wire(String),
    /// Nothing was heard for [`UNIT_LOST`].
    Silent,
    /// It has started anew and forgotten everything.
    Restarted,
}

/// A conversation could not be opened.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum UnitError {
    /// The wire could not be opened.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Wire(#[from] WireError),
    /// The wire failed.
    #[error("the link to the unit failed")]
    #[diagnostic(help(
        "look at the cable and the board's power; the bridge connects again by itself once it runs"
    ))]
    Broken(#[source] std::io::Error),
    /// The unit did not answer.
    #[error("nothing that speaks our protocol answers")]
    #[diagnostic(help(
        "does the board run the unit's firmware, and is it the right port and speed?"
    ))]
    NoAnswer,
    /// The unit speaks another version of the protocol.
    #[error(
        "the unit speaks version {} of the protocol (schema {:#010x}), this bridge version {} (schema {:#010x})",
        .unit.0, .unit.1, .host.0, .host.1
    )]
    #[diagnostic(help(
        "flash the firmware that belongs to this bridge: `cargo run --release` in firmware/, or use the bridge \
         that belongs to the firmware"
    ))]
    Schema {
        /// The unit's version and schema.
        unit: (u16, u32),
        /// This bridge's.
        host: (u16, u32),
    },
    /// The vocabulary or scene is larger than the unit can hold.
    #[error("the unit holds {capacity} {what}, and there are {wanted}")]
    #[diagnostic(help(
        "leave some out, or flash a unit built with larger capacities (core/src/capacity.rs)"
    ))]
    TooLarge {
        /// Of what there is too much.
        what: &'static str,
        /// How many the unit holds.
        capacity: u16,
        /// How many there are.
        wanted: usize,
    },
    /// The unit refused what it was told.
    #[error("the unit refuses what it was told: {}", crate::explain::fault(.0).what)]
    #[diagnostic(help("{}", crate::explain::fault(.0).remedy))]
    Refused(Fault),
}

/// A gesture unit as the host sees it.
pub struct GestureUnit {
    address: Address,
    conversation: Option<Conversation>,
    vocabulary: Vocabulary,
    scene: Scene,
    configuration: Configuration,
    trust: Trust,
    hello: Hello,
    beat: Instant,
}

impl GestureUnit {
    /// Connects to a unit and loads all it needs.
    ///
    /// # Errors
    /// [`UnitError`] with what to do about it.
    pub fn connect(
        address: &Address,
        vocabulary: &Vocabulary,
        scene: &Scene,
        configuration: Configuration,
    ) -> Result<Self, UnitError> {
        let mut conversation = Conversation::new(open(address)?);
        let hello = conversation.load(vocabulary, scene, &configuration)?;
        Ok(Self {
            address: address.clone(),
            conversation: Some(conversation),
            vocabulary: vocabulary.clone(),
            scene: scene.clone(),
            configuration,
            trust: Trust::new(vocabulary.fingerprint(), scene.version()),
            hello,
            beat: Instant::now(),
        })
    }

    /// How the unit introduced itself last.
    #[must_use]
    pub fn hello(&self) -> &Hello {
        &self.hello
    }

    /// Whether the unit is there.
    #[must_use]
    pub fn is_there(&self) -> bool {
        self.conversation.is_some()
    }

    /// Tells the unit of a new scene. Decisions made on an older one are distrusted from now on.
    ///
    /// # Errors
    /// [`UnitError`]; the scene is sent again when the unit comes back.
    pub fn set_scene(&mut self, scene: &Scene) -> Result<(), UnitError> {
        self.scene = scene.clone();
        self.trust.set_scene(scene.version());
        self.with(|c| c.load_scene(scene))
    }

    /// Tells the unit what a modality observed.
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it.
    pub fn observe(&mut self, sentence: Sentence) -> Result<(), UnitError> {
        self.with(|c| c.say(&Message::Sentence(sentence)))
    }

    /// Tells the unit what the person answered to the question of decision `decision`.
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it.
    pub fn answer(&mut self, decision: u32, sentence: Sentence) -> Result<(), UnitError> {
        self.with(|c| c.say(&Message::Answer(Answer { decision, sentence })))
    }

    /// Tells the unit how the robot fares.
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it.
    pub fn report(&mut self, status: RobotStatus) -> Result<(), UnitError> {
        self.with(|c| c.say(&Message::Robot(status)))
    }

    /// Asks the unit what it has counted; the answer is an [`Event::Statistics`].
    ///
    /// # Errors
    /// [`UnitError`]; the unit has then not heard it.
    pub fn ask_statistics(&mut self) -> Result<(), UnitError> {
        self.with(|c| c.say(&Message::AskStatistics))
    }

    /// What has happened, waiting up to `patience` for the first of it. Call it often: it also shows
    /// the unit that the host lives, and reaches for a unit that was lost.
    pub fn poll(&mut self, patience: Duration) -> Vec<Event> {
        let Some(conversation) = &mut self.conversation else {
            return self.reach(patience);
        };
        let result = if self.beat.elapsed() >= HEARTBEAT {
            self.beat = Instant::now();
            conversation.beat(&self.vocabulary, &self.scene)
        } else {
            Ok(())
        };
        let heard = result.and_then(|()| conversation.hear(patience));
        match heard {
            Err(error) => vec![self.lose(Loss::Wire(error.to_string()))],
            Ok(messages) if messages.is_empty() && conversation.silence() >= UNIT_LOST => {
                vec![self.lose(Loss::Silent)]
            }
            Ok(messages) => {
                let mut events = Vec::new();
                for (message, missed) in messages {
                    match message {
                        Message::Hello(_) => {
                            events.push(self.lose(Loss::Restarted));
                            return events;
                        }
                        other => events.extend(self.event(other, missed)),
                    }
                }
                events
            }
        }
    }

    fn event(&mut self, message: Message, missed: u16) -> Option<Event> {
        match message {
            Message::Decision(decided) => {
                let trust = self.trust.judge(&decided, missed);
                Some(Event::Decision {
                    decided: Box::new(decided),
                    trust,
                })
            }
            Message::Why(why) => Some(Event::Why(Box::new(why))),
            Message::WhyActions(why) => Some(Event::WhyActions(Box::new(why))),
            Message::Fault(fault) => Some(Event::Fault(fault)),
            Message::Statistics(statistics) => Some(Event::Statistics(statistics)),
            _ => None,
        }
    }

    fn lose(&mut self, loss: Loss) -> Event {
        self.conversation = None;
        Event::Lost(loss)
    }

    /// Tries to reach a lost unit.
    fn reach(&mut self, patience: Duration) -> Vec<Event> {
        let wait = HEARTBEAT.saturating_sub(self.beat.elapsed()).min(patience);
        std::thread::sleep(wait);
        if self.beat.elapsed() < HEARTBEAT {
            return Vec::new();
        }
        self.beat = Instant::now();
        let reached = open(&self.address)
            .map_err(UnitError::from)
            .and_then(|wire| {
                let mut conversation = Conversation::new(wire);
                let hello =
                    conversation.load(&self.vocabulary, &self.scene, &self.configuration)?;
                Ok((conversation, hello))
            });
        let Ok((conversation, hello)) = reached else {
            return Vec::new();
        };
        self.conversation = Some(conversation);
        self.hello = hello;
        self.trust = Trust::new(self.vocabulary.fingerprint(), self.scene.version());
        vec![Event::Back(hello)]
    }

    /// Does something with the unit when it is there.
    fn with(
        &mut self,
        act: impl FnOnce(&mut Conversation) -> Result<(), UnitError>,
    ) -> Result<(), UnitError> {
        match &mut self.conversation {
            Some(conversation) => act(conversation),
            None => Err(UnitError::NoAnswer),
        }
    }
}
