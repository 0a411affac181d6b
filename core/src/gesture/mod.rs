//! From a hand to a gesture sentence.
//!
//! ```text
//! bytes -> wire -> Sample -> tracking -> shape -> evidence ─┬─> pointing ─┐
//!                                     -> movement -> stroke ┴─────────────┴> word -> Sentence
//! ```
//!
//! [`reader::HandReader`] runs all of it: one sample in, at most one [`context::Event`] out.

mod bits;
pub mod calibration;
pub mod context;
pub mod counters;
pub mod curl;
pub mod evidence;
pub mod frame;
pub mod line;
pub mod mapping;
pub mod movement;
pub mod path;
pub mod pointing;
pub mod reader;
mod saying;
pub mod shape;
pub mod shape_table;
pub mod stroke;
pub mod stroke_table;
pub mod template;
pub mod tracking;
pub mod vector;
pub mod wire;
pub mod word;
