use deictic_core::gesture::mapping::STROKES;
use deictic_core::gesture::stroke::Likely;
use deictic_core::time::Micros;
use deictic_core::unit::Statistics;
use embedded_io::{Read, ReadReady, Write, WriteReady};

use crate::Turn;

/// What the loop needs of a board.
pub trait Board {
    /// Stream of frames to and from the host bridge. Neither direction may lose a byte it has accepted silently: what
    /// is lost is counted by the board and the frame's CRC rejects the rest.
    type Link: Read + ReadReady + Write + WriteReady;
    /// Stream of bytes from the hand sensor.
    type Sensor: Read + ReadReady;

    /// The link to the host bridge.
    fn link(&mut self) -> &mut Self::Link;

    /// The link to the hand sensor.
    fn sensor(&mut self) -> &mut Self::Sensor;

    /// What a sensor that recognises gestures by itself has recognised ([`crate::recogniser`]). Called once a turn. A
    /// board without such a sensor's bus leaves it.
    fn recognised(&mut self, _now: Micros) -> Option<Likely<STROKES>> {
        None
    }

    /// When [`Board::recognised`] has something to do again.
    fn next_look(&self) -> Micros {
        Micros::NEVER
    }

    /// Microseconds since the board started. Never runs backwards.
    fn now(&mut self) -> Micros;

    /// Tells the watchdog that the loop is alive. Called once a turn.
    fn feed(&mut self);

    /// Sleeps until a link has something to do, or until the moment `until`, whichever is first. May return early.
    /// Must return in time for the watchdog to be fed.
    fn sleep(&mut self, until: Micros);

    /// Logs what a turn did, given the unit's counts after it. Must not block.
    fn log(&mut self, turn: Turn, statistics: Statistics);
}
