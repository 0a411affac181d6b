//! Time, always an argument: the core has no clock.

use serde::{Deserialize, Serialize};

/// Microseconds of a monotonic clock since an arbitrary start. 64 bits never wrap (584,000 years).
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
pub struct Micros(pub u64);

impl Micros {
    /// A moment that never comes.
    pub const NEVER: Self = Self(u64::MAX);

    /// A number of milliseconds.
    #[must_use]
    pub const fn from_millis(ms: u64) -> Self {
        Self(ms.saturating_mul(1_000))
    }

    /// This moment and `span` later.
    #[must_use]
    pub const fn after(self, span: Self) -> Self {
        Self(self.0.saturating_add(span.0))
    }

    /// How long since `earlier`; 0 when the clock ran backwards.
    #[must_use]
    pub const fn since(self, earlier: Self) -> Self {
        Self(self.0.saturating_sub(earlier.0))
    }
}
