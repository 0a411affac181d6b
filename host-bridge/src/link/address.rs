//! Where a unit is, as it is written on a command line.

use std::fmt;
use std::str::FromStr;

/// Bits per second of a serial port when none are given: what the unit's firmware uses.
const BAUD: u32 = 921_600;

/// A stream of bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Line {
    /// A serial port: `serial:/dev/ttyACM0` or `serial:/dev/ttyACM0@115200`.
    Serial {
        /// The port's path or name.
        path: String,
        /// Bits per second.
        baud: u32,
    },
    /// A TCP stream: `tcp:127.0.0.1:7700`.
    Tcp {
        /// Name or number of the host.
        host: String,
        /// Its port.
        port: u16,
    },
}

/// A line that cannot be understood.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is not a line; write serial:/dev/ttyACM0, serial:/dev/ttyACM0@921600 or tcp:127.0.0.1:7700"
)]
pub struct LineError(String);

impl FromStr for Line {
    type Err = LineError;

    fn from_str(written: &str) -> Result<Self, LineError> {
        let error = || LineError(written.to_owned());
        match written.split_once(':') {
            Some(("serial", rest)) => Self::port(rest).ok_or_else(error),
            Some(("tcp", rest)) => {
                let (host, port) = rest.rsplit_once(':').ok_or_else(error)?;
                let port = port.parse().map_err(|_| error())?;
                if host.is_empty() {
                    return Err(error());
                }
                let host = host.to_owned();
                Ok(Self::Tcp { host, port })
            }
            _ => Err(error()),
        }
    }
}

impl Line {
    /// A serial port: `/dev/ttyACM0` or `/dev/ttyACM0@115200`.
    fn port(written: &str) -> Option<Self> {
        let (path, baud) = match written.rsplit_once('@') {
            Some((path, baud)) => (path, baud.parse().ok()?),
            None => (written, BAUD),
        };
        if path.is_empty() || baud == 0 {
            return None;
        }
        let path = path.to_owned();
        Some(Self::Serial { path, baud })
    }

    /// An adapter's line, behind `slcan:`: a serial port's path, or a stream written in full.
    pub(crate) fn of_adapter(written: &str) -> Option<Self> {
        if written.starts_with("tcp:") || written.starts_with("serial:") {
            return written.parse().ok();
        }
        Self::port(written)
    }
}

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Serial { path, baud } => write!(f, "serial:{path}@{baud}"),
            Self::Tcp { host, port } => write!(f, "tcp:{host}:{port}"),
        }
    }
}

/// Where a unit is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Address {
    /// At the end of a line: `serial:/dev/ttyACM0`, `tcp:127.0.0.1:7700`.
    Line(Line),
    /// On a CAN bus of this machine: `can:can0`.
    Can(String),
    /// On a CAN bus behind a LAWICEL adapter: `slcan:/dev/ttyACM0`, `slcan:tcp:127.0.0.1:7700`.
    Slcan(Line),
    /// An emulated board that is started for the purpose: `qemu`, or `qemu:7801` for one whose sensor line listens at
    /// that port of this machine.
    Qemu {
        /// The sensor line's port.
        sensor: Option<u16>,
    },
    /// The unit's state machine in this process, without a board: `inside`.
    Inside,
}

/// An address that cannot be understood.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is not the address of a unit; write serial:/dev/ttyACM0, serial:/dev/ttyACM0@921600, \
     tcp:127.0.0.1:7700, can:can0, slcan:/dev/ttyACM0, qemu, qemu:7801 (with a sensor line), or inside for none at all"
)]
pub struct AddressError(String);

impl FromStr for Address {
    type Err = AddressError;

    fn from_str(written: &str) -> Result<Self, AddressError> {
        let error = || AddressError(written.to_owned());
        match written.split_once(':') {
            None if written == "qemu" => Ok(Self::Qemu { sensor: None }),
            None if written == "inside" => Ok(Self::Inside),
            Some(("can", interface)) if !interface.is_empty() => {
                Ok(Self::Can(interface.to_owned()))
            }
            Some(("qemu", port)) => match port.parse() {
                Ok(port) if port > 0 => Ok(Self::Qemu { sensor: Some(port) }),
                _ => Err(error()),
            },
            Some(("slcan", line)) => Line::of_adapter(line).map(Self::Slcan).ok_or_else(error),
            _ => written.parse().map(Self::Line).map_err(|_| error()),
        }
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => line.fmt(f),
            Self::Can(interface) => write!(f, "can:{interface}"),
            Self::Slcan(line) => write!(f, "slcan:{line}"),
            Self::Qemu { sensor: None } => write!(f, "qemu"),
            Self::Qemu { sensor: Some(port) } => write!(f, "qemu:{port}"),
            Self::Inside => write!(f, "inside"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for written in [
            "serial:/dev/ttyACM0@115200",
            "tcp:127.0.0.1:7700",
            "tcp:[::1]:7700",
            "can:vcan0",
            "slcan:serial:/dev/ttyACM0@115200",
            "slcan:tcp:127.0.0.1:7700",
            "qemu",
            "qemu:7801",
            "inside",
        ] {
            assert_eq!(written.parse::<Address>().unwrap().to_string(), written);
        }
        let short: Address = "serial:/dev/ttyACM0".parse().unwrap();
        assert_eq!(short.to_string(), "serial:/dev/ttyACM0@921600");
        let short: Address = "slcan:/dev/ttyACM0".parse().unwrap();
        assert_eq!(short.to_string(), "slcan:serial:/dev/ttyACM0@921600");
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        for written in [
            "",
            "usb:1",
            "can:",
            "slcan:",
            "qemu:",
            "qemu:0",
            "slcan:tcp:here",
            "tcp:here",
            "tcp::7700",
            "tcp:here:70000",
            "serial:",
            "serial:/dev/x@0",
            "serial:/dev/x@fast",
        ] {
            assert!(written.parse::<Address>().is_err(), "{written}");
        }
    }
}
