//! A unit at a serial port.

use std::fs::File;
use std::io::{self, ErrorKind};
use std::os::unix::fs::OpenOptionsExt;
use std::time::Duration;

use serialport::{SerialPort, TTYPort};

use super::{Wire, WireError};

/// An open port.
pub struct Port(Box<dyn SerialPort>);

impl Port {
    /// Opens it with 8 data bits, no parity, one stop bit, no flow control.
    pub fn open(path: &str, baud: u32) -> Result<Self, WireError> {
        let port = serialport::new(path, baud)
            .timeout(Duration::from_secs(3))
            .open();
        port.map(Self).map_err(|cause| WireError::Serial {
            path: path.to_owned(),
            cause,
        })
    }
}

/// How long a port may take no byte: at 115,200 baud 2,000 bytes go in 200 ms, and an emulated board on a busy machine has
/// been seen not to read for that long. A robot that hears nothing for 350 ms stands still by itself.
const WRITING: Duration = Duration::from_millis(500);

/// A pseudo-terminal: what one side writes, a program that opens the other side reads.
pub struct Pair {
    ours: TTYPort,
    path: String,
    /// The other side, held open, so that a program that goes does not seem to pull the cable.
    _theirs: File,
}

/// `O_NOCTTY`: a terminal that is opened does not become ours.
const NOT_OURS: i32 = 0x100;

impl Pair {
    /// A new one.
    ///
    /// # Errors
    /// When the system has none.
    pub fn open() -> io::Result<Self> {
        let (ours, mut theirs) = TTYPort::pair()?;
        theirs.set_exclusive(false)?;
        let path = theirs.name().unwrap_or_default();
        let held = File::options()
            .read(true)
            .write(true)
            .custom_flags(NOT_OURS)
            .open(&path)?;
        Ok(Self {
            ours,
            path,
            _theirs: held,
        })
    }

    /// What a program opens as a serial port.
    #[must_use]
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Our side.
    ///
    /// # Errors
    /// When the system has no more files.
    pub fn wire(&self) -> io::Result<Box<dyn Wire>> {
        let ours = self.ours.try_clone_native()?;
        Ok(Box::new(Port(Box::new(ours))))
    }
}

impl Wire for Port {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.0.set_timeout(WRITING)?;
        self.0.write_all(bytes)
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        self.0.set_timeout(patience)?;
        match self.0.read(buffer) {
            Ok(0) => Err(ErrorKind::UnexpectedEof.into()),
            // A signal, as Ctrl-C sends one, interrupts the waiting only.
            Err(e) if matches!(e.kind(), ErrorKind::TimedOut | ErrorKind::Interrupted) => Ok(0),
            other => other,
        }
    }
}

/// What to do about a port that cannot be opened.
pub(super) fn remedy(path: &str) -> String {
    let advice = "is the board plugged in, and may you use the port? Membership in the group \
                  `dialout` gives the right on Debian";
    match serialport::available_ports() {
        Ok(ports) if !ports.is_empty() => {
            let names: Vec<String> = ports
                .into_iter()
                .map(|p| p.port_name)
                .filter(|p| p != path)
                .collect();
            format!("{advice}; other ports here: {}", names.join(", "))
        }
        _ => format!("{advice}; no serial port was found here"),
    }
}
