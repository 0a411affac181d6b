//! Where a robot is, and how it is reached.

use std::fmt;
use std::str::FromStr;

use deictic_core::protocol::seal::Key;

use super::Robot;
use super::fci::{Fci, FciFault};
use super::sim::Sim;
use super::way::{self, Way};
use crate::vocabulary::Lexicon;

/// Where a robot is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Address {
    /// The simulated Panda in this process: `sim`.
    Sim,
    /// A Panda or Research 3 on its own network interface: `fci:172.16.0.2`, or
    /// `fci:172.16.0.2,no-realtime` on a machine without real-time scheduling.
    Fci {
        /// Name or number of the arm's control.
        host: String,
        /// Whether this machine must do real time.
        realtime: bool,
    },
    /// One that speaks the command set: `can:can0`, `slcan:/dev/ttyACM0`, `serial:/dev/ttyACM0`,
    /// `tcp:127.0.0.1:7700`.
    Over(Way),
}

/// An address that cannot be understood.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is not the address of a robot; write sim, can:can0, slcan:/dev/ttyACM0, serial:/dev/ttyACM0, \
     tcp:127.0.0.1:7700, fci:172.16.0.2, or fci:172.16.0.2,no-realtime"
)]
pub struct AddressError(String);

/// A robot cannot be reached.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum RobotError {
    /// Its own network interface says why.
    #[error("{0}")]
    #[diagnostic(help("{}", .0.remedy()))]
    Fci(FciFault),
    /// It cannot be reached over its link.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Over(#[from] way::ReachError),
}

/// What is written behind a host that may be commanded without real time.
const NO_REALTIME: &str = ",no-realtime";

impl FromStr for Address {
    type Err = AddressError;

    fn from_str(written: &str) -> Result<Self, AddressError> {
        let error = || AddressError(written.to_owned());
        if written == "sim" {
            return Ok(Self::Sim);
        }
        let Some(rest) = written.strip_prefix("fci:") else {
            return written.parse().map(Self::Over).map_err(|_| error());
        };
        let host = rest.strip_suffix(NO_REALTIME).unwrap_or(rest);
        if host.is_empty() || host.contains(',') {
            return Err(error());
        }
        Ok(Self::Fci {
            host: host.to_owned(),
            realtime: host == rest,
        })
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sim => write!(f, "sim"),
            Self::Fci { host, realtime } => {
                write!(f, "fci:{host}{}", if *realtime { "" } else { NO_REALTIME })
            }
            Self::Over(way) => way.fmt(f),
        }
    }
}

/// Reaches a robot; a simulated one in this process moves `haste` times as fast as a careful one, and one over a link has
/// this key, where one is given.
///
/// # Errors
/// [`RobotError`] with what to do about it.
pub fn reach(
    address: &Address,
    lexicon: &Lexicon,
    haste: f32,
    key: Option<&Key>,
) -> Result<Box<dyn Robot>, RobotError> {
    Ok(match address {
        Address::Sim => Box::new(Sim::new(haste)),
        Address::Fci { host, realtime } => {
            Box::new(Fci::connect(host, host, *realtime).map_err(RobotError::Fci)?)
        }
        Address::Over(way) => Box::new(way::reach(way, lexicon, key)?),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for written in [
            "sim",
            "fci:172.16.0.2",
            "fci:panda,no-realtime",
            "can:vcan0",
        ] {
            assert_eq!(written.parse::<Address>().unwrap().to_string(), written);
        }
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        for written in [
            "",
            "panda",
            "fci:",
            "fci:,no-realtime",
            "fci:a,b",
            "simulated",
            "can:",
        ] {
            assert!(written.parse::<Address>().is_err(), "{written}");
        }
    }
}
