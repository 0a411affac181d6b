//! `deictic-eval speech`

use std::path::Path;
use std::time::Instant;

use anyhow::Context;
use deictic::language::pack::Pack;
use deictic::language::speech::moonshine::{self, LEAD, Scores};
use deictic::language::speech::pocketsphinx::{self, MODEL, Pocketsphinx};
use deictic::language::speech::sound::range;
use deictic::language::speech::{Expected, Kind, Recogniser, samples};
use deictic::language::{LanguageError, Listener, Spoken, Uncertainty};
use deictic::sensor_model::SensorModel;
use deictic::vocabulary::Lexicon;
use deictic_core::joint::Tables;
use deictic_core::profile::Profile;
use deictic_eval::speech::{Answer, FITTED, LEVELS, SCORED, Said, Trial, said, speak, talk};
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
    /// Take the voices that the recognisers' figures are fitted on, and score several of them
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
    recogniser: &'static str,
    scale: f64,
    /// Moonshine's bar against talk.
    lead: f64,
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
    scores: Scored,
    seconds: f64,
}

/// What a recogniser made of it.
enum Scored {
    Moonshine(Scores),
    Pocketsphinx(Vec<(String, f64)>, Option<f32>),
}

impl Scored {
    fn of(recogniser: &mut Recogniser, sound: &[i16]) -> anyhow::Result<Self> {
        Ok(match recogniser {
            Recogniser::Moonshine(m) => Self::Moonshine(m.scores(sound, Expected::Command)?),
            Recogniser::Pocketsphinx(p) => {
                Self::Pocketsphinx(p.scores(sound, Expected::Command)?, range(sound))
            }
        })
    }

    fn weigh(&self, (scale, lead): (f64, f64)) -> Result<Spoken, LanguageError> {
        match self {
            Self::Moonshine(scores) => scores.weigh(scale, lead),
            Self::Pocketsphinx(scores, range) => Pocketsphinx::weigh(scores, *range, scale),
        }
    }

    /// The likeliest texts, for people.
    fn told(&self) -> String {
        let (all, free) = match self {
            Self::Moonshine(scores) => (&scores.allowed, Some(&scores.free)),
            Self::Pocketsphinx(scores, _) => (scores, None),
        };
        let best = all.iter().take(4).chain(free);
        let best: Vec<_> = best
            .map(|(text, score)| format!("{text} {score:.1}"))
            .collect();
        best.join(", ")
    }
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
        let heard = self.hear(&lexicon, &pack, &mut recogniser)?;
        let (recogniser, figures) = self.figures(&recogniser);
        let mut scores = Vec::new();
        for (model, trial) in &trials {
            for &(scale, lead) in &figures {
                for (talk, level) in [false, true]
                    .into_iter()
                    .flat_map(|t| LEVELS.map(|l| (t, l)))
                {
                    let of_level = heard
                        .iter()
                        .filter(|h| h.level == level && h.said.truth[0].is_none() == talk);
                    let mut score = self.score(of_level, level, (scale, lead), trial);
                    (score.model, score.talk, score.recogniser) = (model, talk, recogniser);
                    scores.push(score);
                }
            }
        }
        if self.json {
            return super::print_json(&scores);
        }
        println!("heard by {recogniser}");
        println!("model  said      noise    scale  lead  right  wrong  asked  seconds");
        for s in &scores {
            let noise = s.noise.map_or("none".to_owned(), |n| format!("{n} dB"));
            let said = if s.talk { "talk" } else { "commands" };
            println!(
                "{:<6} {said:<9} {noise:<7} {:>6.1} {:>5.1} {:>6.1} {:>6.1} {:>6.1} {:>8.2}",
                s.model, s.scale, s.lead, s.right, s.wrong, s.asked, s.seconds
            );
        }
        Ok(())
    }

    /// The recogniser's name, and the scales and leads that are scored.
    fn figures(&self, recogniser: &Recogniser) -> (&'static str, Vec<(f64, f64)>) {
        let grid = |scales: &[f64], leads: &[f64]| {
            let all = scales
                .iter()
                .flat_map(|&s| leads.iter().map(move |&l| (s, l)));
            all.collect()
        };
        match (recogniser, self.fit) {
            (Recogniser::Moonshine(_), false) => ("moonshine", vec![(moonshine::SCALE, LEAD)]),
            (Recogniser::Moonshine(_), true) => {
                let leads = [3.4, 3.8, 4.2, 4.6, 5.0];
                ("moonshine", grid(&[0.7, 1.0, 1.5, 2.0], &leads))
            }
            (Recogniser::Pocketsphinx(_), false) => {
                ("pocketsphinx", vec![(pocketsphinx::SCALE, 0.0)])
            }
            (Recogniser::Pocketsphinx(_), true) => {
                let scales = [10.0, 15.0, 20.0, 30.0, 40.0, 60.0, 100.0];
                ("pocketsphinx", grid(&scales, &[0.0]))
            }
        }
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
                    let scores = Scored::of(recogniser, &sound)?;
                    let said = said.clone();
                    all.push(Heard {
                        said,
                        voice,
                        level,
                        scores,
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
        (scale, lead): (f64, f64),
        trial: &Trial<'_>,
    ) -> Score {
        let (mut counts, mut utterances, mut seconds) = ([0_usize; 3], 0, 0.0);
        for h in heard {
            let answer = match h.scores.weigh((scale, lead)) {
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
            scale,
            lead,
            utterances,
            right: share(counts[0]),
            wrong: share(counts[1]),
            asked: share(counts[2]),
            seconds: seconds / utterances.max(1) as f64,
        }
    }
}
