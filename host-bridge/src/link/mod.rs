//! The wires that reach a gesture unit: a serial port, a TCP stream, a CAN bus, the unit's image in
//! QEMU, or none at all.

mod address;
pub mod bus;
mod inside;
mod qemu;
mod serial;
mod tcp;

use std::io;
use std::time::Duration;

use deictic_core::can::FlexibleFrame;
use deictic_core::protocol::seal::Key;

pub use address::{Address, AddressError, Line, LineError};
pub use inside::Inside;
pub use qemu::{Emulation, IMAGE_VARIABLE, QEMU};
pub use serial::Pair;

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

    /// What the other end must show to have; without it anybody is believed.
    fn key(&self) -> Option<Key> {
        None
    }
}

/// A wire to a unit that must have this key.
pub struct Locked {
    /// The wire.
    pub wire: Box<dyn Wire>,
    /// The key.
    pub key: Key,
}

impl Wire for Locked {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.wire.write(bytes)
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        self.wire.read(buffer, patience)
    }

    fn key(&self) -> Option<Key> {
        Some(self.key.clone())
    }
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
    /// The CAN bus cannot be used.
    #[error("cannot use the CAN bus {bus}")]
    #[diagnostic(help(
        "`ip link` shows the interfaces; a real one needs `ip link set can0 up type can bitrate 1000000`, a virtual \
         one `ip link add vcan0 type vcan` and `ip link set vcan0 up`"
    ))]
    Bus {
        /// The interface, or the adapter's line.
        bus: String,
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
    Ok([Box::new(board), sensor])
}

/// Opens the wire to a unit.
///
/// # Errors
/// [`WireError`] with what to do about it.
pub fn open(address: &Address) -> Result<Box<dyn Wire>, WireError> {
    Ok(match address {
        Address::Line(line) => open_line(line)?,
        Address::Can(interface) => Box::new(bus::Node::new(open_interface(interface)?)),
        Address::Slcan(line) => Box::new(bus::Node::new(open_adapter(line)?)),
        Address::Qemu { sensor } => Box::new(qemu::Board::boot(*sensor)?),
        Address::Inside => Box::new(Inside::start()),
    })
}

/// Opens a stream of bytes.
///
/// # Errors
/// [`WireError`] with what to do about it.
pub fn open_line(line: &Line) -> Result<Box<dyn Wire>, WireError> {
    Ok(match line {
        Line::Serial { path, baud } => Box::new(serial::Port::open(path, *baud)?),
        Line::Tcp { host, port } => Box::new(tcp::Stream::open(host, *port)?),
    })
}

/// A stream that somebody has opened to us.
///
/// # Errors
/// When the stream is gone already.
pub fn over(stream: std::net::TcpStream) -> io::Result<Box<dyn Wire>> {
    Ok(Box::new(tcp::Stream::over(stream)?))
}

/// Opens the bus behind a LAWICEL adapter at a line.
///
/// # Errors
/// [`WireError`] with what to do about it.
pub fn open_adapter(line: &Line) -> Result<Box<dyn bus::Bus>, WireError> {
    let wire = open_line(line)?;
    match bus::Client::open(wire) {
        Ok(client) => Ok(Box::new(client)),
        Err(cause) => Err(WireError::Bus {
            bus: line.to_string(),
            cause,
        }),
    }
}

/// Opens a CAN interface of this machine, for classic frames.
///
/// # Errors
/// [`WireError`] with what to do about it.
pub fn open_interface(interface: &str) -> Result<Box<dyn bus::Bus>, WireError> {
    open_socket(interface, |socket| Box::new(socket))
}

/// Opens a CAN interface of this machine, for frames of CAN FD and classic ones.
///
/// # Errors
/// [`WireError`] with what to do about it.
pub fn open_flexible_interface(
    interface: &str,
) -> Result<Box<dyn bus::Bus<FlexibleFrame>>, WireError> {
    open_socket(interface, |socket| Box::new(socket))
}

fn open_socket<B>(interface: &str, boxed: fn(bus::Socket) -> B) -> Result<B, WireError> {
    bus::Socket::open(interface)
        .map(boxed)
        .map_err(|cause| WireError::Bus {
            bus: interface.to_owned(),
            cause,
        })
}
