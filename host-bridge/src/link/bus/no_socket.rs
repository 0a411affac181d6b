//! What stands for a CAN interface where the system has none: it cannot be opened.

use std::io::{self, ErrorKind};
use std::time::Duration;

use super::Bus;

/// An open interface, of which there is none.
pub enum Socket {}

impl Socket {
    /// Opens nothing.
    ///
    /// # Errors
    /// Always.
    pub fn open(_interface: &str) -> io::Result<Self> {
        Err(ErrorKind::Unsupported.into())
    }
}

impl<F> Bus<F> for Socket {
    fn send(&mut self, _frame: &F) -> io::Result<()> {
        match *self {}
    }

    fn receive(&mut self, _patience: Duration) -> io::Result<Option<F>> {
        match *self {}
    }
}
