//! Speech through a recogniser's own process: what it may hear follows from the vocabulary, what it
//! heard comes back as alternatives with probabilities.
//!
//! [`pocketsphinx`] drives Debian's packaged recogniser with its packaged English model; any other
//! is plugged in by its lines ([`crate::language::Spoken::read`]).

pub mod jsgf;
pub mod pocketsphinx;

pub use pocketsphinx::{Pocketsphinx, SpeechError};
