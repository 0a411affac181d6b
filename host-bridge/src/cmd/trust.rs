//! Who is believed: the key that the unit was flashed with, and what is moved without one.

use std::path::{Path, PathBuf};

use clap::Args;
use deictic_core::protocol::seal::{KEY, Key};
use miette::Diagnostic;
use thiserror::Error;

use crate::link::{self, Address, Locked, Wire};
use crate::robot;
use crate::unit::Opener;

/// Who is believed.
#[derive(Args, Clone, Debug, Default)]
pub struct Trust {
    /// The key that the unit was flashed with: a file of 64 hexadecimal digits; `cargo xtask key` makes one
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
    /// The key that the robot behind a link was started with: a file of the same form
    #[arg(long, value_name = "FILE")]
    robot_key: Option<PathBuf>,
    /// Let a robot move although the unit or the robot has no key, so that whoever reaches its line can speak for it
    #[arg(long)]
    insecure_robot: bool,
}

/// Why nobody is believed.
#[derive(Debug, Error, Diagnostic)]
pub enum TrustError {
    /// The file cannot be read.
    #[error("cannot read the key {}", .path.display())]
    #[diagnostic(help("`cargo xtask key {}` makes one", .path.display()))]
    File {
        /// Its path.
        path: PathBuf,
        /// What the system said.
        #[source]
        cause: std::io::Error,
    },
    /// The file holds something else.
    #[error("{} does not hold a key", .0.display())]
    #[diagnostic(help(
        "a key is 64 hexadecimal digits on one line; `cargo xtask key FILE` makes one"
    ))]
    NotAKey(PathBuf),
    /// A robot would move on the word of anybody.
    #[error(
        "there is no key, so anybody who reaches the line to the unit could move the robot {0}"
    )]
    #[diagnostic(help(
        "flash the unit with a key and give it here too (--key FILE; docs/threat-model.md), try it with --robot sim, or \
         say --insecure-robot when nobody else can reach the line"
    ))]
    NoKey(robot::address::Address),
    /// The robot would listen to anybody.
    #[error("there is no key for the robot, so anybody who reaches {0} could move it")]
    #[diagnostic(help(
        "start the robot with a key and give it here too (--robot-key FILE; docs/threat-model.md), or say \
         --insecure-robot when nobody else can reach the link"
    ))]
    NoRobotKey(robot::address::Address),
    /// There is no link for a key.
    #[error("--robot-key is for a robot that speaks the command set, and {0} does not")]
    #[diagnostic(help(
        "leave it out; only can:, slcan:, serial: and tcp: can be sealed (docs/robot.md)"
    ))]
    NoLink(robot::address::Address),
}

impl Trust {
    /// What opens wires to the unit at this address, before this robot.
    ///
    /// # Errors
    /// [`TrustError`]
    pub fn opener(
        &self,
        board: &Address,
        robot: &robot::address::Address,
    ) -> Result<Opener, TrustError> {
        let key = self.key.as_deref().map(read).transpose()?;
        let simulated = matches!(robot, robot::address::Address::Sim);
        // Nobody else reaches a unit that runs in this process, or in one that it starts.
        let own = matches!(board, Address::Inside | Address::Qemu { .. });
        if key.is_none() && !(simulated || own || self.insecure_robot) {
            return Err(TrustError::NoKey(robot.clone()));
        }
        let board = board.clone();
        Ok(Box::new(move || {
            let wire = link::open(&board)?;
            Ok(match &key {
                None => wire,
                Some(key) => Box::new(Locked {
                    wire,
                    key: key.clone(),
                }) as Box<dyn Wire>,
            })
        }))
    }
}

impl Trust {
    /// The key that the robot at this address must have.
    ///
    /// # Errors
    /// [`TrustError`]
    pub fn robot_key(&self, robot: &robot::address::Address) -> Result<Option<Key>, TrustError> {
        let key = self.robot_key.as_deref().map(read).transpose()?;
        let over_a_link = matches!(robot, robot::address::Address::Over(_));
        match (&key, over_a_link) {
            (Some(_), false) => Err(TrustError::NoLink(robot.clone())),
            (None, true) if !self.insecure_robot => Err(TrustError::NoRobotKey(robot.clone())),
            _ => Ok(key),
        }
    }
}

/// The key in a file.
///
/// # Errors
/// [`TrustError`]
pub fn read(path: &Path) -> Result<Key, TrustError> {
    let text = std::fs::read_to_string(path).map_err(|cause| TrustError::File {
        path: path.to_owned(),
        cause,
    })?;
    let not_a_key = || TrustError::NotAKey(path.to_owned());
    let digits = text.trim();
    let byte = |at| u8::from_str_radix(digits.get(at..at + 2)?, 16).ok();
    let bytes: Option<Vec<u8>> = (0..digits.len()).step_by(2).map(byte).collect();
    let bytes: Option<[u8; KEY]> = bytes.and_then(|bytes| bytes.try_into().ok());
    bytes.as_ref().and_then(Key::new).ok_or_else(not_a_key)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trust(key: Option<&Path>, insecure_robot: bool) -> Trust {
        Trust {
            key: key.map(Path::to_owned),
            robot_key: None,
            insecure_robot,
        }
    }

    #[test]
    fn without_a_key_only_the_simulator_moves() {
        let board: Address = "tcp:127.0.0.1:1".parse().unwrap();
        let (sim, arm) = ("sim".parse().unwrap(), "fci:panda".parse().unwrap());
        assert!(trust(None, false).opener(&board, &sim).is_ok());
        assert!(matches!(
            trust(None, false).opener(&board, &arm),
            Err(TrustError::NoKey(_))
        ));
        assert!(trust(None, true).opener(&board, &arm).is_ok());
        assert!(trust(None, false).opener(&Address::Inside, &arm).is_ok());
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), "0f".repeat(KEY)).unwrap();
        assert!(trust(Some(file.path()), false).opener(&board, &arm).is_ok());
    }

    #[test]
    fn a_robot_behind_a_link_has_a_key_unless_told_otherwise() {
        let (sim, far) = ("sim".parse().unwrap(), "can:can0".parse().unwrap());
        let none = trust(None, false);
        assert!(matches!(none.robot_key(&sim), Ok(None)));
        let refused = none.robot_key(&far);
        assert!(matches!(refused, Err(TrustError::NoRobotKey(_))));
        assert!(matches!(trust(None, true).robot_key(&far), Ok(None)));
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), "0f".repeat(KEY)).unwrap();
        let keyed = Trust {
            robot_key: Some(file.path().to_owned()),
            ..trust(None, false)
        };
        assert!(matches!(keyed.robot_key(&far), Ok(Some(_))));
        assert!(matches!(keyed.robot_key(&sim), Err(TrustError::NoLink(_))));
    }

    #[test]
    fn a_file_with_something_else_is_refused() {
        let file = tempfile::NamedTempFile::new().unwrap();
        for text in ["", "0f", "zz", &"0g".repeat(KEY), &"00".repeat(KEY + 1)] {
            std::fs::write(file.path(), text).unwrap();
            assert!(
                matches!(read(file.path()), Err(TrustError::NotAKey(_))),
                "{text}"
            );
        }
        assert!(matches!(
            read(Path::new("/nowhere")),
            Err(TrustError::File { .. })
        ));
    }
}
