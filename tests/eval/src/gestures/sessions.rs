//! Whole gesture sessions of made-up people before the unit's hand reader: what share says what was
//! meant, and what went wrong with the others.

use std::collections::BTreeMap;

use deictic::hand::acting::acts;
use deictic::hand::meaning::HandSetup;
use deictic::hand::session::made_up;
use deictic::hand::taught::Taught;
use deictic::scene::{SceneFile, Tabletop};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::gesture::context::{Context, Event};
use deictic_core::gesture::mapping::Mapping;
use deictic_core::gesture::reader::HandReader;
use deictic_core::gesture::stroke::Templates;
use deictic_core::gesture::vector;
use deictic_core::large;
use deictic_core::math;
use deictic_core::time::Micros;
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::Serialize;

type Reader = HandReader<{ large::OPTIONS }, { large::CATEGORIES }, { large::WORDS }>;

/// Frames per second.
const RATE: f64 = 110.0;

/// Where the hand of a made-up person is that points, in the sensor's axes, mm.
const HAND: [f32; 3] = [0.0, 220.0, -100.0];

/// Things nearer to each other than this, rad, cannot be told apart by people who miss by two degrees in two
/// directions: eight degrees.
const NEAR: f32 = 0.14;

/// A word of a session: its category and option.
type Word = (Category, u8);

/// How the sessions went.
#[derive(Debug, Default, Serialize)]
pub struct Score {
    /// Share of sessions whose sentence is the one that was meant, in percent.
    pub accuracy: f64,
    /// How many sessions.
    pub n: usize,
    /// Wrong sessions by what went wrong first, with one that did: its seed and its script.
    pub causes: BTreeMap<String, Cause>,
}

/// Something that goes wrong.
#[derive(Debug, Default, Serialize)]
pub struct Cause {
    /// How often.
    pub sessions: usize,
    /// Examples: seed, script, what was read.
    pub examples: Vec<String>,
}

/// A table with a vocabulary to gesture at.
pub struct Bench {
    lexicon: Lexicon,
    table: Tabletop,
    setup: HandSetup,
    mapping: Mapping,
}

/// What a person is to show, and what it means.
#[derive(Clone, Debug)]
pub struct Script {
    text: String,
    meant: Vec<Word>,
    /// Whether the stop gesture is in it.
    stops: bool,
}

impl Bench {
    /// The table and the vocabulary that come with `deictic`.
    ///
    /// # Errors
    /// When they do not fit each other.
    pub fn new() -> anyhow::Result<Self> {
        let lexicon = Lexicon::tabletop()?;
        let table = SceneFile::table()?.tabletop(&lexicon)?;
        let setup = HandSetup::new(&lexicon, table.hand(), Taught::default());
        let mut mapping = Mapping::new();
        let actions = lexicon.entries(Category::ACTION).len();
        for meaning in &setup.meanings {
            let set = mapping.set(meaning.gesture, meaning.action, actions);
            set.map_err(|e| anyhow::anyhow!("{e:?}"))?;
        }
        Ok(Self {
            lexicon,
            table,
            setup,
            mapping,
        })
    }

    /// Sessions of `n` people, the first of them this one, who miss what they point at by `aim` rad and show all the
    /// same, or what chance tells each of them to.
    #[must_use]
    pub fn score(&self, first: u64, n: usize, aim: f64, shown: Option<&Script>) -> Score {
        let wrong: Vec<(String, String)> = (first..first + n as u64)
            .into_par_iter()
            .filter_map(|seed| self.wrong(seed, aim, shown))
            .collect();
        let mut score = Score {
            accuracy: 100.0 * (n - wrong.len()) as f64 / n.max(1) as f64,
            n,
            ..Score::default()
        };
        for (cause, example) in wrong {
            let cause = score.causes.entry(cause).or_default();
            cause.sessions += 1;
            if cause.examples.len() < 5 {
                cause.examples.push(example);
            }
        }
        score
    }

    /// What these gestures and things mean, in their order; `None` for a word that is neither.
    #[must_use]
    pub fn of(&self, text: &str) -> Option<Script> {
        let words = text.split_whitespace();
        let meant = words.map(|word| self.meaning(word)).collect::<Option<_>>();
        let script = Script {
            text: text.split_whitespace().collect::<Vec<_>>().join(" "),
            meant: meant?,
            stops: false,
        };
        let stop = self.lexicon.vocabulary().stop();
        let stops = script
            .meant
            .iter()
            .any(|w| w.0 == Category::ACTION && Some(w.1) == stop);
        Some(Script { stops, ..script })
    }

    fn meaning(&self, word: &str) -> Option<Word> {
        let actions = self.lexicon.entries(Category::ACTION).iter().zip(0_u8..);
        let mut meant = actions.filter(|(entry, _)| entry.gestures.iter().any(|g| g == word));
        if let Some((_, action)) = meant.next() {
            return Some((Category::ACTION, action));
        }
        let thing = |category| Some((category, self.lexicon.option(category, word)?));
        [Category::OBJECT, Category::STORAGE]
            .into_iter()
            .filter_map(thing)
            .find(|(category, option)| self.table.find(*category, *option).is_some())
    }

    /// A sentence by chance: an action by one of its gestures, before or after the things it takes.
    fn script(&self, rng: &mut ChaCha8Rng) -> Script {
        let vocabulary = self.lexicon.vocabulary();
        let shown: Vec<(String, u8)> = self
            .lexicon
            .entries(Category::ACTION)
            .iter()
            .zip(0_u8..)
            .flat_map(|(entry, action)| entry.gestures.iter().map(move |g| (g.clone(), action)))
            .filter(|(gesture, _)| acts(gesture, &self.table, &self.lexicon).is_ok())
            .collect();
        let Some((gesture, action)) = shown.choose(rng).cloned() else {
            return Script {
                text: String::new(),
                meant: Vec::new(),
                stops: false,
            };
        };
        let mut things = Vec::new();
        let signature = vocabulary.actions()[usize::from(action)].signature;
        for category in [Category::OBJECT, Category::STORAGE] {
            if signature.compulsory.contains(category.index()) {
                let all = self.table.scene().entities().iter();
                let fitting: Vec<u8> = all
                    .filter(|e| e.category == category)
                    .map(|e| e.option)
                    .collect();
                things.extend(fitting.choose(rng).map(|option| (category, *option)));
            }
        }
        let names = things
            .iter()
            .map(|(category, option)| self.lexicon.option_name(*category, *option));
        let mut words: Vec<(String, Word)> = names.zip(things.iter().copied()).collect();
        let at = if rng.random_bool(0.7) { 0 } else { words.len() };
        words.insert(at, (gesture, (Category::ACTION, action)));
        Script {
            text: words
                .iter()
                .map(|w| w.0.as_str())
                .collect::<Vec<_>>()
                .join(" "),
            meant: words.iter().map(|w| w.1).collect(),
            stops: vocabulary.stop() == Some(action),
        }
    }

    /// What went wrong with a person's session, and which it was.
    fn wrong(&self, seed: u64, aim: f64, shown: Option<&Script>) -> Option<(String, String)> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let script = shown.cloned().unwrap_or_else(|| self.script(&mut rng));
        let acts = acts(&script.text, &self.table, &self.lexicon).ok()?;
        let samples = made_up(seed, self.setup.settings.mount, aim, &acts, RATE);
        let context = Context {
            vocabulary: self.lexicon.vocabulary(),
            scene: self.table.scene(),
            mapping: &self.mapping,
            templates: Templates::KNOWN,
            mount: &self.setup.settings.mount,
            aim: &self.setup.settings.aim,
        };
        let mut reader = Reader::new();
        let (mut read, mut stopped) = (Vec::new(), false);
        for (sample, i) in samples.iter().zip(0_u64..) {
            let event = reader.take(Micros(i * 9_000), sample, &context);
            stopped |= event == Some(Event::Stop);
            if matches!(event, Some(Event::Said | Event::Stop)) {
                let words = reader.said().words().iter();
                read = words
                    .filter_map(|w| {
                        let best = math::argmax(w.likelihoods())?;
                        Some((w.category()?, u8::try_from(best).ok()?))
                    })
                    .collect();
            }
        }
        let cause = self.cause(&script, &read, stopped)?;
        let read: Vec<String> = read
            .iter()
            .map(|(c, o)| self.lexicon.option_name(*c, *o))
            .collect();
        Some((
            cause,
            format!("{seed}: {} -> {}", script.text, read.join(" ")),
        ))
    }

    fn cause(&self, script: &Script, read: &[Word], stopped: bool) -> Option<String> {
        if stopped && !script.stops {
            return Some("stopped without a stop gesture".into());
        }
        if read == script.meant {
            return None;
        }
        let shown: Vec<&str> = script.text.split(' ').collect();
        for ((word, meant), i) in shown.iter().zip(&script.meant).zip(0..) {
            let Some(got) = read.get(i) else {
                return Some(format!("{} not read", kind(word, meant)));
            };
            if got == meant {
                continue;
            }
            return Some(if read.len() > script.meant.len() {
                format!("something more read at {}", kind(word, meant))
            } else if read.len() < script.meant.len() {
                format!("{} not read", kind(word, meant))
            } else if meant.0 != Category::ACTION && got.0 != Category::ACTION {
                let near = self.apart(*got, *meant)? < NEAR;
                let how = if near { "near to" } else { "away from" };
                format!("pointing at one thing taken for another {how} it")
            } else {
                format!("{} taken for another", kind(word, meant))
            });
        }
        Some("something more read at the end".into())
    }
}

impl Bench {
    /// The angle between two things as a hand at rest sees them, rad.
    fn apart(&self, one: Word, other: Word) -> Option<f32> {
        let mount = &self.setup.settings.mount;
        let from = mount.place(HAND);
        let at = |(category, option): Word| {
            let thing = self.table.find(category, option)?;
            Some(vector::sub(thing.position, from))
        };
        Some(vector::angle(at(one)?, at(other)?))
    }
}

fn kind<'a>(word: &'a str, meant: &Word) -> &'a str {
    if meant.0 == Category::ACTION {
        word
    } else {
        "pointing"
    }
}
