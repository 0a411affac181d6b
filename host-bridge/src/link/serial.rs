//! A unit at a serial port.

use std::io::{self, ErrorKind};
use std::time::Duration;

use serialport::SerialPort;

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

impl Wire for Port {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.0.write_all(bytes)
    }

    fn read(&mut self, buffer: &mut [u8], patience: Duration) -> io::Result<usize> {
        self.0.set_timeout(patience)?;
        match self.0.read(buffer) {
            Ok(0) => Err(ErrorKind::UnexpectedEof.into()),
            Err(e) if e.kind() == ErrorKind::TimedOut => Ok(0),
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
