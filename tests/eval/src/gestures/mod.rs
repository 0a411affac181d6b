//! Gestures: training and scoring of what the unit knows of hands.
//!
//! ```text
//! leap_static.csv.xz ─> hands ─┐
//! deictic::hand (people made up) ┴─> network ─> statics: score, table for core/src/gesture
//! ```

pub mod dynamics;
pub mod hands;
pub mod network;
pub mod sessions;
pub mod statics;
pub mod telling;
