//! Lines from standard input, read beside the session so that a typed stop waits for nothing.

use std::io::{BufRead, Read};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use crate::language::LONGEST;

/// What came from standard input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Typed {
    /// A line, as bytes, as nobody promised that they are text.
    Line(Vec<u8>),
    /// Nothing yet.
    Nothing,
    /// There will be no more.
    End,
}

/// Lines that are read by a thread of their own.
pub struct Lines(Receiver<Vec<u8>>);

impl Lines {
    /// Begins to read. A line that is longer than any utterance is cut there, which the language
    /// refuses as too long.
    pub fn of_stdin() -> Self {
        let (to, from) = channel();
        std::thread::spawn(move || {
            let mut input = std::io::stdin().lock();
            loop {
                let mut line = Vec::new();
                let most = LONGEST as u64 + 2;
                match input.by_ref().take(most).read_until(b'\n', &mut line) {
                    Ok(0) | Err(_) => return,
                    Ok(_) => {}
                }
                if line.last() != Some(&b'\n') && input.skip_until(b'\n').is_err() {
                    return;
                }
                if to.send(line).is_err() {
                    return;
                }
            }
        });
        Self(from)
    }

    /// What has come, without waiting.
    pub fn next(&self) -> Typed {
        match self.0.try_recv() {
            Ok(line) => Typed::Line(line),
            Err(TryRecvError::Empty) => Typed::Nothing,
            Err(TryRecvError::Disconnected) => Typed::End,
        }
    }
}
