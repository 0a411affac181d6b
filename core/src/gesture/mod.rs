//! From a hand to a gesture sentence.

pub mod evidence;
pub mod frame;
pub mod path;
pub mod pointing;
pub mod shape;
pub mod shape_table;
pub mod stroke;
pub mod vector;
pub mod wire;
