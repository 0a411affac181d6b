//! Values that the compiler cannot know.

use core::hint::black_box;

/// Anything at all.
pub fn any<T: Copy>(value: T) -> T {
    black_box(value)
}
