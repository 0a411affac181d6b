//! What is said, and how it sounds.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, ensure};
use deictic::language::pack::Pack;
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// An utterance and what is meant by it.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Said {
    /// The words.
    pub text: String,
    /// Names of the action, the object and the storage.
    pub truth: [Option<String>; 3],
    /// Words per minute.
    pub speed: u32,
    /// Its noise, as sox calls it.
    pub noise: String,
}

/// What people say in the same room and is to move nothing: talk, prohibitions, questions. None of it
/// is among [`OTHER_TALK`].
const TALK: [&str; 20] = [
    "don't pick the cup",
    "never put the cube into the drawer",
    "do not pour the bottle into the bowl",
    "please don't push the box",
    "should I pick the cup",
    "did you put the can into the bowl",
    "is the cube in the drawer",
    "who pushed the bottle",
    "can we talk about the budget later",
    "I had pasta for dinner",
    "the train was late again",
    "good morning everybody",
    "she moved to another city last year",
    "thank you very much",
    "it will probably rain tomorrow",
    "our guests arrive at noon",
    "did anyone feed the cat",
    "that movie was far too long",
    "remember to call your mother",
    "what a nice surprise",
];

/// The same for [`super::FITTED`] voices.
const OTHER_TALK: [&str; 20] = [
    "never take the mug",
    "do not stack the cube onto the foam",
    "don't slide the can",
    "don't let go",
    "where did you put the mug",
    "why is the block on the foam",
    "do you see the bottle",
    "can I take the carton",
    "what time is it now",
    "the weather is lovely today",
    "my sister lives in london",
    "we should have lunch together",
    "did you hear the news this morning",
    "he drives a red car to work",
    "the children are playing in the garden",
    "turn the music down a little",
    "have a nice weekend",
    "please call me back after five",
    "the meeting starts at nine",
    "could somebody open a window",
];

/// What is no command, one list or, for figures to be fitted by, another.
#[must_use]
pub fn talk(seed: u64, fit: bool) -> Vec<Said> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let said = |text: &str| Said {
        text: text.to_owned(),
        truth: [None, None, None],
        speed: 130 + 10 * random.random_range(0..4),
        noise: "pinknoise".into(),
    };
    let list = if fit { OTHER_TALK } else { TALK };
    list.into_iter().map(said).collect()
}

/// `rounds` utterances of every action of a vocabulary, in words drawn from it.
#[must_use]
pub fn said(lexicon: &Lexicon, pack: &Pack, rounds: usize, seed: u64) -> Vec<Said> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut all = Vec::new();
    let prepositions = pack.speech.as_ref().map(|s| s.preposition.clone());
    let prepositions = prepositions.unwrap_or_default();
    for _ in 0..rounds {
        for (a, action) in lexicon.vocabulary().actions().iter().enumerate() {
            let needs = |c: Category| action.signature.compulsory.contains(c.index());
            let mut draw = |category: Category, only: Option<usize>| {
                let entries = lexicon.entries(category);
                let option = only.unwrap_or_else(|| random.random_range(0..entries.len()));
                let entry = &entries[option];
                // "Put on" and "put inside" say where to, which comes later.
                let goes =
                    |w: &str| ["top", "inside"].contains(&w) || prepositions.iter().any(|p| p == w);
                let ends = |p: &String| p.split(' ').skip(1).any(goes);
                let phrases: Vec<_> = entry
                    .spoken()
                    .map(|p| p.replace('-', " "))
                    .filter(|p| !ends(p))
                    .collect();
                let phrase = phrases.get(random.random_range(0..phrases.len().max(1)));
                (phrase.cloned().unwrap_or_default(), entry.name.clone())
            };
            let (verb, name) = draw(Category::ACTION, Some(a));
            let (mut text, mut truth) = (verb, [Some(name), None, None]);
            if needs(Category::OBJECT) {
                let (phrase, name) = draw(Category::OBJECT, None);
                text = format!("{text} the {phrase}");
                truth[1] = Some(name);
            }
            if needs(Category::STORAGE) {
                let (phrase, name) = draw(Category::STORAGE, None);
                let stacks = truth[0].as_deref() == Some("stack");
                let preposition = if stacks { "onto" } else { "into" };
                text = format!("{text} {preposition} the {phrase}");
                truth[2] = Some(name);
            }
            if random.random_bool(0.15) {
                text = format!("please {text}");
            }
            let noises = ["pinknoise", "whitenoise", "brownnoise"];
            all.push(Said {
                text,
                truth,
                speed: 130 + 10 * random.random_range(0..4),
                noise: noises[random.random_range(0..noises.len())].into(),
            });
        }
    }
    all
}

/// A recording of an utterance in a voice of espeak-ng, so many dB louder than the noise; the same
/// for the same.
///
/// # Errors
/// When espeak-ng or sox fails.
pub fn speak(folder: &Path, voice: &str, said: &Said, snr: Option<i32>) -> anyhow::Result<PathBuf> {
    let file = |name: &str| folder.join(name);
    let clean = file("clean.wav");
    let mut espeak = Command::new("espeak-ng");
    espeak.args(["-v", voice, "-s", &said.speed.to_string(), "-w"]);
    let done = espeak.arg(&clean).arg("--").arg(&said.text).status();
    ensure!(done.context("espeak-ng")?.success(), "espeak-ng -v {voice}");
    let Some(snr) = snr else { return Ok(clean) };
    let (noise, loud, noisy) = (file("noise.wav"), file("loud.wav"), file("noisy.wav"));
    let (clean_name, noise_name) = (clean.to_string_lossy(), noise.to_string_lossy());
    let (loud_name, noisy_name) = (loud.to_string_lossy(), noisy.to_string_lossy());
    // Repeatable (-R), and as loud as asked for below the voice.
    sox(&[
        "-R",
        &clean_name,
        &noise_name,
        "synth",
        &said.noise,
        "norm",
        "-6",
    ])?;
    let gain = level(&clean_name)? - f64::from(snr) - level(&noise_name)?;
    sox(&[&noise_name, &loud_name, "gain", &format!("{gain:.2}")])?;
    sox(&[
        "-m",
        "-v",
        "1",
        &clean_name,
        "-v",
        "1",
        &loud_name,
        &noisy_name,
    ])?;
    Ok(noisy)
}

fn sox(arguments: &[&str]) -> anyhow::Result<String> {
    let output = Command::new("sox")
        .args(arguments)
        .output()
        .context("sox")?;
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    ensure!(output.status.success(), "sox {arguments:?}: {said}");
    Ok(said)
}

/// The level of a recording in dB below full scale.
fn level(file: &str) -> anyhow::Result<f64> {
    let stats = sox(&[file, "-n", "stats"])?;
    let line = stats.lines().find(|l| l.starts_with("RMS lev dB"));
    let figure = line.and_then(|l| l.split_whitespace().nth(3));
    Ok(figure.context("no level in sox's statistics")?.parse()?)
}
