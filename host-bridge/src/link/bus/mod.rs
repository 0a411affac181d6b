//! CAN buses: a Linux network interface, or an adapter at the end of a serial line.

mod adapter;
mod client;
mod node;
mod reading;
#[cfg(target_os = "linux")]
mod socket;

use std::io;
use std::time::Duration;

use deictic_core::can::Frame;

pub use adapter::Adapter;
pub use client::Client;
pub use node::Node;
#[cfg(target_os = "linux")]
pub use socket::Socket;

/// A node on a bus.
pub trait Bus: Send {
    /// Gives a frame to the bus.
    ///
    /// # Errors
    /// [`BusFault`] inside, where it is one; the frame was then not sent.
    fn send(&mut self, frame: &Frame) -> io::Result<()>;

    /// A frame from another node, waiting up to `patience` for it; `None` when none came.
    ///
    /// # Errors
    /// [`BusFault`] inside, where it is one.
    fn receive(&mut self, patience: Duration) -> io::Result<Option<Frame>>;
}

/// What can be wrong with a bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BusFault {
    /// The controller has left the bus after too many errors.
    #[error(
        "the CAN controller has left the bus after too many errors: look at the cable, the bit rate \
         and the two resistors of 120 ohm; `ip link set can0 type can restart` brings it back"
    )]
    Off,
    /// Nobody takes the frames, so that the queue before the controller is full.
    #[error("the CAN queue is full and nobody takes the frames: is another node on the bus?")]
    Full,
    /// The adapter does not do what it is told.
    #[error("the adapter refuses to send: is its bus open and alive?")]
    Refused,
    /// The interface is not there any more, or is switched off.
    #[error("the CAN interface is down: `ip link set can0 up` brings it back")]
    Down,
}

impl BusFault {
    /// The fault inside an error, if it is one of the bus.
    #[must_use]
    pub fn within(error: &io::Error) -> Option<Self> {
        error.get_ref()?.downcast_ref().copied()
    }
}

impl From<BusFault> for io::Error {
    fn from(fault: BusFault) -> Self {
        Self::new(io::ErrorKind::BrokenPipe, fault)
    }
}
