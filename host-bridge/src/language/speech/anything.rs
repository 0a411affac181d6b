//! Whatever may be said that is no command: sounds of the language in any order, as one more
//! hypothesis that the commands are held against.
//!
//! Any sounds in any order fit a recording better than a command does, if not by much where the
//! command was said. By how much, per 10 ms, tells talk from commands. In quiet, of three voices of
//! espeak-ng: 12 commands from -0.4 to 7.6 (the median 2.9), 12 sentences of talk from 6.7 to 25.2
//! (the median 16), all but one of them above 10.

/// The lead over the best command, per 10 ms, from which on talk is likelier.
pub const LEAD: f64 = 9.0;

/// Samples of 10 ms.
pub const FRAME: usize = super::sound::RATE / 100;

/// The sounds of English, as the CMU dictionary names them.
const PHONES: [&str; 39] = [
    "AA", "AE", "AH", "AO", "AW", "AY", "B", "CH", "D", "DH", "EH", "ER", "EY", "F", "G", "HH",
    "IH", "IY", "JH", "K", "L", "M", "N", "NG", "OW", "OY", "P", "R", "S", "SH", "T", "TH", "UH",
    "UW", "V", "W", "Y", "Z", "ZH",
];

/// A dictionary that has each sound as a word.
#[must_use]
pub fn dictionary() -> String {
    PHONES
        .map(|phone| format!("sound-{phone} {phone}\n"))
        .concat()
}

/// The grammar of any of these words in any order.
#[must_use]
pub fn grammar() -> String {
    let words = PHONES.map(|phone| format!("sound-{phone}")).join(" | ");
    format!("#JSGF V1.0;\ngrammar anything;\npublic <utterance> = ({words})+;\n")
}

/// How many times 10 ms these samples take.
#[must_use]
pub fn frames(samples: usize) -> f64 {
    samples as f64 / FRAME as f64
}

/// The score that a recording of so many samples must beat to be a command, given how well any
/// sounds fit it.
#[must_use]
pub fn bar(score: f64, samples: usize) -> f64 {
    score - LEAD * frames(samples)
}
