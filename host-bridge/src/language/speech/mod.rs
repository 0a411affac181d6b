//! Speech through a recogniser: what it may hear follows from the vocabulary, what it heard comes back
//! as alternatives with probabilities.
//!
//! A [`Recogniser`] takes sound from a [`source`]: [`moonshine`] where it is installed, else
//! [`pocketsphinx`], Debian's packaged recogniser with its packaged English model. Any other is plugged
//! in by its lines ([`crate::language::Spoken::read`]).

mod anything;
mod commands;
mod ears;
mod error;
mod fits;
mod hearing;
mod measures;
pub mod moonshine;
mod paths;
pub mod phrases;
pub mod pocketsphinx;
mod program;
pub mod pronounce;
mod recogniser;
pub mod rule;
pub mod segment;
pub mod sound;
pub mod source;

pub use ears::{Ears, Heard};
pub use error::SpeechError;
pub use moonshine::Moonshine;
pub use phrases::Expected;
pub use pocketsphinx::Pocketsphinx;
pub use program::samples;
pub use recogniser::{Kind, Recogniser};
pub use source::Source;
