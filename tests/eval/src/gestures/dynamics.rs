//! Dynamic gestures: reading strokes, learning templates, scoring.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context, bail};
use deictic::hand::movement::{GESTURES, Manner};
use deictic_core::gesture::path;
use deictic_core::gesture::stroke::{Comparison, Scale, Template, distance};
use deictic_core::time::Micros;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::Serialize;

use super::hands;

/// As many gestures as one comparison tells apart here.
pub const GESTURES_AT_MOST: usize = 64;

/// One performance of a gesture.
#[derive(Clone, Debug)]
pub struct Performance {
    /// Who performed it.
    pub subject: String,
    /// Which gesture it is.
    pub gesture: String,
    /// Its stroke as the unit sees it; `None` when the palm hardly moved.
    pub stroke: Option<path::Stroke>,
}

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

/// The stroke that the unit makes of points (ms, mm), by the very steps of the unit.
pub fn stroke(points: impl Iterator<Item = (f64, [f64; 3])>) -> Option<path::Stroke> {
    let mut path = path::Path::new();
    let mut first = None;
    for (t, point) in points {
        let since = t - *first.get_or_insert(t);
        path.push(
            Micros((since.max(0.0) * 1e3) as u64),
            point.map(|x| x as f32),
        );
    }
    path.stroke()
}

/// What the unit needs to recognise gestures.
#[derive(Clone, Debug)]
pub struct Learned {
    /// Names, by the templates' numbers.
    pub gestures: Vec<String>,
    /// Examples of each.
    pub templates: Vec<Template>,
    /// How distances become probabilities.
    pub scale: Scale,
}

/// Learns templates: every performance is one, or, where there are more than `each` of a gesture,
/// the ones that lie in the middle of the others.
///
/// # Errors
/// When there is nothing to learn, or too much for the unit.
pub fn learn(performances: &[&Performance], each: usize) -> anyhow::Result<Learned> {
    let names: BTreeSet<&str> = performances
        .iter()
        .filter(|p| p.stroke.is_some())
        .map(|p| p.gesture.as_str())
        .collect();
    let gestures: Vec<String> = names.into_iter().map(str::to_owned).collect();
    if gestures.is_empty() {
        bail!("no stroke to learn from");
    }
    if gestures.len() > GESTURES_AT_MOST {
        bail!(
            "{} gestures; at most {GESTURES_AT_MOST} are told apart",
            gestures.len()
        );
    }
    let scale = Scale {
        shape: 0.05,
        length: 0.02,
        seconds: 0.02,
        reach: 0.5,
    };
    let mut templates = Vec::new();
    for (name, number) in gestures.iter().zip(0_u8..) {
        let strokes: Vec<path::Stroke> = performances
            .iter()
            .filter(|p| p.gesture == *name)
            .filter_map(|p| p.stroke)
            .collect();
        let chosen = middles(&strokes, each, &scale);
        templates.extend(
            chosen
                .into_iter()
                .map(|i| Template::new(number, &strokes[i])),
        );
    }
    Ok(Learned {
        gestures,
        templates,
        scale,
    })
}

/// Indices of `count` strokes such that every stroke has a near one among them (k-medoids, greedy).
fn middles(strokes: &[path::Stroke], count: usize, scale: &Scale) -> Vec<usize> {
    if strokes.len() <= count {
        return (0..strokes.len()).collect();
    }
    let table: Vec<Vec<f32>> = strokes
        .iter()
        .map(|a| {
            let to = |b| distance(a, &Template::new(0, b), scale, f32::INFINITY);
            strokes.iter().map(to).collect()
        })
        .collect();
    let mut near = vec![f32::INFINITY; strokes.len()];
    let mut chosen = Vec::new();
    for _ in 0..count {
        let cost = |c: &usize| -> f32 {
            let left = near.iter().zip(&table);
            left.map(|(n, row)| n.min(row[*c]).min(10.0)).sum()
        };
        let next = (0..strokes.len())
            .filter(|i| !chosen.contains(i))
            .min_by(|a, b| cost(a).total_cmp(&cost(b)));
        let Some(next) = next else { break };
        chosen.push(next);
        for (n, row) in near.iter_mut().zip(&table) {
            *n = n.min(row[next]);
        }
    }
    chosen
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
    let all = learned.templates.len();
    let Some(likely) = comparison.step(&learned.templates, &learned.scale, all) else {
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

/// Performances of made-up people: each gesture `takes` times.
#[must_use]
pub fn made_up(names: &[String], people: usize, takes: usize, seed: u64) -> Vec<Performance> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut performances = Vec::new();
    for person in 0..people {
        let manner = Manner::person(&mut rng);
        for name in names {
            for _ in 0..takes {
                let samples = manner.perform(name, 110.0, &mut rng);
                performances.push(Performance {
                    subject: format!("p{person}"),
                    gesture: name.clone(),
                    stroke: stroke(samples.unwrap_or_default().into_iter()),
                });
            }
        }
    }
    performances
}

/// The names of the unit's own gestures.
#[must_use]
pub fn own_names() -> Vec<String> {
    GESTURES.map(str::to_owned).to_vec()
}
