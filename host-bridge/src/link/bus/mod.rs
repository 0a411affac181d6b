//! CAN buses: a Linux network interface, or an adapter at the end of a serial line.

mod adapter;
mod client;
mod node;
mod reading;
#[cfg_attr(not(target_os = "linux"), path = "no_socket.rs")]
mod socket;

use std::io;
use std::time::Duration;

use deictic_core::can::Frame;

pub use adapter::Adapter;
pub use client::Client;
pub use node::Node;
pub use socket::Socket;

/// A node on a bus whose frames are of kind `F`.
pub trait Bus<F = Frame>: Send {
    /// Gives a frame to the bus.
    ///
    /// # Errors
    /// [`BusFault`] inside, where it is one; the frame was then not sent.
    fn send(&mut self, frame: &F) -> io::Result<()>;

    /// A frame from another node, waiting up to `patience` for it; `None` when none came.
    ///
    /// # Errors
    /// [`BusFault`] inside, where it is one.
    fn receive(&mut self, patience: Duration) -> io::Result<Option<F>>;
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
    /// The interface, or its controller, has classic frames only.
    #[error(
        "the interface takes classic frames only: `ip link set can0 type can bitrate 1000000 dbitrate 5000000 fd on` \
         switches CAN FD on (`ip link set vcan0 mtu 72` a virtual one), or leave out `,fd`"
    )]
    Classic,
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
