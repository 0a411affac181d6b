//! What a checked command comes to: a task, and the named steps that it is done in.

/// A checked command.
#[derive(Clone, Debug, PartialEq)]
pub enum Task {
    Stop,
    MoveUp {
        by: f32,
    },
    Release {
        thing: String,
        to: Place,
        on: Option<(String, &'static str)>,
    },
    Pick {
        thing: String,
        at: Place,
    },
    Push {
        thing: String,
        from: Place,
        to: Place,
    },
    Unglue {
        thing: String,
        at: Place,
    },
    Pour {
        thing: String,
        at: Place,
        into: String,
        over: Place,
        degrees: f32,
    },
    PutInto {
        thing: String,
        at: Place,
        into: String,
        to: Place,
    },
    Stack {
        thing: String,
        at: Place,
        onto: String,
        to: Place,
    },
}

impl Task {
    /// The thing it is done to.
    pub fn thing(&self) -> Option<&str> {
        match self {
            Self::Stop | Self::MoveUp { .. } => None,
            Self::Release { thing, .. }
            | Self::Pick { thing, .. }
            | Self::Push { thing, .. }
            | Self::Unglue { thing, .. }
            | Self::Pour { thing, .. }
            | Self::PutInto { thing, .. }
            | Self::Stack { thing, .. } => Some(thing),
        }
    }
}

/// Metres in the robot's base frame.
pub type Place = [f32; 3];

/// Where the hand is to be: its fingers pointing down, unless it leans.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// Where the middle between the finger tips is.
    pub at: Place,
    /// How far the hand is turned about the upright, in radians.
    pub turn: f32,
    /// How far it leans over, in radians: at half a turn the fingers point up.
    pub lean: f32,
}

/// What the hand does in a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// It goes from here through these, one after the other.
    Go(Vec<Grip>),
    /// The fingers go this far apart, in metres: between shut and open, they close on a thing.
    Fingers(f64),
}

/// One step.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What the arm does, in words.
    pub name: String,
    /// The thing or place that it is about, for when it cannot be reached.
    pub about: String,
    /// What the hand does.
    pub act: Act,
    /// What is different at its end.
    pub effect: Effect,
}

/// What a motion does to the things on the table.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Nothing, but that a held thing comes along.
    None,
    /// The thing is in the hand.
    Grasp(String),
    /// The thing has left the hand, and rests where the hand is.
    LetGo,
    /// As [`Effect::LetGo`], and the thing fills or covers another: its name, and the feature that
    /// tells so.
    LeaveIn(String, &'static str),
    /// The thing is pushed to this much from where the hand is.
    Push(String, Place),
    /// The thing is loose.
    Loosen(String),
    /// What is in the first runs into the second, as the first is tilted by so many degrees.
    Pour(String, String, f32),
}
