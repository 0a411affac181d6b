//! Moonshine, a small English speech model with an encoder that takes as long as the utterance is
//! (Jeffries et al. 2024, arXiv 2410.15608), from the package `moonshine-voice`.
//!
//! It writes down whatever it hears. Here it also says how probable every command of the vocabulary is,
//! by writing only what the rules allow, and the two are held against each other: what it would write
//! much rather than any command was talk.

mod model;
mod search;
mod tokens;

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use ort::environment::Environment;

use self::model::Model;
use self::search::{Search, anything};
use self::tokens::Tokens;
use super::Expected;
use super::error::SpeechError;
use super::paths::Paths;
use super::phrases::Phrases;
use super::program::file;
use super::sound::RATE;
use crate::language::pack::Pack;
use crate::language::{LanguageError, Spoken};
use crate::vocabulary::Lexicon;

/// The environment variable that names the folder with the package, which `cargo xtask` sets.
pub const VARIABLE: &str = "DEICTIC_MOONSHINE";

/// Where `cargo xtask setup` puts the package, from the project's root.
const FOLDER: &str = "target/moonshine";

/// The model in the package, and the runtime's library beside it.
const MODEL: &str = "moonshine_voice/assets/tiny-en";
const LIBRARIES: &str = "moonshine_voice.libs";

/// How far ahead, as ln and per word, what is written without rules must be of the likeliest command
/// for it to be as probable that the utterance was talk. A command is as many words and one more, for
/// the silence around them; words that it lacks add to the lead. Of six voices of espeak-ng at four
/// levels of noise, 24 sentences of talk were ahead by 4.0 and more, and 100, 96, 96 and 94 % of 54
/// commands by less.
pub const LEAD: f64 = 4.2;

/// How much more probable talk is when it is ahead by one more, as ln.
const STEEP: f64 = 10.0;

/// How much less probable a text is than it is taken for, as ln, when the rules do not have it: what
/// is said to a machine that takes commands is mostly one of them.
const OTHERWISE: f64 = 6.0;

/// How far a text must be behind, as ln, to be e times less probable.
pub const SCALE: f64 = 1.0;

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
    answers: Search,
}

/// What was heard, before it is weighed.
#[derive(Clone, Debug, PartialEq)]
pub struct Scores {
    /// What the rules allow, with ln of its probability.
    pub allowed: Vec<(String, f64)>,
    /// What was written without rules.
    pub free: (String, f64),
}

impl Scores {
    /// What they say if talk must be ahead by `lead`, and what is behind by `scale` is e times less
    /// probable.
    ///
    /// # Errors
    /// [`LanguageError::Empty`] when nothing was heard.
    pub fn weigh(&self, scale: f64, lead: f64) -> Result<Spoken, LanguageError> {
        let (text, score) = &self.free;
        let mut all = self.allowed.clone();
        if let Some((best, top)) = self.allowed.first() {
            let count = |text: &str| text.split_whitespace().count();
            let words = count(best);
            let lacking = count(text).saturating_sub(words) as f64;
            let ahead = (score - top + lacking) / (1.0 + words as f64);
            all.push((String::new(), top + scale * STEEP * (ahead - lead)));
        } else {
            all.push((String::new(), *score));
        }
        // What the rules have as well is no other hypothesis.
        if !text.is_empty() && self.allowed.iter().all(|(t, _)| t != text) {
            all.push((text.clone(), score - OTHERWISE));
        }
        let top = all.iter().map(|s| s.1).fold(f64::NEG_INFINITY, f64::max);
        all.retain(|s| s.1 > top - FARTHEST * scale);
        Spoken::of_scores(all, scale)
    }
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
        let model = Model::load(&runtime, &place, threads.min(2));
        let search = |all: Vec<_>| {
            let rules: Vec<_> = all.into_iter().filter_map(|o| phrases.rule(o)).collect();
            Search::new(Paths::new(&rules))
        };
        Ok(Self {
            model: model.map_err(|e| bad(e.to_string()))?,
            tokens,
            commands: search(phrases.any_command()),
            answers: search([phrases.answers(), phrases.any_command()].concat()),
        })
    }

    /// What is said in one utterance, samples of [`RATE`].
    ///
    /// # Errors
    /// [`SpeechError`].
    pub fn hear(&mut self, samples: &[i16], expected: Expected) -> Result<Spoken, SpeechError> {
        let scores = self.scores(samples, expected)?;
        Ok(scores.weigh(SCALE, LEAD)?)
    }

    /// How probable everything is.
    ///
    /// # Errors
    /// [`SpeechError`].
    pub fn scores(&mut self, samples: &[i16], expected: Expected) -> Result<Scores, SpeechError> {
        let search = match expected {
            Expected::Command => &mut self.commands,
            Expected::Answer => &mut self.answers,
        };
        let (model, tokens) = (&mut self.model, &self.tokens);
        let mut hear = || {
            let heard = model.hear(&prepared(samples))?;
            let allowed = search.allowed(model, tokens, &heard)?;
            let (text, score) = anything(model, tokens, &heard)?;
            // Of what is no answer nothing is made, whatever it says.
            let text = match expected {
                Expected::Answer if allowed.iter().all(|(t, _)| *t != text) => String::new(),
                _ => text,
            };
            Ok(Scores {
                allowed,
                free: (text, score),
            })
        };
        let failed = |e: ort::Error| SpeechError::Program {
            program: "Moonshine".into(),
            why: e.to_string(),
        };
        hear().map_err(failed)
    }
}

/// Texts further than this behind the best cannot count.
const FARTHEST: f64 = 12.0;

/// An utterance as the model takes it: as loud as those that it learnt from, with silence around.
fn prepared(samples: &[i16]) -> Vec<f32> {
    let peak = samples.iter().map(|s| s.unsigned_abs()).max().unwrap_or(0);
    let gain = LOUDEST / f32::from(peak.max(1));
    let silence = |n| std::iter::repeat_n(0.0, n);
    let voice = samples.iter().map(|&s| f32::from(s) * gain);
    let whole = silence(AROUND.0).chain(voice).chain(silence(AROUND.1));
    whole.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(allowed: &[(&str, f64)], free: (&str, f64)) -> Spoken {
        let owned = |&(text, score): &(&str, f64)| (text.to_owned(), score);
        let scores = Scores {
            allowed: allowed.iter().map(owned).collect(),
            free: owned(&free),
        };
        scores.weigh(SCALE, LEAD).unwrap()
    }

    #[test]
    fn what_would_much_rather_be_written_was_talk() {
        let odd = heard(&[("pick the cup", -5.0)], ("big the kappa", -2.0));
        assert_eq!(odd.best(), "pick the cup");
        let talk = heard(&[("up", -14.0)], ("the weather is lovely", -2.0));
        assert_eq!(talk.best(), "");
        assert_eq!(heard(&[], ("hm", -1.0)).best(), "");
    }

    #[test]
    fn what_the_rules_lack_is_a_hypothesis_and_what_they_have_is_no_other() {
        let asked = heard(&[("pick the cup", -11.0)], ("should i pick the cup", -1.0));
        assert_eq!(asked.best(), "should i pick the cup");
        let same = heard(&[("pick the cup", -1.0)], ("pick the cup", -1.2));
        assert_eq!(same.certain(0.01), Some("pick the cup"));
    }
}
