//! The experiments of "Tell and show" (Vanc, Skoviera, Stepanova 2024), run with Deictic's core.
//!
//! ```text
//! vocab.json ─> Catalogue ─┐
//! *.jsonl.gz ─> Set ───────┴─> Prepared ─> deictic_core::fuse ─> parity, score
//! ```
//!
//! No decision depends on the order in which a file lists things: the core folds over the scene and
//! looks things up by option.

pub mod ablation;
pub mod answer;
pub mod bound;
pub mod calibration;
pub mod catalogue;
pub mod conversation;
pub mod dataset;
pub mod density;
pub mod disturb;
pub mod free;
pub mod gaze;
pub mod generate;
pub mod gestures;
pub mod interval;
pub mod maker;
pub mod noise;
pub mod order;
pub mod paper;
pub mod parity;
pub mod peer;
pub mod phonetic;
pub mod reading;
pub mod recipe;
pub mod record;
pub mod score;
pub mod sensing;
pub mod setups;
pub mod situation;
pub mod speech;
pub mod speed;
pub mod variant;
