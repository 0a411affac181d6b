//! How soon a robot stands still, counted in its own control periods and not by any machine's clock: a session in
//! simulated time whose every line is full while the arm moves.

mod bus;
mod far;
mod load;
mod trial;

pub use trial::{Ends, Setting, Stillness, loses_its_host, loses_its_unit, stops};

use deictic_core::time::Micros;

/// One control period of the arm: its interface takes a command every millisecond.
pub const PERIOD: Micros = Micros::from_millis(1);
