//! Where speech comes from: a microphone, a recording, or another recogniser's lines.

use std::fmt;
use std::io::{BufRead, BufReader, Read};
use std::path::PathBuf;
use std::process::{Child, ChildStderr, Command, Stdio};
use std::str::FromStr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread;
use std::time::{Duration, Instant};

use super::error::SpeechError;
use super::recogniser::{Expected, Recogniser};
use super::segment::Segmenter;
use super::sound;
use crate::language::{LONGEST, Spoken, text_of};

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
    asked: Arc<AtomicBool>,
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
                std::fs::metadata(path).map_err(|source| SpeechError::File {
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
        let asked = Arc::new(AtomicBool::new(false));
        if let Some(output) = output {
            if matches!(source, Source::Lines(_)) {
                thread::spawn(move || read_lines(output, &name, &to));
            } else {
                let mut recogniser = recogniser()?;
                let asked = Arc::clone(&asked);
                thread::spawn(move || listen(output, &mut recogniser, &asked, &name, &to));
            }
        }
        Ok(Self {
            heard,
            asked,
            program: Some(program),
            source: source.clone(),
            said,
        })
    }

    /// Whether a question is open, so that answers are listened for.
    pub fn expect(&self, answer: bool) {
        self.asked.store(answer, Ordering::Relaxed);
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

type Told = Sender<Result<Spoken, SpeechError>>;

fn lost(program: &str, why: impl fmt::Display) -> SpeechError {
    SpeechError::Program {
        program: program.to_owned(),
        why: why.to_string(),
    }
}

/// A line is an utterance; a longer one than any utterance is cut there, which the language refuses.
fn read_lines(mut output: impl BufRead, name: &str, to: &Told) {
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

fn listen(
    mut output: impl Read,
    recogniser: &mut Recogniser,
    asked: &AtomicBool,
    name: &str,
    to: &Told,
) {
    let mut segmenter = Segmenter::default();
    let mut bytes = vec![0; 2 * sound::MOMENT];
    let mut hear = |samples: &[i16]| {
        let expected = if asked.load(Ordering::Relaxed) {
            Expected::Answer
        } else {
            Expected::Command
        };
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
