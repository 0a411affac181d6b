//! The wires that reach a gesture unit: a serial port, a TCP stream, the unit's image in
//! QEMU, or none at all.

mod address;
mod inside;
mod qemu;
mod serial;
mod tcp;

use std::io;
use std::time::Duration;

pub use address::{Address, AddressError};
pub use inside::Inside;
pub use qemu::{IMAGE_VARIABLE, QEMU};

/// A stream of bytes to a unit and back.
pub trait Wire: Send {
    /// Gives all of `bytes` to the unit.
    ///
    /// # Errors
    /// When the wire is gone; what it carried before is then unknown.
    fn write(&mut self, bytes: &[u8]) -> io::Result<()>;

    /// Puts what the unit said into `buffer`, waiting up to `patience` for the first byte, and gives
    /// how many bytes that were; 0 when none came.
    ///
    /// # Errors
    /// When the wire is gone.
    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize>;
}

/// A wire could not be opened.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum WireError {
    /// The serial port cannot be used.
    #[error("cannot open the serial port {path}")]
    #[diagnostic(help("{}", serial::remedy(.path)))]
    Serial {
        /// The port's path.
        path: String,
        /// What the system said.
        #[source]
        cause: serialport::Error,
    },
    /// Nobody listens at the address.
    #[error("cannot reach {address}")]
    #[diagnostic(help(
        "start the unit, or `cargo xtask qemu` for one in QEMU, and look at the port it names"
    ))]
    Tcp {
        /// Host and port.
        address: String,
        /// What the system said.
        #[source]
        cause: io::Error,
    },
    /// QEMU could not be started.
    #[error("cannot start {QEMU}")]
    #[diagnostic(help("`cargo xtask setup` installs it"))]
    NoQemu(#[source] io::Error),
    /// There is no image to boot.
    #[error("there is no image of the unit for QEMU at {path}")]
    #[diagnostic(help(
        "`cargo xtask firmware` builds it; {IMAGE_VARIABLE} names one that lies elsewhere"
    ))]
    NoImage {
        /// Where it was looked for.
        path: String,
    },
    /// QEMU started but its board did not open its link.
    #[error("QEMU runs, but the board in it does not open its link")]
    #[diagnostic(help("try `cargo xtask qemu`, which shows what the board says"))]
    Silent(#[source] io::Error),
}

/// Boots an emulated board and opens the wires to its host link and to its hand sensor's, in this
/// order.
///
/// # Errors
/// [`WireError`] with what to do about it.
pub fn open_with_sensor() -> Result<[Box<dyn Wire>; 2], WireError> {
    let (board, sensor) = qemu::Board::boot_with_sensor()?;
    Ok([Box::new(board), Box::new(sensor)])
}

/// Opens the wire to a unit.
///
/// # Errors
/// [`WireError`] with what to do about it.
pub fn open(address: &Address) -> Result<Box<dyn Wire>, WireError> {
    match address {
        Address::Serial { path, baud } => Ok(Box::new(serial::Port::open(path, *baud)?)),
        Address::Tcp { host, port } => Ok(Box::new(tcp::Stream::open(host, *port)?)),
        Address::Qemu => Ok(Box::new(qemu::Board::boot()?)),
        Address::Inside => Ok(Box::new(Inside::start())),
    }
}
