//! What can go wrong with a source of samples.

use std::io;

use deictic_core::gesture::wire::WireError;
use miette::Diagnostic;
use thiserror::Error;

use crate::hand::acting::ActingError;

/// What went wrong with a source of samples.
#[derive(Debug, Error, Diagnostic)]
pub enum SourceError {
    /// The Leap Motion's service does not answer.
    #[error("cannot reach the Leap Motion service at {url}: {why}")]
    #[diagnostic(help(
        "start the service (Ultraleap Gemini, or Orion 4 and older), allow web apps in its settings, \
         or name another address: leap:ws://HOST:PORT/v6.json"
    ))]
    Leap {
        /// Where it was looked for.
        url: String,
        /// What the connection said.
        why: String,
    },
    /// The Leap Motion's service has gone.
    #[error("the Leap Motion service has gone: {0}")]
    #[diagnostic(help("start the service again, and this program after it"))]
    LeapGone(String),
    /// A file, pipe or connection cannot be opened.
    #[error("cannot open {what}: {cause}")]
    #[diagnostic(help("look at the name, and whether what writes to it runs"))]
    Unopened {
        /// What was to be opened.
        what: String,
        /// What the system said.
        cause: io::Error,
    },
    /// A file or connection broke off.
    #[error("reading stopped: {0}")]
    #[diagnostic(help("start what writes it again"))]
    Broken(io::Error),
    /// A message is not of the expected form.
    #[error("message {number} is not of the expected form: {why}")]
    #[diagnostic(help("docs/hand.md says where the form is; look at the program that writes it"))]
    Form {
        /// Which message, counted from 1.
        number: u64,
        /// What is wrong with it.
        why: String,
    },
    /// A hand cannot be as it was said to be.
    #[error("frame {number} shows a hand that cannot be: {error:?}")]
    #[diagnostic(help("look at the units: millimetres, unit vectors, shares of 0 to 1"))]
    Unsound {
        /// Which frame, counted from 1.
        number: u64,
        /// What cannot be.
        error: WireError,
    },
    /// A file that does not begin as a recording does.
    #[error("{0} is no recording of a hand")]
    #[diagnostic(help("record one with `deictic hand --record FILE`"))]
    NoRecording(String),
    /// A made-up person is to do what nobody can.
    #[error("{0}")]
    #[diagnostic(help("{}", .0.remedy()))]
    Acting(ActingError),
}
