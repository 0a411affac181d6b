//! Where a hand sensor is, as it is written on a command line.

use std::path::PathBuf;
use std::str::FromStr;

use super::leap::URL;
use super::mediapipe::Input;

/// Where samples of a hand come from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Address {
    /// A Leap Motion's service: `leap`, or `leap:ws://127.0.0.1:6437/v6.json`.
    Leap(String),
    /// MediaPipe's landmarks as JSON lines: `mediapipe:FILE`, `mediapipe:-`, `mediapipe:tcp:HOST:PORT`.
    MediaPipe(Input),
    /// A recording: `file:PATH`.
    File(PathBuf),
    /// A made-up person: `made-up:SEED:thumbsup cup drawer`.
    MadeUp {
        /// Which person.
        seed: u64,
        /// What the person shows and points at.
        acts: String,
    },
}

/// An address that cannot be understood.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no hand sensor; write leap, leap:ws://HOST:PORT/v6.json, mediapipe:FILE, mediapipe:-, \
     mediapipe:tcp:HOST:PORT, file:RECORDING, or \"made-up:1:thumbsup cup drawer\""
)]
pub struct AddressError(String);

impl FromStr for Address {
    type Err = AddressError;

    fn from_str(written: &str) -> Result<Self, AddressError> {
        let error = || AddressError(written.to_owned());
        if written == "leap" {
            return Ok(Self::Leap(URL.to_owned()));
        }
        let (kind, rest) = written.split_once(':').ok_or_else(error)?;
        if rest.is_empty() {
            return Err(error());
        }
        Ok(match kind {
            "leap" if rest.starts_with("ws://") => Self::Leap(rest.to_owned()),
            "mediapipe" => Self::MediaPipe(match (rest, rest.strip_prefix("tcp:")) {
                ("-", _) => Input::Standard,
                (_, Some(address)) => Input::Tcp(address.to_owned()),
                _ => Input::File(PathBuf::from(rest)),
            }),
            "file" => Self::File(PathBuf::from(rest)),
            "made-up" => {
                let (seed, acts) = rest.split_once(':').ok_or_else(error)?;
                if acts.trim().is_empty() {
                    return Err(error());
                }
                Self::MadeUp {
                    seed: seed.parse().map_err(|_| error())?,
                    acts: acts.to_owned(),
                }
            }
            _ => return Err(error()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let read = |text: &str| text.parse::<Address>().unwrap();
        assert_eq!(read("leap"), Address::Leap(URL.into()));
        assert_eq!(read("mediapipe:-"), Address::MediaPipe(Input::Standard));
        assert_eq!(
            read("mediapipe:tcp:127.0.0.1:9"),
            Address::MediaPipe(Input::Tcp("127.0.0.1:9".into()))
        );
        let made_up = Address::MadeUp {
            seed: 7,
            acts: "pinch cup".into(),
        };
        assert_eq!(read("made-up:7:pinch cup"), made_up);
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        for written in [
            "",
            "leap:",
            "leap:6437",
            "kinect",
            "file:",
            "made-up:x",
            "made-up:1",
            "made-up:1:",
            "made-up:1: ",
            "usb:1",
        ] {
            assert!(written.parse::<Address>().is_err(), "{written}");
        }
    }
}
