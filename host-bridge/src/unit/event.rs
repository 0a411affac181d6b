//! What a unit has said, or what has become of it.

use deictic_core::gesture::wire::Sample;
use deictic_core::large::Sentence;
use deictic_core::protocol::hand::{HandStatistics, HandView};
use deictic_core::protocol::message::{
    Decided, Fault, Hello, Statistics, Why, WhyActions, WhyWhole, Withheld,
};

use super::trust::Distrust;

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
    /// Why: the whole intent, of the joint model.
    WhyWhole(WhyWhole),
    /// Something was not right; nothing was done.
    Fault(Fault),
    /// This is not decided on, as it was forbidden.
    Withheld(Withheld),
    /// What it has counted.
    Statistics(Statistics),
    /// A hand has begun to say something; `false`: it is over.
    Showing(bool),
    /// What a hand said, as the unit goes by it from now on.
    Shown {
        /// What it said.
        sentence: Box<Sentence>,
        /// The decision whose question it answers, if it does.
        answers: Option<u32>,
    },
    /// What it sees of a hand.
    Hand(Box<HandView>),
    /// What has become of samples.
    HandStatistics(HandStatistics),
    /// What its own hand sensor sent ([`super::GestureUnit::relay`]).
    Sample(Box<Sample>),
    /// It is gone; nothing can be decided until [`Event::Back`].
    Lost(Loss),
    /// It is there, and knows vocabulary, scene and configuration again. What was waiting in it is
    /// gone.
    Back(Hello),
}

/// How a unit was lost.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Loss {
    /// The wire failed, in these words.
    Wire(String),
    /// Nothing was heard for [`super::UNIT_LOST`].
    Silent,
    /// It has forgotten what it was told: it has started anew, or had not heard this bridge for too
    /// long.
    Forgetful,
    /// It did not take over the new scene.
    Stale,
    /// It did not decide when it was to, so whatever it has in hand is taken from it.
    Late,
    /// It was reached, but could not be loaded, for this reason.
    Unloadable(String),
}
