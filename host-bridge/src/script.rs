//! A script of commands that are played one after the other: what is said and shown, through how
//! noisy sensors, and how a question is answered.

use std::path::Path;

use serde::Deserialize;
use thiserror::Error;

use crate::diagnose::{FileError, Problem};
use crate::sensor::Noise;

/// The script that comes with the program, for its vocabulary and table.
pub const DEMO: &str = include_str!("../data/demo.toml");

/// What is wrong with a script.
#[derive(Debug, Error)]
pub enum ScriptProblem {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(#[source] std::io::Error),
    /// It is not TOML, or not of this shape.
    #[error("{0}")]
    Syntax(String),
}

impl Problem for ScriptProblem {
    fn remedy(&self) -> String {
        match self {
            Self::Unreadable(_) => {
                "give the path of a script, or none to play the one that comes with the program"
            }
            Self::Syntax(_) => {
                "the file is TOML with [[turn]] tables that have a `kind`, a `note`, and `said`, \
                 `shown` or `hand`; see data/demo.toml"
            }
        }
        .into()
    }
}

/// Commands to be played.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Script {
    /// One after the other.
    #[serde(rename = "turn")]
    pub turns: Vec<Turn>,
}

/// One command.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// What kind of command it is, for example `aligned`.
    pub kind: String,
    /// What it is to show.
    pub note: String,
    /// What is said.
    pub said: Option<String>,
    /// What is shown, typed as for `deictic decide --show`.
    pub shown: Option<String>,
    /// What a made-up person shows with the hand, frame by frame, while it is said: shapes, movements
    /// and things to point at, for example `thumbsup cup drawer`.
    pub hand: Option<String>,
    /// Observe both through sensors as noisy as this.
    pub noise: Option<Noise>,
    /// What the noise starts from.
    #[serde(default)]
    pub seed: u64,
    /// What is answered to a question.
    pub answer: Option<String>,
    /// Decide this one by the joint model, whatever decides the others.
    #[serde(default)]
    pub joint: bool,
    /// Say stop when the robot begins this motion, counted from 1.
    pub stop_at: Option<usize>,
}

impl Script {
    /// Reads a script.
    ///
    /// # Errors
    /// [`FileError`] with the place of what is wrong.
    pub fn read(path: &Path) -> Result<Self, FileError<ScriptProblem>> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|e| FileError::new(&name, "", None, ScriptProblem::Unreadable(e)))?;
        Self::parse(&name, &text)
    }

    /// The script that comes with the program.
    ///
    /// # Errors
    /// As [`Script::parse`]; a test holds that there is none.
    pub fn demo() -> Result<Self, FileError<ScriptProblem>> {
        Self::parse("demo.toml", DEMO)
    }

    /// The script of a file called `name` with this `text`.
    ///
    /// # Errors
    /// [`FileError`] with the place of what is wrong.
    pub fn parse(name: &str, text: &str) -> Result<Self, FileError<ScriptProblem>> {
        toml::from_str(text).map_err(|e| {
            let problem = ScriptProblem::Syntax(e.message().to_owned());
            FileError::new(name, text, e.span(), problem)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_script_is_sound_and_a_bad_one_is_refused_at_its_place() {
        assert!(Script::demo().unwrap().turns.len() > 10);
        let text = "[[turn]]\nkind = \"x\"\nnote = \"y\"\nsays = \"pick\"";
        let error = Script::parse("x", text).unwrap_err();
        assert_eq!(&text[error.place().unwrap()], "says");
    }
}
