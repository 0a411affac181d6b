//! Over what the command set is spoken, and how a robot is reached there.

use std::fmt;
use std::io;
use std::str::FromStr;
use std::time::Duration;

use deictic_core::command::parcel::Sender;
use deictic_core::command::seal::{ON_A_BUS, ON_A_STREAM};
use deictic_core::protocol::seal::Key;

use super::remote::{Carrier, Gate, OnBus, OnWire, Opener, Remote};
use crate::link::{self, Line, WireError};
use crate::vocabulary::Lexicon;

/// How long a robot may take to show that it lives.
const PATIENCE: Duration = Duration::from_secs(3);

/// Over what the command set is spoken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Way {
    /// A CAN bus of this machine: `can:can0`.
    Can(String),
    /// The same in frames of CAN FD: `can:can0,fd`.
    Flexible(String),
    /// A CAN bus behind a LAWICEL adapter: `slcan:/dev/ttyACM0`, `slcan:tcp:127.0.0.1:7700`.
    Slcan(Line),
    /// A stream: `serial:/dev/ttyACM0`, `tcp:127.0.0.1:7700`.
    Line(Line),
}

/// A way that cannot be understood.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is not a link that the command set goes over; write can:can0, can:can0,fd, slcan:/dev/ttyACM0, serial:/dev/ttyACM0 or \
     tcp:127.0.0.1:7700"
)]
pub struct WayError(String);

/// A robot cannot be reached over a link.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum ReachError {
    /// The link to it cannot be opened.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Wire(#[from] WireError),
    /// Nobody listens at its port.
    #[error("cannot reach the robot at {way}")]
    #[diagnostic(help(
        "is it switched on? `deictic robot-sim --listen {way}` starts a simulated one"
    ))]
    NotListening {
        /// Where it was to be.
        way: Way,
        /// What the system said.
        #[source]
        cause: io::Error,
    },
    /// The link failed at once.
    #[error("the link to the robot at {way} fails")]
    #[diagnostic(help("look at the cable"))]
    Broken {
        /// Where it was to be.
        way: Way,
        /// What the system said.
        #[source]
        cause: io::Error,
    },
    /// Nobody answers over it.
    #[error("no robot answers at {0}")]
    #[diagnostic(help(
        "is it switched on, is it the right link, and does no other bridge use it? `deictic robot-sim --listen` \
         starts a simulated one"
    ))]
    Silent(Way),
    /// It listens only to who has its key.
    #[error("the robot at {0} listens only to a bridge that has its key")]
    #[diagnostic(help("give the key that the robot was started with: --robot-key FILE"))]
    WantsKey(Way),
    /// It does not ask for a key, and what it says is not sealed.
    #[error("whoever answers at {0} does not have the robot's key")]
    #[diagnostic(help(
        "start the robot with the key (`deictic robot-sim --key FILE`), or leave --robot-key out, with \
         --insecure-robot, when nobody else can reach the link"
    ))]
    NoKey(Way),
    /// It asks for another key.
    #[error("the robot at {0} has another key")]
    #[diagnostic(help("give the key that the robot was started with: --robot-key FILE"))]
    OtherKey(Way),
    /// There is nothing random here to prove with.
    #[error("the link to the robot cannot be sealed")]
    #[diagnostic(help("this machine gives no random numbers"))]
    NoChance(#[source] io::Error),
}

impl Way {
    /// How many bytes the tags of sealed messages have on it.
    #[must_use]
    pub fn tag(&self) -> usize {
        match self {
            Self::Can(_) | Self::Flexible(_) | Self::Slcan(_) => ON_A_BUS,
            Self::Line(_) => ON_A_STREAM,
        }
    }
}

impl FromStr for Way {
    type Err = WayError;

    fn from_str(written: &str) -> Result<Self, WayError> {
        let error = || WayError(written.to_owned());
        match written.split_once(':') {
            Some(("can", rest)) => match rest.split_once(',') {
                None if !rest.is_empty() => Ok(Self::Can(rest.to_owned())),
                Some((interface, "fd")) if !interface.is_empty() => {
                    Ok(Self::Flexible(interface.to_owned()))
                }
                _ => Err(error()),
            },
            Some(("slcan", line)) => Line::of_adapter(line).map(Self::Slcan).ok_or_else(error),
            _ => written.parse().map(Self::Line).map_err(|_| error()),
        }
    }
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Can(interface) => write!(f, "can:{interface}"),
            Self::Flexible(interface) => write!(f, "can:{interface},fd"),
            Self::Slcan(line) => write!(f, "slcan:{line}"),
            Self::Line(line) => line.fmt(f),
        }
    }
}

/// Reaches a robot that speaks the command set; one that has this key, where one is given.
///
/// # Errors
/// [`ReachError`] with what to do about it.
pub fn reach(way: &Way, lexicon: &Lexicon, key: Option<&Key>) -> Result<Remote, ReachError> {
    // Opened once here for an error with a remedy; later failures only mean to try again.
    let first = carrier(way).map_err(|error| match error {
        WireError::Tcp { cause, .. } => ReachError::NotListening {
            way: way.clone(),
            cause,
        },
        other => other.into(),
    })?;
    let mut first = Some(first);
    let again = way.clone();
    let opener: Opener = Box::new(move || match first.take() {
        Some(carrier) => Ok(carrier),
        None => carrier(&again).map_err(io::Error::other),
    });
    let broken = |cause| ReachError::Broken {
        way: way.clone(),
        cause,
    };
    let gate = Gate::new(Sender::Host, key, way.tag()).map_err(ReachError::NoChance)?;
    let mut remote = Remote::behind(gate, opener, lexicon).map_err(broken)?;
    if remote.wait(PATIENCE).is_ok() {
        return Ok(remote);
    }
    let at = way.clone();
    Err(match remote.gate().guard() {
        None if remote.wants_key() => ReachError::WantsKey(at),
        Some(guard) if guard.is_challenged() => ReachError::OtherKey(at),
        Some(guard) if guard.refused().all() > 0 => ReachError::NoKey(at),
        _ => ReachError::Silent(at),
    })
}

/// Opens the link to a robot.
///
/// # Errors
/// [`WireError`] with what to do about it.
pub fn carrier(way: &Way) -> Result<Box<dyn Carrier>, WireError> {
    let on_bus = |bus| Box::new(OnBus::new(bus, Sender::Host)) as Box<dyn Carrier>;
    match way {
        Way::Can(interface) => link::open_interface(interface).map(on_bus),
        Way::Flexible(interface) => {
            let bus = link::open_flexible_interface(interface)?;
            Ok(Box::new(OnBus::new(bus, Sender::Host)))
        }
        Way::Slcan(line) => link::open_adapter(line).map(on_bus),
        Way::Line(line) => Ok(Box::new(OnWire::new(link::open_line(line)?))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for written in [
            "can:vcan0",
            "can:vcan0,fd",
            "slcan:serial:/dev/ttyS0@115200",
            "slcan:tcp:127.0.0.1:7700",
            "serial:/dev/ttyACM0@921600",
            "tcp:127.0.0.1:7700",
        ] {
            assert_eq!(written.parse::<Way>().unwrap().to_string(), written);
        }
        for written in [
            "",
            "can:",
            "can:,fd",
            "can:vcan0,xl",
            "sim",
            "slcan:",
            "tcp:x",
            "qemu",
        ] {
            assert!(written.parse::<Way>().is_err(), "{written}");
        }
    }
}
