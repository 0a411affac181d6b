//! What a recogniser made of what voices said, kept so that it can be weighed in other ways.

use std::time::Instant;

use anyhow::Context;
use deictic::language::speech::moonshine::{Scores, Weights, Writing};
use deictic::language::speech::pocketsphinx::Pocketsphinx;
use deictic::language::speech::sound::range;
use deictic::language::speech::{Expected, Recogniser, samples};
use deictic::language::{LanguageError, Spoken};

use super::{LEVELS, Said, speak};

/// One recording, heard.
#[derive(serde::Serialize, serde::Deserialize)]
pub struct Heard {
    /// What was said.
    pub said: Said,
    /// By whom.
    pub voice: String,
    /// How much louder than the noise, in dB; `None` without noise.
    pub level: Option<i32>,
    /// What the recogniser made of it.
    pub scores: Scored,
    /// How long that took, by the clock.
    pub seconds: f64,
}

/// What a recogniser made of it.
#[derive(serde::Serialize, serde::Deserialize)]
pub enum Scored {
    /// Moonshine, with or without a second opinion.
    Moonshine(Scores),
    /// Pocketsphinx: texts with its scores, and how far the voice stands out.
    Pocketsphinx(Vec<(String, f64)>, Option<f32>),
}

impl Scored {
    fn of(recogniser: &mut Recogniser, sound: &[i16]) -> anyhow::Result<Self> {
        Ok(match recogniser {
            Recogniser::Moonshine(m, second) => {
                let scores = m.scores(sound, Expected::Command, second.as_ref())?;
                Self::Moonshine(scores)
            }
            Recogniser::Pocketsphinx(p) => {
                Self::Pocketsphinx(p.scores(sound, Expected::Command)?, range(sound))
            }
        })
    }

    /// What it says, weighed so.
    ///
    /// # Errors
    /// [`LanguageError::Empty`] when nothing was heard.
    pub fn weigh(&self, weights: Weights) -> Result<Spoken, LanguageError> {
        match self {
            Self::Moonshine(scores) => scores.weigh(weights),
            Self::Pocketsphinx(scores, range) => Pocketsphinx::weigh(scores, *range, weights.scale),
        }
    }

    /// The likeliest texts, for people.
    #[must_use]
    pub fn told(&self) -> String {
        let told = |w: &Writing| format!("{} {:.1} {:.1}", w.text, w.heard, w.anyway);
        let best: Vec<_> = match self {
            Self::Moonshine(scores) => {
                let best = scores.allowed.iter().take(4).chain([&scores.free]);
                best.map(told).collect()
            }
            Self::Pocketsphinx(scores, _) => {
                let best = scores.iter().take(4);
                best.map(|(text, score)| format!("{text} {score:.0}"))
                    .collect()
            }
        };
        best.join(", ")
    }
}

impl Heard {
    /// Everything that a voice says, at every level of noise; `done` after each recording.
    ///
    /// # Errors
    /// When espeak-ng, sox or the recogniser fails.
    pub fn of_voice(
        voice: &str,
        all: &[Said],
        recogniser: &mut Recogniser,
        mut done: impl FnMut(),
    ) -> anyhow::Result<Vec<Self>> {
        let folder = tempfile::tempdir().context("no folder for recordings")?;
        let mut heard = Vec::new();
        for said in all {
            for level in LEVELS {
                let recording = speak(folder.path(), voice, said, level)?;
                let began = Instant::now();
                let sound = samples(&recording)?;
                let scores = Scored::of(recogniser, &sound)?;
                heard.push(Self {
                    said: said.clone(),
                    voice: voice.to_owned(),
                    level,
                    scores,
                    seconds: began.elapsed().as_secs_f64(),
                });
                done();
            }
        }
        Ok(heard)
    }
}
