//! What the fuzzers feed with bytes, and what must hold whatever the bytes are. A target panics when it does not.
//!
//! The same functions are driven by libFuzzer (`cargo xtask fuzz`, tests/fuzz) and replayed over the committed corpora
//! by an ordinary test (`cargo test -p deictic-tests --test corpus`).

pub mod command;
pub mod decision;
pub mod files;
pub mod frames;
pub mod language;
pub mod loading;
mod situation;
mod source;
pub mod unit;

/// One thing to be fuzzed.
#[derive(Clone, Copy)]
pub struct Target {
    /// Its name: that of its corpus' folder and of its binary.
    pub name: &'static str,
    /// How many bytes an input has at most; a shorter one is as if filled up.
    pub bytes: usize,
    /// Checks one input.
    pub run: fn(&[u8]),
}

const fn target(name: &'static str, bytes: usize, run: fn(&[u8])) -> Target {
    Target { name, bytes, run }
}

/// All of them.
pub const TARGETS: &[Target] = &[
    target("command", 256, command::run),
    target("decision", 320, decision::run),
    target("files", 4096, files::run),
    target("frames", 128, frames::run),
    target("language", 128, language::run),
    target("loading", 512, loading::run),
    target("unit", 1024, unit::run),
];
