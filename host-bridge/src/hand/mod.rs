//! Hands without a sensor: a kinematic model of the hand, postures and movements, from which frames
//! are made that a tracking sensor could have sent. Demo, tests and the training of the unit's
//! tables use them.
//!
//! * [`anatomy`]: bones of a person, and where the joints come to lie.
//! * [`posture`]: how the fingers are held for a shape, and how they are held for none.
//! * [`movement`]: how a palm moves for a gesture.
//! * [`session`]: everything from the hand's coming to its leaving, as frames.

pub mod anatomy;
pub mod movement;
pub mod posture;
pub mod session;
