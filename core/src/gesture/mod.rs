//! From a hand to a gesture sentence.

pub mod frame;
pub mod vector;
pub mod wire;
