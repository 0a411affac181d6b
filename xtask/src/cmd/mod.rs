//! One file per command; its doc comment is its manual.

pub mod budget;
pub mod can;
pub mod demo;
pub mod deny;
pub mod faults;
pub mod fci;
pub mod firmware;
pub mod fuzz;
pub mod growth;
pub mod interface;
pub mod key;
pub mod latency;
pub mod qemu;
pub mod setup;
pub mod soak;
pub mod test;
pub mod versions;
