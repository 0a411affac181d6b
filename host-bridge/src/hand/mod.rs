//! Hands: where their samples come from, and what a unit is told of them.
//!
//! * [`source`]: sensors that hang on this machine, recordings, and made-up people.
//! * [`meaning`], [`taught`]: which gestures stand for which actions, and gestures of a user's own.
//! * [`learning`]: examples of gestures from recordings.
//! * [`aim`]: how one person aims.
//!
//! Hands without a sensor: a kinematic model of the hand, postures and movements, from which frames
//! are made that a tracking sensor could have sent. Demo, tests and the training of the unit's
//! tables use them.
//!
//! * [`anatomy`]: bones of a person, and where the joints come to lie.
//! * [`posture`]: how the fingers are held for a shape, and how they are held for none.
//! * [`movement`]: how a palm moves for a gesture.
//! * [`acting`]: what a made-up person is to do, in words.
//! * [`session`]: everything from the hand's coming to its leaving, as frames.

pub mod acting;
pub mod aim;
pub mod anatomy;
mod examples;
mod fitting;
pub mod learning;
mod letters;
pub mod meaning;
pub mod movement;
pub mod performance;
pub mod posture;
pub mod session;
pub mod source;
pub mod taught;
