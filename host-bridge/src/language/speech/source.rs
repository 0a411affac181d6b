//! Where speech comes from: a microphone, a recording, or another recogniser's lines.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

/// Where speech comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// The microphone, through the first of arecord, pw-record, parecord and rec that is installed.
    Microphone,
    /// A recording, any that sox reads: several utterances with pauses between them.
    Recording(PathBuf),
    /// A program that writes samples to its standard output, 16,000 a second, 16 bits little end
    /// first, one channel: another microphone, or one over a network.
    Samples(String),
    /// A recogniser of its own, which writes a line per utterance.
    Lines(String),
}

impl FromStr for Source {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(match text.split_once(':') {
            _ if text == "mic" => Self::Microphone,
            Some(("samples", command)) => Self::Samples(command.to_owned()),
            Some(("lines", command)) => Self::Lines(command.to_owned()),
            _ => Self::Recording(text.into()),
        })
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Microphone => f.write_str("the microphone"),
            Self::Recording(path) => path.display().fmt(f),
            Self::Samples(command) | Self::Lines(command) => command.fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sources_are_told_apart() {
        let of = |text: &str| text.parse::<Source>().unwrap();
        assert_eq!(of("mic"), Source::Microphone);
        assert_eq!(of("a/b.wav"), Source::Recording("a/b.wav".into()));
        assert_eq!(of("lines:vosk -x"), Source::Lines("vosk -x".into()));
        assert_eq!(of("samples:nc host 1"), Source::Samples("nc host 1".into()));
    }
}
