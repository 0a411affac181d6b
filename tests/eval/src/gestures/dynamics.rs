//! Dynamic gestures: reading strokes, learning templates, scoring.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::Path;

use anyhow::{Context, bail};
use deictic::hand::learning::{GESTURES_AT_MOST, Learned, learn};
use deictic::hand::movement::{GESTURES, Manner};
use deictic::hand::performance::{Performance, stroke};
use deictic_core::gesture::stroke::{Comparison, Templates};
use deictic_core::gesture::template::Scale;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::Serialize;

use super::hands;

/// Reads strokes: columns `subject`, `gesture`, `t_ms`, `x`, `y`, `z` and, when a person performs a
/// gesture more than once, `take`. Points of one stroke stand in the order of time.
///
/// # Errors
/// Names the line and what is wrong with it.
pub fn read(file: &Path) -> anyhow::Result<Vec<Performance>> {
    let mut reader = hands::open(file)?;
    let header = reader.headers()?.clone();
    let column = |name: &str| header.iter().position(|h| h == name);
    let needed = |name: &str| {
        column(name).with_context(|| format!("{}: no column `{name}`", file.display()))
    };
    let (subject, gesture, take) = (needed("subject")?, needed("gesture")?, column("take"));
    let numbers = [needed("t_ms")?, needed("x")?, needed("y")?, needed("z")?];
    let mut strokes: BTreeMap<[String; 3], Vec<[f64; 4]>> = BTreeMap::new();
    for record in reader.records() {
        let record = record?;
        let line = record.position().map_or(0, csv::Position::line);
        let text = |at: usize| record.get(at).unwrap_or_default().to_owned();
        let mut row = [0.0; 4];
        for (number, at) in row.iter_mut().zip(numbers) {
            match text(at).parse::<f64>() {
                Ok(value) if value.is_finite() => *number = value,
                _ => bail!(
                    "{} line {line}: {:?} is no number",
                    file.display(),
                    text(at)
                ),
            }
        }
        let key = [
            text(subject),
            text(gesture),
            take.map(text).unwrap_or_default(),
        ];
        strokes.entry(key).or_default().push(row);
    }
    let performance = |([subject, gesture, _], points): ([String; 3], Vec<[f64; 4]>)| Performance {
        subject,
        gesture,
        stroke: stroke(points.iter().map(|[t, x, y, z]| (*t, [*x, *y, *z]))),
    };
    Ok(strokes.into_iter().map(performance).collect())
}

/// How right the unit is.
#[derive(Debug, Default, Serialize)]
pub struct Score {
    /// Share of strokes told right, in percent.
    pub accuracy: f64,
    /// How many strokes were told.
    pub n: usize,
    /// Templates that each was compared with.
    pub templates: usize,
    /// Share of strokes of gestures that were not learned and yet taken for one with a probability
    /// over 0.9, in percent; absent when there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub false_accepts: Option<f64>,
    /// How often what was performed (first key) was taken for what (second key).
    pub confusion: BTreeMap<String, BTreeMap<String, usize>>,
}

/// What the unit takes a performance for, and how sure it is.
#[must_use]
pub fn tell<'a>(learned: &'a Learned, performance: &Performance) -> (&'a str, f32) {
    let Some(stroke) = performance.stroke else {
        return ("none", 1.0);
    };
    let mut comparison = Comparison::<GESTURES_AT_MOST>::new(stroke);
    let templates = Templates {
        known: &[],
        learned: &learned.templates,
        scale: &learned.scale,
    };
    let Some(likely) = comparison.step(&templates, templates.len()) else {
        return ("none", 1.0);
    };
    let known = &likely.gestures[..learned.gestures.len()];
    match deictic_core::math::argmax(known) {
        Some(best) if known[best] >= likely.none => (&learned.gestures[best], known[best]),
        _ => ("none", likely.none),
    }
}

/// Scores answers: what was performed, what it was taken for, how surely.
fn score(answers: &[(String, String, f32)], known: &BTreeSet<String>, templates: usize) -> Score {
    let mut score = Score {
        n: answers.len(),
        templates,
        ..Score::default()
    };
    let (mut right, mut outside, mut accepted) = (0, 0, 0);
    for (performed, taken, p) in answers {
        let strange = !known.contains(performed);
        let wanted = if strange { "none" } else { performed.as_str() };
        right += usize::from(taken == wanted);
        outside += usize::from(strange);
        accepted += usize::from(strange && taken != "none" && *p > 0.9);
        let row = score.confusion.entry(performed.clone()).or_default();
        *row.entry(taken.clone()).or_default() += 1;
    }
    let percent = |part: usize, of: usize| 100.0 * part as f64 / of.max(1) as f64;
    score.accuracy = percent(right, answers.len());
    score.false_accepts = (outside > 0).then(|| percent(accepted, outside));
    score
}

/// Learns from one set of performances and is scored on another.
///
/// # Errors
/// Those of [`learn`].
pub fn train_and_test(
    train: &[&Performance],
    test: &[&Performance],
    each: usize,
) -> anyhow::Result<Score> {
    let learned = learn(train, each)?;
    let answer = |p: &&Performance| {
        let (taken, sure) = tell(&learned, p);
        (p.gesture.clone(), taken.to_owned(), sure)
    };
    let answers: Vec<_> = test.par_iter().map(answer).collect();
    let known = learned.gestures.iter().cloned().collect();
    Ok(score(&answers, &known, learned.templates.len()))
}

/// Every person's performances, told by templates of the others.
///
/// # Errors
/// Those of [`learn`].
pub fn leave_one_out(all: &[Performance], each: usize) -> anyhow::Result<Score> {
    let people: BTreeSet<&str> = all.iter().map(|p| p.subject.as_str()).collect();
    if people.len() < 2 {
        bail!("leaving one person out needs two");
    }
    let parts: Vec<(Vec<_>, usize)> = people
        .into_par_iter()
        .map(|person| {
            let (held, kept): (Vec<_>, Vec<_>) = all.iter().partition(|p| p.subject == person);
            let learned = learn(&kept, each)?;
            let answer = |p: &&Performance| {
                let (taken, sure) = tell(&learned, p);
                (p.gesture.clone(), taken.to_owned(), sure)
            };
            Ok((held.iter().map(answer).collect(), learned.templates.len()))
        })
        .collect::<anyhow::Result<_>>()?;
    let known = all.iter().map(|p| p.gesture.clone()).collect();
    let templates = parts.iter().map(|p| p.1).max().unwrap_or_default();
    let answers: Vec<_> = parts.into_iter().flat_map(|p| p.0).collect();
    Ok(score(&answers, &known, templates))
}

/// What a made-up person did.
#[derive(Clone, Debug)]
pub struct Take {
    /// The person's number.
    pub subject: usize,
    /// Which gesture.
    pub gesture: String,
    /// How manieth time.
    pub take: usize,
    /// Time in ms, place in mm.
    pub samples: Vec<(f64, [f64; 3])>,
}

/// Made-up people perform each gesture `takes` times.
#[must_use]
pub fn perform(names: &[String], people: usize, takes: usize, seed: u64) -> Vec<Take> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut performed = Vec::new();
    for subject in 0..people {
        let manner = Manner::person(&mut rng);
        for name in names {
            for take in 0..takes {
                performed.push(Take {
                    subject,
                    gesture: name.clone(),
                    take,
                    samples: manner.perform(name, 110.0, &mut rng).unwrap_or_default(),
                });
            }
        }
    }
    performed
}

/// The same as the unit sees them.
#[must_use]
pub fn made_up(names: &[String], people: usize, takes: usize, seed: u64) -> Vec<Performance> {
    let seen = |take: Take| Performance {
        subject: format!("p{}", take.subject),
        gesture: take.gesture,
        stroke: stroke(take.samples.into_iter()),
    };
    let performed = perform(names, people, takes, seed);
    performed.into_iter().map(seen).collect()
}

/// Examples of each of the unit's own gestures: with 8, made-up strangers' swipes are now and
/// then taken for waves, which differ most from person to person.
const OWN: usize = 12;

/// Templates of the unit's own gestures, from forty made-up people.
///
/// # Errors
/// Those of [`learn`].
pub fn own_templates() -> anyhow::Result<Learned> {
    let performances = made_up(&own_names(), 40, 2, 11);
    Ok(learn(&performances.iter().collect::<Vec<_>>(), OWN)?)
}

/// The templates as Rust source for core/src/gesture/stroke_table.rs.
#[must_use]
pub fn table(learned: &Learned) -> String {
    let Scale {
        shape,
        length,
        seconds,
        reach,
    } = learned.scale;
    let mut text = format!(
        "//! Templates of the dynamic gestures that a unit knows without being taught, written by\n\
         //! `deictic-eval gestures train` from movements of made-up people.\n\n\
         use super::template::{{Scale, Template}};\n\n\
         /// How distances become probabilities.\n\
         pub const SCALE: Scale = Scale {{\n    shape: {shape:.4},\n    length: {length:.4},\n    \
         seconds: {seconds:.4},\n    reach: {reach:.4},\n}};\n\n\
         /// The gestures, by the number that templates carry.\n\
         pub const NAMES: [&str; {}] = {:?};\n\n\
         /// Examples of each gesture.\n#[rustfmt::skip]\npub static TEMPLATES: [Template; {}] = [\n",
        learned.gestures.len(),
        learned.gestures,
        learned.templates.len(),
    );
    for t in &learned.templates {
        let _ = writeln!(
            text,
            "    Template {{ gesture: {}, tolerance: {}, direct: {}, ln_length: {:.3}, ln_seconds: {:.3}, points: {:?} }},",
            t.gesture, t.tolerance, t.direct, t.ln_length, t.ln_seconds, t.points
        );
    }
    text.push_str("];\n");
    text
}

/// The names of the unit's own gestures.
#[must_use]
pub fn own_names() -> Vec<String> {
    GESTURES.map(str::to_owned).to_vec()
}

/// The 26 letters.
#[must_use]
pub fn letters() -> Vec<String> {
    ('a'..='z').map(String::from).collect()
}
