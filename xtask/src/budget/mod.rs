//! Budgets: what the image takes, measured on the image itself.

mod function;
mod golden;
mod high_water;
mod image;
mod instructions;
mod stack;
mod thumb;

pub use golden::{Figures, Golden};
pub use high_water::high_water;
pub use image::Image;
pub use instructions::count;
pub use stack::{WorstCase, worst_case};
