//! The host bridge of the gesture unit: vocabulary and scene in words, the link to the unit, and the
//! robot that does what the unit decides.

pub mod answering;
pub mod clock;
pub mod cmd;
pub mod deciding;
pub mod diagnose;
pub mod draw;
pub mod explain;
pub mod halting;
pub mod hand;
pub mod language;
pub mod link;
pub mod report;
pub mod robot;
pub mod scene;
pub mod script;
pub mod sensor;
pub mod sensor_model;
pub mod session;
pub mod setups;
pub mod showing;
pub mod understanding;
pub mod unit;
pub mod vocabulary;
