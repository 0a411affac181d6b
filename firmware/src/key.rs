//! The key that the board was flashed with.

use deictic_core::board::Unit;
use deictic_core::protocol::seal::{KEY, Key};

/// What `build.rs` made of DEICTIC_KEY.
const BYTES: Option<[u8; KEY]> = include!(concat!(env!("OUT_DIR"), "/key.rs"));

/// Has the unit listen only to whoever shows to have the board's own key; a board that was flashed without one listens
/// to anybody.
#[inline(never)]
pub fn lock(unit: &mut Unit) {
    if let Some(key) = BYTES.as_ref().and_then(Key::new) {
        unit.lock(key);
    }
}
