//! `deictic-eval speech`

use std::path::{Path, PathBuf};

use anyhow::Context;
use deictic::language::pack::Pack;
use deictic::language::speech::moonshine::Weights;
use deictic::language::speech::pocketsphinx::{self, MODEL};
use deictic::language::speech::{Kind, Recogniser};
use deictic::language::{Listener, Uncertainty};
use deictic::sensor_model::SensorModel;
use deictic::vocabulary::Lexicon;
use deictic_core::joint::Tables;
use deictic_core::profile::Profile;
use deictic_eval::speech::{Answer, FITTED, Heard, LEVELS, SCORED, Trial, said, talk};
use indicatif::ProgressBar;

/// Score speech from the voice to the decision, in whole intents.
///
/// Utterances of every action are spoken by espeak-ng, with noise by sox, heard by a recogniser and
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
    /// What hears: moonshine, pocketsphinx, or best, which is moonshine where it is installed
    #[arg(long, default_value = "best")]
    recogniser: Kind,
    /// Take the voices that the recognisers' figures are fitted on
    #[arg(long)]
    fit: bool,
    /// Score how far a text must be behind to be e times less probable
    #[arg(long, value_delimiter = ',')]
    scale: Vec<f64>,
    /// Score how far talk must be ahead of commands, heard by Moonshine
    #[arg(long, value_delimiter = ',')]
    lead: Vec<f64>,
    /// Score what it adds that any sounds fit better than the commands do
    #[arg(long, value_delimiter = ',')]
    loose: Vec<f64>,
    /// Score how much of Moonshine's habits is taken away
    #[arg(long, value_delimiter = ',')]
    habit: Vec<f64>,
    /// Score how little pocketsphinx's opinion counts beside Moonshine's
    #[arg(long, value_delimiter = ',')]
    second: Vec<f64>,
    /// Score how much noise makes everything doubtful, heard by Moonshine
    #[arg(long, value_delimiter = ',')]
    power: Vec<f64>,
    /// Keep what was heard in this file; when it is there, decide on that and hear nothing
    #[arg(long, value_name = "FILE")]
    heard: Option<PathBuf>,
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
    recogniser: &'static str,
    scale: f64,
    /// Moonshine's bar against talk.
    lead: f64,
    /// What it adds that any sounds fit better.
    loose: f64,
    /// How much of Moonshine's habits is taken away.
    habit: f64,
    /// What pocketsphinx's scores count.
    second: f64,
    /// What noise makes of the scale.
    power: f64,
    utterances: usize,
    right: f64,
    wrong: f64,
    asked: f64,
    /// Seconds per utterance, by the clock.
    seconds: f64,
}

impl Speech {
    pub fn run(self) -> anyhow::Result<()> {
        let lexicon = Lexicon::tabletop().map_err(|e| anyhow::anyhow!("{e}"))?;
        let pack = Pack::built_in("en")?;
        let mut recogniser = Recogniser::open(self.recogniser, &lexicon, &pack, Path::new(MODEL))?;
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
        let heard = self.kept(&lexicon, &pack, &mut recogniser)?;
        let (recogniser, figures) = self.figures(&recogniser);
        let mut scores = Vec::new();
        for (model, trial) in &trials {
            for &weights in &figures {
                for (talk, level) in [false, true]
                    .into_iter()
                    .flat_map(|t| LEVELS.map(|l| (t, l)))
                {
                    let of_level = heard
                        .iter()
                        .filter(|h| h.level == level && h.said.truth[0].is_none() == talk);
                    let mut score = self.score(of_level, level, weights, trial);
                    (score.model, score.talk, score.recogniser) = (model, talk, recogniser);
                    scores.push(score);
                }
            }
        }
        if self.json {
            return super::print_json(&scores);
        }
        println!("heard by {recogniser}");
        println!(
            "model  said      noise    scale  lead  loose  habit  second  power  right  wrong  asked  seconds"
        );
        for s in &scores {
            let noise = s.noise.map_or("none".to_owned(), |n| format!("{n} dB"));
            let said = if s.talk { "talk" } else { "commands" };
            println!(
                "{:<6} {said:<9} {noise:<7} {:>6.1} {:>5.1} {:>6.2} {:>6.1} {:>7.0} {:>6.2} {:>6.1} {:>6.1} {:>6.1} {:>8.2}",
                s.model,
                s.scale,
                s.lead,
                s.loose,
                s.habit,
                s.second,
                s.power,
                s.right,
                s.wrong,
                s.asked,
                s.seconds
            );
        }
        Ok(())
    }

    /// The recogniser's name, and the weights that are scored.
    fn figures(&self, recogniser: &Recogniser) -> (&'static str, Vec<Weights>) {
        let usual = Weights::default();
        let (name, scale) = match recogniser {
            Recogniser::Moonshine(_, None) => ("moonshine", usual.scale),
            Recogniser::Moonshine(_, Some(_)) => ("moonshine and pocketsphinx", usual.scale),
            Recogniser::Pocketsphinx(_) => ("pocketsphinx", pocketsphinx::SCALE),
        };
        let mut all = vec![Weights { scale, ..usual }];
        let mut vary = |figures: &[f64], with: fn(Weights, f64) -> Weights| {
            if !figures.is_empty() {
                let each = all
                    .iter()
                    .flat_map(|w| figures.iter().map(|f| with(*w, *f)));
                all = each.collect();
            }
        };
        vary(&self.scale, |w, scale| Weights { scale, ..w });
        vary(&self.lead, |w, lead| Weights { lead, ..w });
        vary(&self.loose, |w, loose| Weights { loose, ..w });
        vary(&self.habit, |w, habit| Weights { habit, ..w });
        vary(&self.second, |w, second| Weights { second, ..w });
        vary(&self.power, |w, noise| Weights { noise, ..w });
        (name, all)
    }

    /// What was heard, this time or before.
    fn kept(
        &self,
        lexicon: &Lexicon,
        pack: &Pack,
        recogniser: &mut Recogniser,
    ) -> anyhow::Result<Vec<Heard>> {
        let Some(file) = &self.heard else {
            return self.hear(lexicon, pack, recogniser);
        };
        let wrong = || format!("{}", file.display());
        if let Ok(kept) = std::fs::read(file) {
            return serde_json::from_slice(&kept).with_context(wrong);
        }
        let heard = self.hear(lexicon, pack, recogniser)?;
        std::fs::write(file, serde_json::to_vec(&heard)?).with_context(wrong)?;
        Ok(heard)
    }

    fn hear(
        &self,
        lexicon: &Lexicon,
        pack: &Pack,
        recogniser: &mut Recogniser,
    ) -> anyhow::Result<Vec<Heard>> {
        let (voices, seed) = if self.fit {
            (FITTED, self.seed + 1_000_000)
        } else {
            (SCORED, self.seed)
        };
        let voices = (0..).zip(voices).take(self.voices);
        let all = voices.map(|(v, voice)| {
            let seed = seed * 100 + v;
            let mut all = said(lexicon, pack, self.rounds, seed);
            all.extend(talk(seed, self.fit));
            (voice, all)
        });
        let all: Vec<_> = all.collect();
        let count: usize = all.iter().map(|(_, said)| said.len() * LEVELS.len()).sum();
        let bar = ProgressBar::new(count as u64);
        let mut heard = Vec::new();
        for (voice, said) in &all {
            heard.extend(Heard::of_voice(voice, said, recogniser, || bar.inc(1))?);
        }
        bar.finish_and_clear();
        Ok(heard)
    }

    fn score<'a>(
        &self,
        heard: impl Iterator<Item = &'a Heard>,
        noise: Option<i32>,
        weights: Weights,
        trial: &Trial<'_>,
    ) -> Score {
        let (mut counts, mut utterances, mut seconds) = ([0_usize; 3], 0, 0.0);
        for h in heard {
            let answer = match h.scores.weigh(weights) {
                Ok(spoken) => trial.decide(&h.said, &spoken),
                Err(error) => Answer::Asked(error.to_string()),
            };
            if self.verbose && answer != Answer::Right {
                eprintln!(
                    "{noise:?} {}: {} -> {answer:?}; {}",
                    h.voice,
                    h.said.text,
                    h.scores.told()
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
            recogniser: "",
            scale: weights.scale,
            lead: weights.lead,
            loose: weights.loose,
            habit: weights.habit,
            second: weights.second,
            power: weights.noise,
            utterances,
            right: share(counts[0]),
            wrong: share(counts[1]),
            asked: share(counts[2]),
            seconds: seconds / utterances.max(1) as f64,
        }
    }
}
