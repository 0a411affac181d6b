//! The host's end of the conversation with a gesture unit: it opens it, loads vocabulary, scene and
//! configuration, keeps it alive, opens it again after a loss, and says of every decision whether it
//! may be acted upon.

mod conversation;
mod error;
mod event;
mod loading;
mod telling;
mod trust;

use std::time::{Duration, Instant};

use deictic_core::gesture::wire::decode;
use deictic_core::large::{Scene, Sentence, ToHost, ToUnit, Vocabulary};
use deictic_core::profile::Model;
use deictic_core::protocol::message::{Configuration, Fault, Hello, Loaded, SentencePart};
use deictic_core::sentence::GESTURE;

use crate::clock;
use crate::hand::meaning::HandSetup;
use crate::link::{Address, Wire, WireError, open};
use crate::sensor_model::SensorModel;
use conversation::Conversation;
pub use error::UnitError;
pub use event::{Event, Loss};
pub use trust::Distrust;
use trust::Trust;

/// After how long without a frame the unit counts as lost: four of its heartbeats.
pub const UNIT_LOST: Duration = Duration::from_millis(2_000);

/// How often the host shows that it lives, and how often it tries to reach a lost unit.
const HEARTBEAT: Duration = Duration::from_millis(500);

/// How long a unit may take to answer while it is being loaded.
const PATIENCE: Duration = Duration::from_secs(3);

/// How long a unit may take to take over a new scene before it counts as lost.
const SCENE_PATIENCE: Duration = Duration::from_millis(1_000);

/// Opens a wire to a unit, as often as one is needed.
pub type Opener = Box<dyn FnMut() -> Result<Box<dyn Wire>, WireError> + Send>;

/// A gesture unit as the host sees it.
pub struct GestureUnit {
    open: Opener,
    conversation: Option<Conversation>,
    /// Whether it knows vocabulary, scene and configuration.
    loaded: bool,
    /// Until when it is to have taken over the newest scene.
    scene_due: Option<Instant>,
    /// What has happened besides what was heard.
    happened: Vec<Event>,
    vocabulary: Vocabulary,
    scene: Scene,
    configuration: Configuration,
    hand: Option<HandSetup>,
    sensors: Option<SensorModel>,
    /// Whether it passes on what its own hand sensor sends.
    relays: bool,
    /// What a hand said that is arriving in parts.
    shown: Sentence,
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
        let address = address.clone();
        let opener = Box::new(move || open(&address));
        Self::over(opener, vocabulary, scene, configuration)
    }

    /// Connects to a unit over wires of any kind and loads all it needs.
    ///
    /// # Errors
    /// [`UnitError`] with what to do about it.
    pub fn over(
        mut open: Opener,
        vocabulary: &Vocabulary,
        scene: &Scene,
        configuration: Configuration,
    ) -> Result<Self, UnitError> {
        let mut conversation = Conversation::new(open()?);
        let hello = conversation.load(vocabulary, scene, &configuration)?;
        Ok(Self {
            open,
            conversation: Some(conversation),
            loaded: true,
            scene_due: None,
            happened: Vec::new(),
            vocabulary: vocabulary.clone(),
            scene: scene.clone(),
            configuration,
            hand: None,
            sensors: None,
            relays: false,
            shown: Sentence::new(GESTURE),
            trust: Trust::new(vocabulary.fingerprint(), scene.version()),
            hello,
            beat: clock::now(),
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
        self.loaded
    }

    /// Takes from the unit whatever it has in hand, by opening the conversation anew: nothing that it
    /// decided before can be heard after.
    pub fn forget(&mut self) {
        if self.loaded {
            let lost = self.lose(Loss::Late);
            self.happened.push(lost);
        }
    }

    /// What has happened, waiting up to `patience` for the first of it. Call it often: it also shows
    /// the unit that the host lives, and reaches for a unit that was lost.
    pub fn poll(&mut self, patience: Duration) -> Vec<Event> {
        if !self.happened.is_empty() {
            return std::mem::take(&mut self.happened);
        }
        if !self.loaded {
            return self.reach(patience);
        }
        let Some(conversation) = &mut self.conversation else {
            return vec![self.lose(Loss::Silent)];
        };
        let result = if clock::since(self.beat) >= HEARTBEAT {
            self.beat = clock::now();
            conversation.beat(&self.vocabulary, &self.scene)
        } else {
            Ok(())
        };
        let heard = match result.and_then(|()| conversation.hear(patience)) {
            Ok(heard) => heard,
            Err(error) => return vec![self.lose(Loss::Wire(error.in_full()))],
        };
        if heard.is_empty() && conversation.silence() >= UNIT_LOST {
            return vec![self.lose(Loss::Silent)];
        }
        let mut events = Vec::new();
        for (message, missed) in heard {
            let loss = match &message {
                ToHost::Hello(_) => Some(Loss::Forgetful),
                ToHost::Fault(fault) => loss_behind(fault),
                _ => None,
            };
            if let Some(loss) = loss {
                events.push(self.lose(loss));
                return events;
            }
            events.extend(self.event(message, missed));
        }
        if self.scene_due.is_some_and(|due| clock::now() >= due) {
            events.push(self.lose(Loss::Stale));
        }
        events
    }

    fn event(&mut self, message: ToHost, missed: u16) -> Option<Event> {
        match message {
            ToHost::Decision(decided) => {
                let trust = self.trust.judge(&decided, missed);
                Some(Event::Decision {
                    decided: Box::new(decided),
                    trust,
                })
            }
            ToHost::Why(why) => Some(Event::Why(Box::new(why))),
            ToHost::WhyActions(why) => Some(Event::WhyActions(Box::new(why))),
            ToHost::WhyWhole(why) => Some(Event::WhyWhole(why)),
            ToHost::Fault(fault) => Some(Event::Fault(fault)),
            ToHost::Loaded(Loaded::Scene(version)) if version == self.scene.version() => {
                self.scene_due = None;
                None
            }
            ToHost::Statistics(statistics) => Some(Event::Statistics(statistics)),
            ToHost::Withheld(withheld) => Some(Event::Withheld(withheld)),
            ToHost::Showing(showing) => Some(Event::Showing(showing)),
            ToHost::Shown(part) => self.shown(part),
            ToHost::Hand(view) => Some(Event::Hand(Box::new(view))),
            ToHost::HandStatistics(statistics) => Some(Event::HandStatistics(statistics)),
            // What cannot be is among the unit's own counts.
            ToHost::Sample(bytes) => decode(&bytes).ok().map(|s| Event::Sample(Box::new(s))),
            _ => None,
        }
    }

    /// Takes a part of what a hand said; the last one makes it whole. One that has lost a part only
    /// misses in what people are told, as the unit itself goes by all of it.
    fn shown(&mut self, part: SentencePart<16, 64>) -> Option<Event> {
        if part.first == 0 {
            self.shown.restart(part.modality);
        }
        for word in part.words {
            self.shown.push(word).ok()?;
        }
        if self.shown.words().len() < usize::from(part.total) {
            return None;
        }
        let sentence = std::mem::replace(&mut self.shown, Sentence::new(GESTURE));
        Some(Event::Shown {
            sentence: Box::new(sentence),
            answers: part.answers,
        })
    }

    fn lose(&mut self, loss: Loss) -> Event {
        if matches!(loss, Loss::Wire(_)) {
            self.conversation = None;
        }
        self.loaded = false;
        self.scene_due = None;
        Event::Lost(loss)
    }

    /// Tries to reach a lost unit: over the wire that is there, then over a new one.
    fn reach(&mut self, patience: Duration) -> Vec<Event> {
        let wait = HEARTBEAT
            .saturating_sub(clock::since(self.beat))
            .min(patience);
        clock::sleep(wait);
        if clock::since(self.beat) < HEARTBEAT {
            return Vec::new();
        }
        let reached = match self.conversation.take() {
            Some(conversation) => Ok(conversation),
            None => (self.open)().map(Conversation::new),
        };
        let events = match reached {
            Err(_) => Vec::new(),
            Ok(mut conversation) => {
                match conversation.load(&self.vocabulary, &self.scene, &self.configuration) {
                    Ok(hello) => {
                        // A wire that breaks right now is found broken by the next poll.
                        if let Some(setup) = &self.hand {
                            let _ = conversation.say_hand(setup);
                        }
                        if let Some(sensors) = &self.sensors
                            && self.configuration.profile.model == Model::Joint
                        {
                            let _ = conversation.say_sensors(sensors);
                        }
                        if self.relays {
                            let _ = conversation.say(&ToUnit::Relay(true));
                        }
                        self.conversation = Some(conversation);
                        self.loaded = true;
                        self.hello = hello;
                        let (vocabulary, scene) =
                            (self.vocabulary.fingerprint(), self.scene.version());
                        self.trust = Trust::new(vocabulary, scene);
                        vec![Event::Back(hello)]
                    }
                    Err(UnitError::NoAnswer | UnitError::Broken(_)) => Vec::new(),
                    Err(error) => vec![Event::Lost(Loss::Unloadable(error.to_string()))],
                }
            }
        };
        self.beat = clock::now();
        events
    }
}

/// What a fault says about whether the unit can still be relied on.
fn loss_behind(fault: &Fault) -> Option<Loss> {
    match fault {
        Fault::NoHello | Fault::NoVocabulary | Fault::NoScene | Fault::HostLost => {
            Some(Loss::Forgetful)
        }
        Fault::PartOutOfOrder { .. } | Fault::OldScene { .. } | Fault::Scene(_) => {
            Some(Loss::Stale)
        }
        _ => None,
    }
}
