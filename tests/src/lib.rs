//! What the behaviour tests of the whole share: a unit on an emulated board, one in this process,
//! a host that speaks with either, the method in 64-bit floats, sessions over faulty and over full lines, and what the fuzzers check.

pub mod emulated;
pub mod fuzz;
pub mod gesturing;
pub mod host;
pub mod method;
pub mod network;
pub mod painted;
pub mod people;
pub mod sensing;
pub mod soak;
pub mod stillness;
