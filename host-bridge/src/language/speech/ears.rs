//! Listens to a source beside the session: the program that it comes from, and how that ends.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, ChildStderr, Command, Stdio};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::error::SpeechError;
use super::hearing::{listen, read_lines};
use super::phrases::Expected;
use super::recogniser::Recogniser;
use super::source::Source;
use crate::language::Spoken;

/// Recorders of the microphone, the first installed is taken.
const RECORDERS: [(&str, &[&str]); 4] = [
    (
        "arecord",
        &["-q", "-t", "raw", "-f", "S16_LE", "-r", "16000", "-c", "1"],
    ),
    (
        "pw-record",
        &["--format", "s16", "--rate", "16000", "--channels", "1", "-"],
    ),
    (
        "parecord",
        &["--raw", "--format=s16le", "--rate=16000", "--channels=1"],
    ),
    (
        "rec",
        &[
            "-q", "-t", "raw", "-r", "16000", "-c", "1", "-b", "16", "-e", "signed", "-",
        ],
    ),
];

/// What came from a source.
#[derive(Debug)]
pub enum Heard {
    /// An utterance.
    Spoken(Spoken),
    /// An utterance that nothing was made of.
    Nothing(SpeechError),
    /// Nothing yet.
    Silence,
    /// There will be no more, as what it came from has failed.
    Failed(SpeechError),
    /// There will be no more.
    End,
}

/// Listens to a source beside the session. The program it reads from ends with it.
pub struct Ears {
    heard: Receiver<Result<Spoken, SpeechError>>,
    expected: Arc<Mutex<Expected>>,
    program: Option<Child>,
    source: Source,
    /// What the program said on its standard error, a line at a time, until that is closed.
    said: Receiver<String>,
}

/// How long a program that has closed its output may take to end.
const ENDING: Duration = Duration::from_secs(2);

impl Ears {
    /// Begins to listen. Sound goes to the recogniser, which lines have no need of.
    ///
    /// # Errors
    /// [`SpeechError`] for a program that is not installed, or a recording that is not there.
    pub fn open(
        source: &Source,
        recogniser: impl FnOnce() -> Result<Recogniser, SpeechError>,
    ) -> Result<Self, SpeechError> {
        let mut program = match source {
            Source::Microphone => microphone()?,
            Source::Recording(path) => {
                fs::metadata(path).map_err(|source| SpeechError::File {
                    path: path.clone(),
                    source,
                })?;
                let mut sox = Command::new("sox");
                sox.arg("-R").arg(path);
                sox.args([
                    "-t", "raw", "-r", "16000", "-c", "1", "-b", "16", "-e", "signed", "-",
                ]);
                start("sox", &mut sox)?
            }
            Source::Samples(line) | Source::Lines(line) => {
                start(line, Command::new("sh").arg("-c").arg(line))?
            }
        };
        let output = program.stdout.take().map(BufReader::new);
        let name = source.to_string();
        let said = lines_of(program.stderr.take());
        let (to, heard) = channel();
        let expected = Arc::new(Mutex::new(Expected::Command));
        if let Some(output) = output {
            if matches!(source, Source::Lines(_)) {
                thread::spawn(move || read_lines(output, &name, &to));
            } else {
                let mut recogniser = recogniser()?;
                let expected = Arc::clone(&expected);
                thread::spawn(move || listen(output, &mut recogniser, &expected, &name, &to));
            }
        }
        Ok(Self {
            heard,
            expected,
            program: Some(program),
            source: source.clone(),
            said,
        })
    }

    /// What is listened for from now on.
    pub fn expect(&self, expected: Expected) {
        // Another thread that failed with it held has not left half of it.
        *self.expected.lock().unwrap_or_else(PoisonError::into_inner) = expected;
    }

    /// What has come, without waiting.
    pub fn poll(&mut self) -> Heard {
        match self.heard.try_recv() {
            Ok(Ok(spoken)) => Heard::Spoken(spoken),
            Ok(Err(error)) => Heard::Nothing(error),
            Err(TryRecvError::Empty) => Heard::Silence,
            Err(TryRecvError::Disconnected) => self.ended(),
        }
    }

    /// Looks how the program ended whose output has.
    fn ended(&mut self) -> Heard {
        let Some(mut program) = self.program.take() else {
            return Heard::End;
        };
        let until = Instant::now() + ENDING;
        let status = loop {
            match program.try_wait() {
                Ok(None) if Instant::now() < until => thread::sleep(Duration::from_millis(5)),
                Ok(Some(status)) => break status,
                _ => {
                    self.program = Some(program);
                    return Heard::End;
                }
            }
        };
        if status.success() {
            return Heard::End;
        }
        let mut last = None;
        while let Ok(line) = self.said.recv_timeout(ENDING) {
            last = Some(line);
        }
        Heard::Failed(SpeechError::Ended {
            from: self.source.clone(),
            why: last.unwrap_or_else(|| status.to_string()),
        })
    }
}

/// The lines of a program's standard error that say something, which go to this one's as well.
fn lines_of(errors: Option<ChildStderr>) -> Receiver<String> {
    let (to, lines) = channel();
    if let Some(errors) = errors {
        thread::spawn(move || {
            for line in BufReader::new(errors).split(b'\n').map_while(Result::ok) {
                let line = String::from_utf8_lossy(&line).trim().to_owned();
                if line.is_empty() {
                    continue;
                }
                eprintln!("{line}");
                if to.send(line).is_err() {
                    return;
                }
            }
        });
    }
    lines
}

impl Drop for Ears {
    fn drop(&mut self) {
        if let Some(mut program) = self.program.take() {
            // It may have ended by itself.
            let _ = program.kill();
            let _ = program.wait();
        }
    }
}

fn microphone() -> Result<Child, SpeechError> {
    let started = RECORDERS.iter().find_map(|(program, arguments)| {
        start(program, Command::new(program).args(*arguments)).ok()
    });
    started.ok_or_else(|| SpeechError::Program {
        program: "the microphone".into(),
        why: "none of arecord, pw-record, parecord and rec is installed".into(),
    })
}

fn start(program: &str, command: &mut Command) -> Result<Child, SpeechError> {
    let command = command.stdin(Stdio::null()).stdout(Stdio::piped());
    let command = command.stderr(Stdio::piped());
    command.spawn().map_err(|e| SpeechError::Program {
        program: program.to_owned(),
        why: e.to_string(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(command: &str) -> Vec<Result<Spoken, SpeechError>> {
        let source = Source::Lines(command.to_owned());
        let ears = Ears::open(&source, || unreachable!("lines need no recogniser")).unwrap();
        ears.heard.iter().collect()
    }

    #[test]
    fn every_line_is_an_utterance() {
        let heard =
            lines(r#"echo 'pick the cup'; echo '{"text": "stop"}'; echo; printf 'a\377\n'"#);
        let texts: Vec<_> = heard
            .iter()
            .map(|h| h.as_ref().ok().map(|s| s.alternatives[0].0.as_str()))
            .collect();
        assert_eq!(texts, [Some("pick the cup"), Some("stop"), None, None]);
    }

    #[test]
    fn a_program_that_fails_is_told_from_one_that_ends() {
        let end = |command: &str| {
            let source = Source::Lines(command.to_owned());
            let mut ears =
                Ears::open(&source, || unreachable!("lines need no recogniser")).unwrap();
            loop {
                match ears.poll() {
                    Heard::Silence => thread::sleep(Duration::from_millis(1)),
                    Heard::Spoken(_) => {}
                    other => return (other, ears.poll()),
                }
            }
        };
        assert!(matches!(end("echo pick the cup"), (Heard::End, Heard::End)));
        let (failed, then) = end("echo pick the cup; echo no device >&2; exit 3");
        assert!(matches!(then, Heard::End));
        let Heard::Failed(SpeechError::Ended { why, .. }) = failed else {
            panic!("{failed:?}");
        };
        assert_eq!(why, "no device");
    }

    #[test]
    fn a_line_without_end_is_refused() {
        let heard = lines("head -c 300000 /dev/zero | tr '\\0' a; echo; echo stop");
        assert_eq!(heard.len(), 2);
        assert!(heard[0].is_err() && heard[1].is_ok());
    }
}
