//! Speech through a recogniser's own process: what it may hear follows from the vocabulary, what it
//! heard comes back as alternatives with probabilities.
//!
//! [`pocketsphinx`] drives Debian's packaged recogniser with its packaged English model on sound from
//! a [`source`]; any other recogniser is plugged in by its lines ([`crate::language::Spoken::read`]).

mod anything;
pub mod jsgf;
pub mod pocketsphinx;
mod program;
pub mod pronounce;
pub mod segment;
pub mod sound;
pub mod source;

pub use pocketsphinx::{Expected, Pocketsphinx, SpeechError};
pub use program::samples;
pub use source::{Ears, Heard, Source};
