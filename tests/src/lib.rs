//! What the behaviour tests of the whole share: a unit on an emulated board, one in this process,
//! and a host that speaks with either.

pub mod emulated;
pub mod host;
