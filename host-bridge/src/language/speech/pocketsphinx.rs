//! Debian's pocketsphinx, run once per recording, with a grammar made from the vocabulary.

use std::collections::HashSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use tempfile::TempDir;

use super::jsgf::{Jsgf, grammar};
use crate::language::pack::Pack;
use crate::language::{LanguageError, Spoken};
use crate::vocabulary::Lexicon;

/// Where Debian's packages `pocketsphinx-en-us` puts the model.
pub const MODEL: &str = "/usr/share/pocketsphinx/model/en-us";

/// Alternatives that are asked for; wordings of one meaning take most of them.
const ALTERNATIVES: usize = 120;

/// How far a score must be behind for its text to be e times less probable, in a quiet recording.
/// The scores are ln of the acoustic likelihood in units of 0.1; taken as they are they would be far
/// too sure, as frames of 10 ms are not independent.
const SCALE: f64 = 250.0;

/// From this many dB between the loudest and the quietest moment on a recording counts as quiet.
const QUIET: f64 = 40.0;

/// Noise makes scores alike for no good reason: at 10 dB a third of the likeliest texts are wrong.
/// So they count the less, the less the voice stands out.
fn scale(stats: &str) -> f64 {
    let figure = |name: &str| {
        let line = stats.lines().find(|l| l.starts_with(name))?;
        line.split_whitespace().nth(3)?.parse::<f64>().ok()
    };
    let (Some(loud), Some(quiet)) = (figure("RMS Pk dB"), figure("RMS Tr dB")) else {
        return SCALE;
    };
    // A silence of zeros has minus infinity.
    let range = (loud - quiet).clamp(QUIET / 5.0, QUIET);
    SCALE * (QUIET / range) * (QUIET / range)
}

/// How loud the noise is that is added to a recording, of full scale.
const COMFORT: &str = "0.02";

/// Why nothing was heard.
#[derive(Debug, thiserror::Error)]
pub enum SpeechError {
    /// A program that is not installed, or that failed.
    #[error("{program}: {why}")]
    Program {
        /// Which.
        program: &'static str,
        /// What it said.
        why: String,
    },
    /// A file that could not be read or written.
    #[error("{}: {source}", path.display())]
    File {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The vocabulary has nothing that this recogniser can hear.
    #[error("no action of the vocabulary can be pronounced in this language")]
    NoGrammar,
    /// Nothing was understood.
    #[error(transparent)]
    Language(#[from] LanguageError),
}

impl SpeechError {
    /// What the person can do about it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Program { .. } => {
                "install Debian's packages pocketsphinx, pocketsphinx-en-us and sox".into()
            }
            Self::File { .. } => "check that the file is there and can be read".into(),
            Self::NoGrammar => "plug in a recogniser of that language by its lines".into(),
            Self::Language(error) => error.remedy(),
        }
    }
}

/// The recogniser with its grammar.
#[derive(Debug)]
pub struct Pocketsphinx {
    folder: TempDir,
    model: PathBuf,
    left_out: Vec<String>,
}

impl Pocketsphinx {
    /// Makes the grammar of a vocabulary for the model in `model`, mostly [`MODEL`].
    ///
    /// # Errors
    /// [`SpeechError`] when the model is not there, or has none of the vocabulary's words.
    pub fn new(lexicon: &Lexicon, pack: &Pack, model: &Path) -> Result<Self, SpeechError> {
        let dictionary = read(&model.join("cmudict-en-us.dict"))?;
        let known: HashSet<_> = dictionary
            .lines()
            .filter_map(|l| l.split(' ').next())
            .collect();
        let Jsgf { text, left_out } =
            grammar(lexicon, pack, |word| known.contains(word)).ok_or(SpeechError::NoGrammar)?;
        let folder = TempDir::new().map_err(file(Path::new("temporary folder")))?;
        write(&folder.path().join("commands.gram"), &text)?;
        Ok(Self {
            folder,
            model: model.to_owned(),
            left_out,
        })
    }

    /// Phrases of the vocabulary that the model cannot hear.
    #[must_use]
    pub fn left_out(&self) -> &[String] {
        &self.left_out
    }

    /// What is said in a recording, any that sox reads.
    ///
    /// # Errors
    /// [`SpeechError`].
    pub fn hear(&self, recording: &Path) -> Result<Spoken, SpeechError> {
        let at = |name: &str| self.folder.path().join(name);
        fs::metadata(recording).map_err(file(recording))?;
        // Silence around it gives the recogniser's noise estimate something to hold on to, and a
        // little noise keeps a perfectly silent silence from being all that it hears.
        let form = ["-r", "16000", "-c", "1", "-b", "16"];
        let pad = ["norm", "-3", "pad", "0.4", "0.6"];
        let noise = ["synth", "pinknoise", "vol", COMFORT];
        let sox = |change: &dyn Fn(&mut Command)| {
            let mut command = Command::new("sox");
            command.arg("-R");
            change(&mut command);
            run("sox", &mut command).map(drop)
        };
        let stats = run(
            "sox",
            Command::new("sox").arg(recording).args(["-n", "stats"]),
        )?;
        let scale = scale(&stats);
        sox(&|c| {
            c.arg(recording).args(form).arg(at("voice.wav")).args(pad);
        })?;
        sox(&|c| {
            c.arg(at("voice.wav")).arg(at("noise.wav")).args(noise);
        })?;
        sox(&|c| {
            c.args(["-m", "-v", "1"]).arg(at("voice.wav"));
            c.args(["-v", "1"]).arg(at("noise.wav")).arg(at("said.wav"));
        })?;
        write(&at("list"), "said\n")?;
        // A file left from before must not pass for what was heard now.
        let _ = fs::remove_file(at("said.hyp"));
        let mut command = Command::new("pocketsphinx_batch");
        let paths = [
            ("-cepdir", self.folder.path().to_owned()),
            ("-ctl", at("list")),
            ("-hmm", self.model.join("en-us")),
            ("-dict", self.model.join("cmudict-en-us.dict")),
            ("-jsgf", at("commands.gram")),
            ("-nbestdir", self.folder.path().to_owned()),
            ("-hyp", at("best")),
        ];
        for (option, path) in paths {
            command.arg(option).arg(path);
        }
        let count = ALTERNATIVES.to_string();
        let how = [
            "-adcin",
            "yes",
            "-cepext",
            ".wav",
            "-cmn",
            "current",
            "-bestpath",
            "yes",
            "-dither",
            "yes",
        ];
        command
            .args(how)
            .args(["-nbest", count.as_str(), "-logfn", "/dev/null"]);
        run("pocketsphinx_batch", &mut command)?;
        let lines = fs::read_to_string(at("said.hyp")).unwrap_or_default();
        let scores = lines.lines().filter_map(|line| {
            let (text, score) = line.trim().rsplit_once(' ')?;
            Some((text.to_owned(), score.parse().ok()?))
        });
        let mut scores: Vec<(String, f64)> = scores.collect();
        scores.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        scores.dedup_by(|a, b| a.0 == b.0);
        Ok(Spoken::of_scores(scores, scale)?)
    }
}

fn read(path: &Path) -> Result<String, SpeechError> {
    fs::read_to_string(path).map_err(file(path))
}

fn write(path: &Path, text: &str) -> Result<(), SpeechError> {
    fs::write(path, text).map_err(file(path))
}

fn file(path: &Path) -> impl FnOnce(io::Error) -> SpeechError + use<> {
    let path = path.to_owned();
    move |source| SpeechError::File { path, source }
}

/// Runs a program; what it said on standard error.
fn run(program: &'static str, command: &mut Command) -> Result<String, SpeechError> {
    let failed = |why: String| SpeechError::Program { program, why };
    let command = command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    let output = command.output().map_err(|e| failed(e.to_string()))?;
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    if output.status.success() {
        return Ok(said);
    }
    Err(failed(
        said.lines().last().unwrap_or("it failed").to_owned(),
    ))
}
