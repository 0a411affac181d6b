//! Speech end to end: spoken by espeak-ng, disturbed by sox, heard by pocketsphinx, fused with a
//! pointing hand, decided by the core.

mod heard;
mod say;
mod trial;

pub use heard::{Heard, Scored};
pub use say::{Said, said, speak, talk};
pub use trial::{Answer, Trial};

/// Voices that the recogniser's figures are fitted on.
pub const FITTED: [&str; 6] = [
    "en-us+f1",
    "en-us+m1",
    "en-gb+m2",
    "en-gb-scotland+f2",
    "en-gb-x-rp",
    "en-us-nyc+m4",
];

/// Voices that are scored; none of them is among [`FITTED`].
pub const SCORED: [&str; 6] = [
    "en-us",
    "en-gb",
    "en-us+f3",
    "en-gb-scotland+m3",
    "en-us+m7",
    "en-gb-x-rp+f5",
];

/// How much louder than the noise the voice is, in dB; `None` is no noise.
pub const LEVELS: [Option<i32>; 4] = [None, Some(20), Some(10), Some(5)];
