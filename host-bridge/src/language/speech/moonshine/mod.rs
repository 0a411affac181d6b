//! Moonshine, a small English speech model with an encoder that takes as long as the utterance is
//! (Jeffries et al. 2024, arXiv 2410.15608), from the package `moonshine-voice`.
//!
//! It writes down whatever it hears. Here it also says how probable every command of the vocabulary is,
//! by writing only what the rules allow, and the two are held against each other: what it would write
//! much rather than any command was talk.

mod model;
mod scores;
mod search;
mod tokens;
mod weights;

use std::collections::HashMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use ort::environment::Environment;

pub use self::scores::{Scores, Writing};
pub use self::weights::{HABIT, LEAD, LOOSE, NOISE, SCALE, SECOND, Weights};

use self::model::{Model, Written};
use self::search::{Found, Search, anything};
use self::tokens::{Token, Tokens};
use super::error::SpeechError;
use super::paths::Paths;
use super::phrases::{Expected, Only, Phrases};
use super::pocketsphinx::Pocketsphinx;
use super::program::file;
use super::sound::{RATE, range};
use crate::language::Spoken;
use crate::language::pack::Pack;
use crate::vocabulary::Lexicon;

/// The environment variable that names the folder with the package, which `cargo xtask` sets.
pub const VARIABLE: &str = "DEICTIC_MOONSHINE";

/// Where `cargo xtask setup` puts the package, from the project's root.
const FOLDER: &str = "target/moonshine";

/// The model in the package, and the runtime's library beside it.
const MODEL: &str = "moonshine_voice/assets/tiny-en";
const LIBRARIES: &str = "moonshine_voice.libs";

/// The silence that tells the model's habits, in samples.
const SILENCE: usize = 2 * RATE;

/// So many texts are weighed.
const MOST: usize = 24;

/// Silence before and after an utterance, in samples.
const AROUND: (usize, usize) = (RATE / 5, RATE * 3 / 10);

/// The loudest sample, of full scale.
const LOUDEST: f32 = 0.5;

/// The recogniser with the rules of a vocabulary.
#[derive(Debug)]
pub struct Moonshine {
    model: Model,
    tokens: Tokens,
    commands: Search,
    underway: Search,
    answers: Search,
    /// Words that change no meaning.
    idle: Vec<String>,
    silence: Written,
    /// ln of the probability of texts that the rules allow, of silence.
    anyway: HashMap<Vec<Token>, f64>,
}

/// Where the package is looked for.
#[must_use]
pub fn place() -> PathBuf {
    let folder = std::env::var_os(VARIABLE).unwrap_or_else(|| OsString::from(FOLDER));
    PathBuf::from(folder)
}

/// Where the package is, if it is installed.
#[must_use]
pub fn installed() -> Option<PathBuf> {
    let folder = place();
    (folder.join(MODEL).is_dir() && library(&folder).is_some()).then_some(folder)
}

/// The runtime's library in the package; its name has its version and a checksum in it.
fn library(folder: &Path) -> Option<PathBuf> {
    let entries = fs::read_dir(folder.join(LIBRARIES)).ok()?.flatten();
    let mut paths = entries.map(|entry| entry.path());
    paths.find(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("libonnxruntime")
    })
}

/// The runtime, of which a process has one.
fn runtime(library: &Path) -> Result<Environment, String> {
    static OPEN: Mutex<Option<Environment>> = Mutex::new(None);
    let mut open = OPEN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(runtime) = &*open {
        return Ok(runtime.clone());
    }
    let loaded = ort::init_from(library).map_err(|e| e.to_string())?;
    let runtime = loaded.build().map_err(|e| e.to_string())?;
    *open = Some(runtime.clone());
    Ok(runtime)
}

impl Moonshine {
    /// Makes the rules of a vocabulary, for the package in `folder`.
    ///
    /// # Errors
    /// [`SpeechError`] when the package is not there or cannot be run, or the language is not English.
    pub fn new(lexicon: &Lexicon, pack: &Pack, folder: &Path) -> Result<Self, SpeechError> {
        let place = folder.join(MODEL);
        let bad = |why: String| SpeechError::Model {
            path: place.clone(),
            why,
        };
        let phrases = Phrases::new(lexicon, pack, |_| true).ok_or(SpeechError::NoGrammar)?;
        let path = place.join("tokenizer.bin");
        let tokens = Tokens::read(&fs::read(&path).map_err(file(&path))?).map_err(bad)?;
        let library = library(folder).ok_or_else(|| bad("no ONNX Runtime beside it".into()))?;
        let runtime = runtime(&library).map_err(bad)?;
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let failed = |e: ort::Error| bad(e.to_string());
        let mut model = Model::load(&runtime, &place, threads.min(2)).map_err(failed)?;
        let silence = model.hear(&vec![0.0; SILENCE]).map_err(failed)?;
        let search = |all: Vec<_>| {
            let rules: Vec<_> = all.into_iter().filter_map(|o| phrases.rule(o)).collect();
            Search::new(Paths::new(&rules))
        };
        Ok(Self {
            model,
            tokens,
            commands: search(phrases.any_command()),
            underway: search([phrases.any_command(), vec![Only::Refusal]].concat()),
            answers: search([phrases.answers(), phrases.any_command()].concat()),
            idle: phrases.idle(),
            silence,
            anyway: HashMap::new(),
        })
    }

    /// What is said in one utterance, samples of [`RATE`]; where it is in doubt, by the reckoning of
    /// `second` as well.
    ///
    /// # Errors
    /// [`SpeechError`].
    pub fn hear(
        &mut self,
        samples: &[i16],
        expected: Expected,
        second: Option<&Pocketsphinx>,
    ) -> Result<Spoken, SpeechError> {
        let scores = self.scores(samples, expected, second)?;
        Ok(scores.weigh(Weights::default())?)
    }

    /// How probable everything is.
    ///
    /// # Errors
    /// [`SpeechError`].
    pub fn scores(
        &mut self,
        samples: &[i16],
        expected: Expected,
        second: Option<&Pocketsphinx>,
    ) -> Result<Scores, SpeechError> {
        let mut scores = self.alone(samples, expected)?;
        if let Some(second) = second {
            scores.ask(|texts| second.fits(samples, texts))?;
        }
        Ok(scores)
    }

    fn alone(&mut self, samples: &[i16], expected: Expected) -> Result<Scores, SpeechError> {
        let search = match expected {
            Expected::Command => &mut self.commands,
            Expected::Underway => &mut self.underway,
            Expected::Answer => &mut self.answers,
        };
        let (model, tokens) = (&mut self.model, &self.tokens);
        let (silence, anyway) = (&self.silence, &mut self.anyway);
        let mut hear = || {
            let heard = model.hear(&prepared(samples))?;
            let mut allowed = search.allowed(model, tokens, &heard)?;
            allowed.truncate(MOST);
            let mut free = anything(model, tokens, &heard)?;
            // Of what is no answer nothing is made, whatever it says.
            if expected == Expected::Answer && allowed.iter().all(|w| w.text != free.text) {
                free.text.clear();
            }
            let new = allowed.iter().map(|w| w.pieces.as_slice());
            let new: Vec<_> = new.filter(|p| !anyway.contains_key(*p)).collect();
            let all = [new.as_slice(), &[free.pieces.as_slice()]].concat();
            let mut of_silence = model.whole(silence, &all)?;
            let free_anyway = of_silence.pop().unwrap_or_default();
            anyway.extend(new.iter().map(|p| p.to_vec()).zip(of_silence));
            let idle = &self.idle;
            let writing = |found: Found, anyway: f64| Writing {
                core: core(&found.text, idle),
                text: found.text,
                heard: found.score,
                anyway,
                fits: None,
            };
            let known = |found: Found| {
                let anyway = anyway.get(&found.pieces).copied();
                writing(found, anyway.unwrap_or_default())
            };
            Ok(Scores {
                allowed: allowed.into_iter().map(known).collect(),
                free: writing(free, free_anyway),
                loose: None,
                range: range(samples),
            })
        };
        let failed = |e: ort::Error| SpeechError::Program {
            program: "Moonshine".into(),
            why: e.to_string(),
        };
        hear().map_err(failed)
    }
}

/// A text without the words that change no meaning.
fn core(text: &str, idle: &[String]) -> String {
    let words = text.split(' ').filter(|w| idle.iter().all(|i| i != w));
    words.collect::<Vec<_>>().join(" ")
}

/// An utterance as the model takes it: as loud as those that it learnt from, with silence around.
fn prepared(samples: &[i16]) -> Vec<f32> {
    let peak = samples.iter().map(|s| s.unsigned_abs()).max().unwrap_or(0);
    let gain = LOUDEST / f32::from(peak.max(1));
    let silence = |n| std::iter::repeat_n(0.0, n);
    let voice = samples.iter().map(|&s| f32::from(s) * gain);
    let whole = silence(AROUND.0).chain(voice).chain(silence(AROUND.1));
    whole.collect()
}
