//! What the log says of each turn: only what changed.

use deictic_core::unit::Statistics;

use crate::Turn;

/// What was last logged.
#[derive(Default)]
pub(crate) struct Journal {
    lost: u32,
    statistics: Statistics,
}

impl Journal {
    /// Logs what is new after a turn. `lost` counts the bytes that the host link could not hold.
    pub(crate) fn note(&mut self, turn: Turn, statistics: Statistics, lost: u32) {
        if lost != self.lost {
            self.lost = lost;
            defmt::warn!(
                "{=u32} bytes from the host came faster than they were taken",
                lost
            );
        }
        if statistics.faults != self.statistics.faults {
            defmt::warn!("{=u32} faults told to the host", statistics.faults);
        }
        let decisions = |of: &Statistics| (of.executes, of.asks, of.repeats);
        if decisions(&statistics) != decisions(&self.statistics) {
            defmt::info!(
                "decided: {=u32} to execute, {=u32} to ask, {=u32} to repeat",
                statistics.executes,
                statistics.asks,
                statistics.repeats
            );
        }
        if turn.sensed > 0 {
            defmt::debug!("{=usize} bytes from the sensor", turn.sensed);
        }
        self.statistics = statistics;
    }
}
