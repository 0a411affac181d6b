//! `deictic-eval speech`

use std::path::Path;
use std::time::Instant;

use anyhow::Context;
use deictic::language::pack::Pack;
use deictic::language::speech::pocketsphinx::{MODEL, Pocketsphinx, SCALE};
use deictic::language::speech::sound::range;
use deictic::language::speech::{Expected, samples};
use deictic::language::{Listener, Uncertainty};
use deictic::sensor_model::SensorModel;
use deictic::vocabulary::Lexicon;
use deictic_core::joint::Tables;
use deictic_core::profile::Profile;
use deictic_eval::speech::{Answer, FITTED, LEVELS, SCORED, Said, Trial, said, speak, talk};
use indicatif::ProgressBar;

/// Score speech from the voice to the decision, in whole intents.
///
/// Utterances of every action are spoken by espeak-ng, with noise by sox, heard by pocketsphinx and
/// fused with a hand that points at the object. Wrong is what is executed and was not meant. Of talk
/// between people nothing is to be executed.
#[derive(clap::Args)]
pub struct Speech {
    /// Utterances of each action per voice
    #[arg(long, default_value_t = 2)]
    rounds: usize,
    /// What the utterances are drawn from
    #[arg(long, default_value_t = 2)]
    seed: u64,
    /// How many of the voices
    #[arg(long, default_value_t = 6)]
    voices: usize,
    /// Take the voices that the scale of scores is fitted on, and score several scales
    #[arg(long)]
    fit: bool,
    /// Print what was not done right
    #[arg(long)]
    verbose: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Shares of one level's utterances, in percent.
#[derive(serde::Serialize)]
struct Score {
    model: &'static str,
    /// Whether these were no commands.
    talk: bool,
    /// In dB; `null` without noise.
    noise: Option<i32>,
    scale: f64,
    utterances: usize,
    right: f64,
    wrong: f64,
    asked: f64,
    /// Seconds per utterance, by the clock.
    seconds: f64,
}

struct Heard {
    said: Said,
    voice: &'static str,
    level: Option<i32>,
    scores: Vec<(String, f64)>,
    range: Option<f32>,
    seconds: f64,
}

impl Speech {
    pub fn run(self) -> anyhow::Result<()> {
        let lexicon = Lexicon::tabletop().map_err(|e| anyhow::anyhow!("{e}"))?;
        let pack = Pack::built_in("en")?;
        let recogniser = Pocketsphinx::new(&lexicon, &pack, Path::new(MODEL))?;
        let listener = Listener::new(&lexicon)?;
        let mut literal = listener.clone();
        literal.uncertainty = Uncertainty::LIKELIHOOD;
        let model = SensorModel::calibrated(&lexicon);
        let known = model.here().map_err(|e| anyhow::anyhow!("{e:?}"))?;
        let trials = [
            (
                "m3",
                Trial {
                    listener: &listener,
                    lexicon: &lexicon,
                    profile: Profile::default(),
                    sensors: Tables::NONE,
                },
            ),
            (
                "joint",
                Trial {
                    listener: &literal,
                    lexicon: &lexicon,
                    profile: Profile::JOINT,
                    sensors: known.view(),
                },
            ),
        ];
        let heard = self.hear(&lexicon, &pack, &recogniser)?;
        let scales: &[f64] = match self.fit {
            true => &[10.0, 15.0, 20.0, 30.0, 40.0, 60.0, 100.0],
            false => &[SCALE],
        };
        let mut scores = Vec::new();
        for (model, trial) in &trials {
            for &scale in scales {
                for (talk, level) in [false, true]
                    .into_iter()
                    .flat_map(|t| LEVELS.map(|l| (t, l)))
                {
                    let of_level = heard
                        .iter()
                        .filter(|h| h.level == level && h.said.truth[0].is_none() == talk);
                    let mut score = self.score(of_level, level, scale, trial);
                    (score.model, score.talk) = (model, talk);
                    scores.push(score);
                }
            }
        }
        if self.json {
            return super::print_json(&scores);
        }
        println!("model  said      noise    scale  right  wrong  asked  seconds");
        for s in &scores {
            let noise = s.noise.map_or("none".to_owned(), |n| format!("{n} dB"));
            let said = if s.talk { "talk" } else { "commands" };
            println!(
                "{:<6} {said:<9} {noise:<7} {:>6.0} {:>6.1} {:>6.1} {:>6.1} {:>8.2}",
                s.model, s.scale, s.right, s.wrong, s.asked, s.seconds
            );
        }
        Ok(())
    }

    fn hear(
        &self,
        lexicon: &Lexicon,
        pack: &Pack,
        recogniser: &Pocketsphinx,
    ) -> anyhow::Result<Vec<Heard>> {
        let (voices, seed) = if self.fit {
            (FITTED, self.seed + 1_000_000)
        } else {
            (SCORED, self.seed)
        };
        let folder = tempfile::tempdir().context("no folder for recordings")?;
        let bar = ProgressBar::new(
            (self.voices.min(voices.len()) * LEVELS.len() * (self.rounds * 9 + 12)) as u64,
        );
        let mut all = Vec::new();
        for (v, voice) in (0..).zip(voices).take(self.voices) {
            let seed = seed * 100 + v;
            let commands = said(lexicon, pack, self.rounds, seed);
            for said in commands.into_iter().chain(talk(seed)) {
                for level in LEVELS {
                    let recording = speak(folder.path(), voice, &said, level)?;
                    let began = Instant::now();
                    let sound = samples(&recording)?;
                    let scores = recogniser.scores(&sound, Expected::Command)?;
                    let said = said.clone();
                    all.push(Heard {
                        said,
                        voice,
                        level,
                        scores,
                        range: range(&sound),
                        seconds: began.elapsed().as_secs_f64(),
                    });
                    bar.inc(1);
                }
            }
        }
        bar.finish_and_clear();
        Ok(all)
    }

    fn score<'a>(
        &self,
        heard: impl Iterator<Item = &'a Heard>,
        noise: Option<i32>,
        scale: f64,
        trial: &Trial<'_>,
    ) -> Score {
        let (mut counts, mut utterances, mut seconds) = ([0_usize; 3], 0, 0.0);
        for h in heard {
            let answer = match Pocketsphinx::weigh(&h.scores, h.range, scale) {
                Ok(spoken) => trial.decide(&h.said, &spoken),
                Err(error) => Answer::Asked(error.to_string()),
            };
            if self.verbose && answer != Answer::Right {
                let best = h.scores.iter().take(4).map(|(t, s)| format!("{t} {s}"));
                let best: Vec<_> = best.collect();
                eprintln!(
                    "{noise:?} {}: {} -> {answer:?}; {}",
                    h.voice,
                    h.said.text,
                    best.join(", ")
                );
            }
            counts[match answer {
                Answer::Right => 0,
                Answer::Wrong(_) => 1,
                Answer::Asked(_) => 2,
            }] += 1;
            utterances += 1;
            seconds += h.seconds;
        }
        let share = |count: usize| count as f64 * 100.0 / utterances.max(1) as f64;
        Score {
            model: "",
            talk: false,
            noise,
            scale,
            utterances,
            right: share(counts[0]),
            wrong: share(counts[1]),
            asked: share(counts[2]),
            seconds: seconds / utterances.max(1) as f64,
        }
    }
}
