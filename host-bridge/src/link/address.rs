//! Where a unit is, as it is written on a command line.

use std::fmt;
use std::str::FromStr;

/// Bits per second of a serial port when none are given: what the unit's firmware uses.
const BAUD: u32 = 921_600;

/// Where a unit is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Address {
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
    /// An emulated board that is started for the purpose: `qemu`.
    Qemu,
    /// The unit's state machine in this process, without a board: `inside`.
    Inside,
}

/// An address that cannot be understood.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is not the address of a unit; write serial:/dev/ttyACM0, serial:/dev/ttyACM0@921600, \
     tcp:127.0.0.1:7700, qemu, or inside for none at all"
)]
pub struct AddressError(String);

impl FromStr for Address {
    type Err = AddressError;

    fn from_str(written: &str) -> Result<Self, AddressError> {
        let error = || AddressError(written.to_owned());
        match written {
            "qemu" => return Ok(Self::Qemu),
            "inside" => return Ok(Self::Inside),
            _ => {}
        }
        let (kind, rest) = written.split_once(':').ok_or_else(error)?;
        match kind {
            "serial" => {
                let (path, baud) = match rest.rsplit_once('@') {
                    Some((path, baud)) => (path, baud.parse().map_err(|_| error())?),
                    None => (rest, BAUD),
                };
                if path.is_empty() || baud == 0 {
                    return Err(error());
                }
                Ok(Self::Serial {
                    path: path.to_owned(),
                    baud,
                })
            }
            "tcp" => {
                let (host, port) = rest.rsplit_once(':').ok_or_else(error)?;
                let port = port.parse().map_err(|_| error())?;
                if host.is_empty() {
                    return Err(error());
                }
                Ok(Self::Tcp {
                    host: host.to_owned(),
                    port,
                })
            }
            _ => Err(error()),
        }
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Serial { path, baud } => write!(f, "serial:{path}@{baud}"),
            Self::Tcp { host, port } => write!(f, "tcp:{host}:{port}"),
            Self::Qemu => write!(f, "qemu"),
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
            "qemu",
            "inside",
        ] {
            assert_eq!(written.parse::<Address>().unwrap().to_string(), written);
        }
        let short: Address = "serial:/dev/ttyACM0".parse().unwrap();
        assert_eq!(short.to_string(), "serial:/dev/ttyACM0@921600");
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        for written in [
            "",
            "usb:1",
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
