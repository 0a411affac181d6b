//! Debian's pocketsphinx, run once per meaning that comes into question, on one recording.

use std::collections::{BTreeSet, HashMap};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use tempfile::TempDir;

use super::anything;
use super::error::SpeechError;
use super::phrases::{Expected, Only, Phrases};
use super::program::{file, run, write};
use super::pronounce::Dictionary;
use super::sound::{self, Colour};
use crate::language::pack::Pack;
use crate::language::{LanguageError, Spoken};
use crate::vocabulary::Lexicon;

/// Where Debian's packages `pocketsphinx-en-us` puts the model.
pub const MODEL: &str = "/usr/share/pocketsphinx/model/en-us";

/// How far a score must be behind, in a quiet recording, for its text to be e times less probable.
/// Scores are ln of the acoustic likelihood in units of 0.1; taken as they are they would be far too
/// sure, as frames of 10 ms are not independent. Of 56 utterances in quiet, by voices that are not
/// scored, 51 were right and none wrong at 20, 52 and 1 at 15, 50 and none at 30.
pub const SCALE: f64 = 20.0;

/// From this many dB between the voice and what is behind it a recording counts as quiet.
const QUIET: f32 = 40.0;

/// Noise makes scores differ for no good reason, so they count the less, the less the voice stands
/// out ([`sound::range`]): with 20, 10 and 5 dB some 2, 6 and 10 times less than in quiet.
pub(super) fn doubt(range: Option<f32>) -> f64 {
    let range = range.unwrap_or(QUIET).clamp(QUIET / 5.0, QUIET);
    f64::from(QUIET / range).powf(1.5)
}

/// How loud the noise is that is added to a recording, of full scale.
const COMFORT: f32 = 0.02;

/// Texts further than this behind the best cannot count.
const FARTHEST: f64 = 12.0;

/// Whether it and its model are installed.
#[must_use]
pub fn installed(model: &Path) -> bool {
    let paths = std::env::var_os("PATH").unwrap_or_default();
    let mut folders = std::env::split_paths(&paths);
    model.is_dir() && folders.any(|folder| folder.join(PROGRAM).is_file())
}

/// The program that is run.
pub(super) const PROGRAM: &str = "pocketsphinx_batch";

/// The recogniser with its grammars.
#[derive(Debug)]
pub struct Pocketsphinx {
    folder: TempDir,
    model: PathBuf,
    left_out: Vec<String>,
    /// The words of its dictionary.
    words: BTreeSet<String>,
    commands: Vec<PathBuf>,
    underway: Vec<PathBuf>,
    answers: Vec<PathBuf>,
    /// Of whatever else may be said.
    anything: PathBuf,
    takes: AtomicUsize,
}

impl Pocketsphinx {
    /// Makes the grammars of a vocabulary for the model in `model`, mostly [`MODEL`]. Names that the
    /// model's dictionary does not have are pronounced by espeak-ng where it is installed.
    ///
    /// # Errors
    /// [`SpeechError`] when the model is not there, or has none of the vocabulary's words.
    pub fn new(lexicon: &Lexicon, pack: &Pack, model: &Path) -> Result<Self, SpeechError> {
        let path = model.join("cmudict-en-us.dict");
        let text = fs::read_to_string(&path).map_err(file(&path))?;
        let mut dictionary = Dictionary::read(&text);
        let pronounced = |word: &str| {
            if !dictionary.knows(word) {
                dictionary.learn(word);
            }
            dictionary.knows(word)
        };
        let phrases = Phrases::new(lexicon, pack, pronounced).ok_or(SpeechError::NoGrammar)?;
        let folder = TempDir::new().map_err(file(Path::new("temporary folder")))?;
        let known = phrases.words().into_iter();
        let known: BTreeSet<_> = known.filter(|w| dictionary.knows(w)).collect();
        let lines = dictionary.part(known.iter().copied()) + &anything::dictionary();
        write(&folder.path().join("words"), &lines)?;
        let words = known.into_iter().map(str::to_owned).collect();
        let anything = folder.path().join("anything.gram");
        write(&anything, &anything::grammar())?;
        let mut files = 0;
        let mut all = |list: Vec<Only>| {
            let rules = list.into_iter().filter_map(|only| phrases.rule(only));
            let written = rules.map(|rule| {
                files += 1;
                let path = folder.path().join(format!("{files}.gram"));
                write(&path, &rule.jsgf()).map(|()| path)
            });
            written.collect::<Result<Vec<_>, _>>()
        };
        let (commands, answers) = (all(phrases.commands())?, all(phrases.answers())?);
        let underway = [commands.clone(), all(vec![Only::Refusal])?].concat();
        Ok(Self {
            folder,
            model: model.to_owned(),
            left_out: phrases.left_out().to_vec(),
            words,
            commands,
            underway,
            answers,
            anything,
            takes: AtomicUsize::new(0),
        })
    }

    /// Phrases of the vocabulary that the model cannot hear.
    #[must_use]
    pub fn left_out(&self) -> &[String] {
        &self.left_out
    }

    /// What is said in one utterance, samples of [`sound::RATE`]. A tenth of a second of one core
    /// per option of the vocabulary.
    ///
    /// # Errors
    /// [`SpeechError`].
    pub fn hear(&self, samples: &[i16], expected: Expected) -> Result<Spoken, SpeechError> {
        let scores = self.scores(samples, expected)?;
        Ok(Self::weigh(&scores, sound::range(samples), SCALE)?)
    }

    /// What [`Pocketsphinx::scores`] say of a recording with this [`sound::range`], if in quiet a
    /// score must be `scale` behind for its text to be e times less probable.
    ///
    /// # Errors
    /// [`LanguageError::Empty`] when nothing was heard.
    pub fn weigh(
        scores: &[(String, f64)],
        range: Option<f32>,
        scale: f64,
    ) -> Result<Spoken, LanguageError> {
        let scale = scale * doubt(range);
        let top = scores.iter().map(|s| s.1).fold(f64::NEG_INFINITY, f64::max);
        let near = scores.iter().filter(|s| s.1 > top - FARTHEST * scale);
        Spoken::of_scores(near.cloned().collect(), scale)
    }

    /// The best text under every restriction, with the recogniser's score; and an empty text, for what
    /// is no command, with the score that commands must beat.
    ///
    /// # Errors
    /// [`SpeechError`].
    pub fn scores(
        &self,
        samples: &[i16],
        expected: Expected,
    ) -> Result<Vec<(String, f64)>, SpeechError> {
        let folder = self.take(samples)?;
        let grammars = match expected {
            Expected::Command => &self.commands,
            Expected::Underway => &self.underway,
            Expected::Answer => &self.answers,
        };
        let next = AtomicUsize::new(0);
        let work = || {
            let mut heard = Vec::new();
            while let Some(grammar) = grammars.get(next.fetch_add(1, Ordering::Relaxed)) {
                heard.extend(self.best(&folder, grammar)?);
            }
            Ok(heard)
        };
        let workers = thread::available_parallelism().map_or(1, usize::from);
        let heard = thread::scope(|scope| {
            let workers: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
            let results = workers.into_iter().filter_map(|w| w.join().ok());
            results.collect::<Result<Vec<_>, SpeechError>>()
        })?;
        let sounds = self.sounds(&folder)?;
        // A folder that stays is removed with its parent.
        let _ = fs::remove_dir_all(&folder);
        let mut best: HashMap<String, f64> = HashMap::new();
        if let Some(score) = sounds {
            best.insert(String::new(), anything::bar(score, samples.len()));
        }
        for (text, score) in heard.into_iter().flatten() {
            let known = best.entry(text).or_insert(score);
            *known = known.max(score);
        }
        let mut all: Vec<_> = best.into_iter().collect();
        all.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        Ok(all)
    }

    /// A folder with a recording in it, made ready.
    pub(super) fn take(&self, samples: &[i16]) -> Result<PathBuf, SpeechError> {
        let take = self.takes.fetch_add(1, Ordering::Relaxed);
        let folder = self.folder.path().join(format!("take{take}"));
        fs::create_dir(&folder).map_err(file(&folder))?;
        let said = folder.join("said.raw");
        let samples = sound::prepared(samples, Colour::Pink, COMFORT);
        sound::write(&said, &samples).map_err(file(&said))?;
        write(&folder.join("list"), "said\n")?;
        Ok(folder)
    }

    /// How well any sounds in any order fit a recording that was made ready.
    pub(super) fn sounds(&self, take: &Path) -> Result<Option<f64>, SpeechError> {
        Ok(self.best(take, &self.anything)?.map(|(_, score)| score))
    }

    /// Tells a run over a list of takes what all runs have in common.
    pub(super) fn settle(&self, command: &mut Command, take: &Path, list: &Path, heard: &Path) {
        let paths = [
            ("-cepdir", take),
            ("-ctl", list),
            ("-hmm", &self.model.join("en-us")),
            ("-dict", &self.folder.path().join("words")),
            ("-hyp", heard),
        ];
        for (option, path) in paths {
            command.arg(option).arg(path);
        }
        // Without -compallsen scores are relative to the best sound that the grammar has a use for,
        // so that those of different grammars cannot be compared.
        command.args(["-adcin", "yes", "-cepext", ".raw", "-compallsen", "yes"]);
        command.args(["-bestpath", "yes", "-dither", "no", "-logfn", "/dev/null"]);
    }

    /// Whether it can hear a word.
    pub(super) fn pronounces(&self, word: &str) -> bool {
        self.words.contains(word)
    }

    /// The best text of one grammar, if any fits at all.
    fn best(&self, take: &Path, grammar: &Path) -> Result<Option<(String, f64)>, SpeechError> {
        let name = grammar.file_stem().unwrap_or_default().to_string_lossy();
        let heard = take.join(format!("{name}.hyp"));
        let mut command = Command::new(PROGRAM);
        command.arg("-jsgf").arg(grammar);
        self.settle(&mut command, take, &take.join("list"), &heard);
        run(PROGRAM, &mut command)?;
        // "pick the cup (said -4711)"
        let line = fs::read_to_string(&heard).map_err(file(&heard))?;
        let heard = line.trim_end().strip_suffix(')');
        Ok(heard.and_then(|line| {
            let (text, score) = line.rsplit_once(' ')?;
            let text = text.rsplit_once(" (")?.0.trim();
            // A grammar that nothing of the sound fits gives no words, with a score of 0.
            (!text.is_empty()).then_some((text.to_owned(), score.parse().ok()?))
        }))
    }
}
