//! What unit and host say to each other about hands. The samples themselves have a form of their
//! own, [`crate::gesture::wire`], which the sensor's serial line and [`super::message::ToUnit::Sample`]
//! share.

use heapless::Vec;
use serde::{Deserialize, Serialize};

use crate::category::Category;
use crate::gesture::counters::SampleCounters;
use crate::gesture::frame::Side;
use crate::gesture::mapping::{Gesture, MappingError, STROKES};
use crate::gesture::pointing::{Aim, Mount, MountError};
use crate::gesture::shape::SHAPES;
use crate::gesture::template::{Scale, Template};
use crate::gesture::wire::PAYLOAD;

/// Gestures that can stand for actions: all shapes but *none of these*, all strokes.
pub const MEANINGS: usize = SHAPES - 1 + STROKES;

/// How many templates one part carries.
pub const TEMPLATES_PART: usize = 3;

/// Templates that a unit can be taught at most.
pub const LEARNED: usize = 64;

/// Entries of a list in a [`HandView`] at most; the least probable ones are left out.
pub const VIEWED: usize = 8;

/// A sample as on a sensor's serial line, before framing.
pub type SampleBytes = Vec<u8, PAYLOAD>;

/// Which gestures stand for which actions.
pub type Meanings = Vec<Meaning, MEANINGS>;

/// A gesture that stands for an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Meaning {
    /// The gesture.
    pub gesture: Gesture,
    /// The action, one of the vocabulary's.
    pub action: u8,
}

/// How to read a hand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HandSettings {
    /// Where the sensor stands.
    pub mount: Mount,
    /// How well the person aims.
    pub aim: Aim,
}

impl Default for HandSettings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl HandSettings {
    /// What holds until a host says otherwise.
    pub const DEFAULT: Self = Self {
        mount: Mount::DEFAULT,
        aim: Aim::DEFAULT,
    };
}

/// Part of the templates that the unit is taught: up to [`TEMPLATES_PART`] of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TemplatesPart {
    /// How many there are in all; 0 makes the unit forget those it was taught.
    pub total: u8,
    /// The place of this part's first.
    pub first: u8,
    /// Whether the gestures that a unit knows without being taught are told apart as well.
    pub known: bool,
    /// How distances become probabilities.
    pub scale: Scale,
    /// The templates of this part.
    pub templates: Vec<Template, TEMPLATES_PART>,
}

/// Something of a numbered list, and how probable it is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Guess {
    /// Its number.
    pub number: u8,
    /// Its probability.
    pub p: f32,
}

/// The likeliest option of a word.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Glimpse {
    /// The word's likeliest category.
    pub category: Category,
    /// Its likeliest option.
    pub option: u8,
    /// The option's likelihood.
    pub likelihood: f32,
}

/// What a unit sees of a hand right now.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HandView {
    /// The hand that is followed.
    pub hand: Option<Side>,
    /// Probability of every [`crate::gesture::shape::Shape`].
    pub shapes: [f32; SHAPES],
    /// The shape that is being shown.
    pub shown: Option<u8>,
    /// What the last movement may have been: gestures by the numbers that templates carry.
    pub strokes: Vec<Guess, VIEWED>,
    /// That the last movement was none of them; 1 before the first.
    pub no_stroke: f32,
    /// What a pointing hand means: things by their place in the scene; empty when it does not point.
    pub pointed: Vec<Guess, VIEWED>,
    /// That a pointing hand means none of them.
    pub nothing: f32,
    /// The complete words so far.
    pub words: Vec<Glimpse, VIEWED>,
}

/// What has become of samples, and what a unit sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct HandStatistics {
    /// From the sensor's serial line and from the host together.
    pub samples: SampleCounters,
    /// Templates that the unit was taught.
    pub learned: u8,
}

/// Why something about hands was refused. What was said before holds on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum HandFault {
    /// A gesture cannot stand for an action.
    Meaning(MappingError),
    /// The sensor cannot stand so.
    Mount(MountError),
    /// A person cannot aim so: sigma is not in 0.001..=1, or `nothing` not in 0..1.
    Aim,
    /// More templates than a unit holds.
    TooManyTemplates {
        /// How many it holds.
        capacity: u8,
    },
    /// A template is of a gesture beyond those a unit tells apart, or not finite.
    Template {
        /// Its place among the templates.
        template: u8,
    },
    /// The scale of templates is not finite and positive.
    Scale,
    /// The sensor fell silent while a hand was there. What the hand had said is forgotten.
    SensorLost,
}
