//! Long operation of the image on an emulated board whose time passes many times as fast as ours, on a line that does
//! everything wrong, with a board that is restarted and frozen, a robot that dies, a table that changes, and clocks that
//! jump.

mod board;
mod figures;

pub use board::{Cable, HASTE, has_image};
pub use figures::{Figures, soak};
