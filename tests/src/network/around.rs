//! What a session is in the midst of: a unit, the line to it, and time.

use deictic_core::large::Intent;
use deictic_core::time::Micros;

use super::line::Faults;

/// A unit and its line, simulated or emulated, and what can go wrong with them.
pub trait Around {
    /// The present moment.
    fn now(&self) -> Micros;

    /// The bridge listens anew.
    fn opened(&self) {}

    /// When a whole frame last came to the host.
    fn heard(&self) -> Micros;

    /// Whether the unit has told this to be done on this scene; each time that it did counts once.
    fn redeem(&self, scene: u32, intent: &Intent) -> bool;

    /// From now on both directions of the line have these faults.
    fn set_faults(&self, faults: Faults);

    /// From now on the line takes so many bytes a millisecond, where it can be narrowed.
    fn narrow(&self, width: usize);

    /// The unit starts anew, as after a power cut.
    fn restart(&self);

    /// The cable is out for so long; `more` bytes of what is under way still come.
    fn pull(&self, span: Micros, more: usize);

    /// The unit does nothing for so long.
    fn freeze(&self, span: Micros);

    /// The unit's clock and the host's jump apart.
    fn jump(&self, span: Micros);

    /// The host does nothing for so long.
    fn sleep(&self, span: Micros);
}
