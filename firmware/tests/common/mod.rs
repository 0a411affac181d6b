//! What the tests of the loop share.
#![allow(dead_code, reason = "each test uses its part")]

pub mod board;
pub mod sensor;
