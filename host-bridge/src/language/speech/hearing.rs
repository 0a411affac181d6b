//! From a program's output to utterances: lines of a recogniser as they are, sound through a recogniser
//! here.

use std::fmt;
use std::io::{BufRead, Read};
use std::sync::mpsc::Sender;
use std::sync::{Mutex, PoisonError};

use super::error::SpeechError;
use super::phrases::Expected;
use super::recogniser::Recogniser;
use super::segment::Segmenter;
use super::sound;
use crate::language::{LONGEST, Spoken, text_of};

/// What utterances are told to.
type Told = Sender<Result<Spoken, SpeechError>>;

fn lost(program: &str, why: impl fmt::Display) -> SpeechError {
    SpeechError::Program {
        program: program.to_owned(),
        why: why.to_string(),
    }
}

/// A line is an utterance; a longer one than any utterance is cut there, which the language refuses.
pub fn read_lines(mut output: impl BufRead, name: &str, to: &Told) {
    loop {
        let mut line = Vec::new();
        let most = LONGEST as u64 * 8;
        let read = output.by_ref().take(most).read_until(b'\n', &mut line);
        let cut = line.len() as u64 == most && line.last() != Some(&b'\n');
        let rest = if cut {
            output.skip_until(b'\n').map(drop)
        } else {
            Ok(())
        };
        let heard = match (read, rest) {
            (Ok(0), _) => return,
            (Err(e), _) | (_, Err(e)) => Err(lost(name, e)),
            _ if cut => text_of(&line).and_then(Spoken::read).map_err(Into::into),
            _ => spoken(&line),
        };
        let ends = matches!(heard, Err(SpeechError::Program { .. }));
        if to.send(heard).is_err() || ends {
            return;
        }
    }
}

/// An utterance of a recogniser's line, whose JSON may be longer than its texts.
fn spoken(line: &[u8]) -> Result<Spoken, SpeechError> {
    let text = match std::str::from_utf8(line) {
        Ok(text) => text,
        Err(_) => text_of(line)?,
    };
    Ok(Spoken::read(text.trim())?)
}

/// Sound goes to the recogniser an utterance at a time, with what is expected when it ends.
pub fn listen(
    mut output: impl Read,
    recogniser: &mut Recogniser,
    expected: &Mutex<Expected>,
    name: &str,
    to: &Told,
) {
    let mut segmenter = Segmenter::default();
    let mut bytes = vec![0; 2 * sound::MOMENT];
    let mut hear = |samples: &[i16]| {
        let expected = *expected.lock().unwrap_or_else(PoisonError::into_inner);
        to.send(recogniser.hear(samples, expected)).is_ok()
    };
    loop {
        let mut filled = 0;
        while let Some(rest) = bytes.get_mut(filled..).filter(|r| !r.is_empty()) {
            match output.read(rest) {
                Ok(0) => break,
                Ok(n) => filled += n,
                Err(e) if e.kind() == std::io::ErrorKind::Interrupted => {}
                Err(e) => {
                    // Nobody listens any more when this fails.
                    let _ = to.send(Err(lost(name, e)));
                    return;
                }
            }
        }
        let samples = sound::of_bytes(bytes.get(..filled).unwrap_or_default());
        if !segmenter.take(&samples).iter().all(|said| hear(said)) {
            return;
        }
        if filled < bytes.len() {
            if let Some(said) = segmenter.end() {
                hear(&said);
            }
            return;
        }
    }
}
