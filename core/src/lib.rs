//! Deictic's fusion core: what a person *said*, what a person *showed* and what the scene *allows*
//! become one decision: execute an intent, ask about one part of it, or ask for a repetition.
//!
//! The method is that of "Tell and show" (Vanc, Skoviera, Stepanova 2024, arXiv 2404.01702, below
//! *the paper*). Data flows one way, each stage in the module named after it:
//!
//! ```text
//! Vocabulary, Scene ─────────────────────────────┐
//! Sentence (gesture)  ┐                          │
//! Sentence (language) ┴ align -> merge -> feasibility -> decide -> Decision, Trace
//! ```
//!
//! [`fuse::fuse`] runs all of it; [`unit::Unit`] wraps it in the state machine of a gesture unit
//! (frames in, frames out, time as an argument) and is what the board runs.
//!
//! * No heap, no panic, no clock, no log: every collection has its capacity in its type, every
//!   function is total over any bytes and any `f32`, every overflow is a typed error.
//! * Host and board give the same bits: all transcendental functions go through [`math`].
//! * [`board`] and [`large`] name two sets of capacities; any other is a handful of numbers away.
#![no_std]
#![forbid(unsafe_code)]
#![cfg_attr(
    not(test),
    warn(
        clippy::indexing_slicing,
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::arithmetic_side_effects
    )
)]

#[cfg(test)]
extern crate std;

pub mod align;
pub mod can;
pub mod capacity;
pub mod category;
pub mod clarify;
pub mod command;
pub mod decide;
pub mod decision;
pub mod entropy;
pub mod feasibility;
pub mod fuse;
pub mod gesture;
pub mod intent;
pub mod joint;
pub mod judgement;
pub mod math;
pub mod merge;
mod mixed;
pub mod observations;
pub mod profile;
pub mod protocol;
pub mod reference;
pub mod scene;
pub mod sentence;
pub mod situation;
pub mod slcan;
pub mod tables;
pub mod time;
pub mod trace;
pub mod unit;
pub mod vocabulary;

pub use capacity::{board, large};
