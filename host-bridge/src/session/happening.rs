//! What a session tells whoever runs it.

use deictic_core::decide::Question;
use deictic_core::large::{Decision, Intent};
use deictic_core::protocol::message::{Fault, Hello};

use crate::explain::reasons::Reasons;
use crate::robot::{CommandId, Event, Refusal};
use crate::unit::{Distrust, Loss};

/// Something that happened in a session.
#[derive(Clone, Debug, PartialEq)]
pub enum Happening {
    /// The unit has decided.
    Decided {
        /// The decision's number.
        number: u32,
        /// The version of the scene it was made on.
        scene: u32,
        /// What it has decided.
        decision: Box<Decision>,
        /// What was heard and seen, before it was held against the scene.
        heard: Option<Intent>,
    },
    /// The unit has read this off a hand.
    Shown {
        /// In words.
        text: String,
    },
    /// Why the unit has decided so; only in a session that explains.
    Reasons(Box<Reasons>),
    /// The unit asks the person; the answer goes to [`super::Session::answer`].
    Asked {
        /// The number of the decision that asks.
        id: u32,
        /// How many more questions there may be.
        left: u8,
        /// What it asks.
        question: Question,
        /// In words.
        text: String,
    },
    /// A decision is not acted upon.
    Distrusted(Distrust),
    /// A decision is not acted upon, as a stop was given, or it was forbidden, after what it was made on.
    Overruled,
    /// What these modalities told is not decided on, one bit each: it was forbidden.
    Withheld {
        /// Which.
        modalities: u8,
    },
    /// The robot begins.
    Accepted(Intent),
    /// The robot does not begin; nothing has moved.
    Refused {
        /// What it was to do.
        intent: Intent,
        /// Why it does not.
        refusal: Refusal,
    },
    /// The robot begins to go home.
    Homing,
    /// The robot does not do what it was told directly; it is as it was.
    Declined {
        /// What it was told.
        order: super::Order,
        /// Why it does not.
        refusal: Refusal,
    },
    /// How the robot fares.
    Robot(Event),
    /// The robot has said nothing and got nowhere for too long; it was told to stop, and its command
    /// has failed.
    Hanging(CommandId),
    /// The table is different, and this is its version now.
    Table(u32),
    /// What the robot did to the table cannot be; the table is kept as it was.
    BadTable(deictic_core::scene::SceneError),
    /// The unit did not take something that was told.
    Fault(Fault),
    /// The unit did not decide in time.
    NoDecision,
    /// The unit is gone, and the robot stands still.
    Lost(Loss),
    /// The unit is there again and knows everything.
    Back(Hello),
    /// So many commands that were still to come are dropped.
    Dropped(usize),
}
