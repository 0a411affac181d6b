//! Static gestures: training, cross-validation and scoring.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use deictic::hand::anatomy::{Anatomy, Place};
use deictic::hand::posture;
use deictic_core::gesture::curl;
use deictic_core::gesture::frame::{FINGERS, Side};
use deictic_core::gesture::shape::{self, Network, SHAPES, Shape};
use deictic_core::math;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::Serialize;

use super::hands::Labelled;
use super::network::{Example, Recipe, tempered, train};

/// Made-up people per shape; those that show none are as many as all others together.
const PEOPLE: usize = 1_200;

/// All recordings together count this many times as much as the made-up people of the shapes.
const RECORDED_WEIGHT: f64 = 8.0;

/// Parts of the recordings that judge each other's labels.
const INNER_FOLDS: usize = 4;

/// A recording whose label gets less than this from a network that did not see it is left out.
const CONTRADICTED: f32 = 0.1;

/// Hands of made-up people: per shape `people`, and as many showing none as a quarter of all.
#[must_use]
pub fn made_up(people: usize, seed: u64) -> Vec<Labelled> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let place = Place {
        side: Side::Right,
        palm: [0.0; 3],
        direction: [0.0, 0.0, -1.0],
        normal: [0.0, -1.0, 0.0],
    };
    let mut hands = Vec::new();
    for shape in Shape::ALL {
        let count = if shape == Shape::None { 4 } else { 1 } * people;
        while hands
            .iter()
            .filter(|h: &&Labelled| h.shape == shape)
            .count()
            < count
        {
            let anatomy = Anatomy::person(&mut rng);
            let posture = posture::of_shape(shape, &anatomy, &mut rng);
            if let Ok(features) = shape::features(&anatomy.frame(&posture, &place)) {
                hands.push(Labelled {
                    shape,
                    recording: 0,
                    features,
                    folds: [None; FINGERS],
                });
            }
        }
    }
    hands
}

fn examples(recorded: &[&Labelled], made_up: &[Labelled]) -> Vec<Example> {
    let example = |hand: &Labelled, weight: f64| Example {
        features: hand.features.map(f64::from),
        shape: hand.shape as usize,
        weight,
    };
    // Every recording counts the same, however long.
    let mut lengths: BTreeMap<u32, f64> = BTreeMap::new();
    for hand in recorded {
        *lengths.entry(hand.recording).or_default() += 1.0;
    }
    let shown = made_up.iter().filter(|h| h.shape != Shape::None).count() as f64;
    let each = RECORDED_WEIGHT * shown / lengths.len().max(1) as f64;
    recorded
        .iter()
        .map(|h| example(h, each / lengths[&h.recording]))
        .chain(made_up.iter().map(|h| example(h, 1.0)))
        .collect()
}

/// The same hands, those with a shape that no recording shows as *none of these*.
fn outside(mut hands: Vec<Labelled>, recorded: &[&Labelled]) -> Vec<Labelled> {
    let known: BTreeSet<Shape> = recorded.iter().map(|h| h.shape).collect();
    for hand in hands.iter_mut().filter(|h| !known.contains(&h.shape)) {
        hand.shape = Shape::None;
    }
    hands
}

/// Trains on recordings and made-up people. A shape that no recording shows is not learned.
///
/// Recordings that a network trained on the others holds for wrongly labelled (their label's mean
/// probability below `CONTRADICTED`) are left out. The answers to recordings not seen in training,
/// and to other made-up people, also give the temperature at which probabilities are right.
#[must_use]
pub fn learn(recorded: &[&Labelled], seed: u64) -> Network {
    let recipe = Recipe {
        seed,
        ..Recipe::default()
    };
    let people = outside(made_up(PEOPLE, seed), recorded);
    let folds = folds(recorded, INNER_FOLDS, seed);
    let trials: Vec<_> = (0..INNER_FOLDS)
        .into_par_iter()
        .map(|fold| {
            let (held, kept): (Vec<&Labelled>, Vec<&Labelled>) =
                recorded.iter().partition(|h| folds[&h.recording] == fold);
            (train(&examples(&kept, &people), &recipe), held)
        })
        .collect();
    let mut beliefs: BTreeMap<u32, (f32, f32)> = BTreeMap::new();
    for (network, held) in &trials {
        for (shape, recording, p) in answers(network, held) {
            let (sum, count) = beliefs.entry(recording).or_default();
            *sum += p[shape as usize];
            *count += 1.0;
        }
    }
    let sound = |hand: &&&Labelled| {
        let (sum, count) = beliefs[&hand.recording];
        sum > CONTRADICTED * count
    };
    let recorded: Vec<&Labelled> = recorded.iter().filter(sound).copied().collect();
    let strangers = outside(made_up(PEOPLE / 4, seed ^ 0xffff), &recorded);
    let mut unseen = Vec::new();
    for (network, held) in &trials {
        let held: Vec<&Labelled> = held.iter().filter(sound).copied().collect();
        unseen.push((network, examples(&held, &strangers)));
    }
    let loss = |temperature: f64| -> f64 {
        let mut sum = 0.0;
        for (network, examples) in &unseen {
            let network = tempered((*network).clone(), temperature);
            for example in examples {
                let p = network.classify(&example.features.map(|x| x as f32));
                sum -= f64::from(p[example.shape].max(1e-9)).ln() * example.weight;
            }
        }
        sum
    };
    let temperature = (10..=40)
        .map(|n| f64::from(n) / 10.0)
        .min_by(|a, b| loss(*a).total_cmp(&loss(*b)))
        .unwrap_or(1.0);
    tempered(train(&examples(&recorded, &people), &recipe), temperature)
}

/// A fold for every recording; each fold has its share of every shape.
fn folds(hands: &[&Labelled], count: usize, seed: u64) -> BTreeMap<u32, usize> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut folds = BTreeMap::new();
    for shape in Shape::ALL {
        let of_shape = hands.iter().filter(|h| h.shape == shape);
        let recordings: BTreeSet<u32> = of_shape.map(|h| h.recording).collect();
        let mut recordings: Vec<u32> = recordings.into_iter().collect();
        recordings.shuffle(&mut rng);
        for recording in recordings {
            let next = folds.len() % count;
            folds.entry(recording).or_insert(next);
        }
    }
    folds
}

/// How right a network is.
#[derive(Debug, Default, Serialize)]
pub struct Score {
    /// Share of hands told right, in percent.
    pub accuracy: f64,
    /// How many hands were told.
    pub n: usize,
    /// Share of hands that show none of the shapes but were taken for one with a probability over
    /// 0.9, in percent; absent when there are no such hands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub false_accepts: Option<f64>,
    /// Share of hands that were told right with a probability over 0.9, in percent.
    pub sure: f64,
    /// How often what was shown (first key) was taken for what (second key).
    pub confusion: BTreeMap<&'static str, BTreeMap<&'static str, usize>>,
    /// Recordings with wrong answers: recording, shown, taken for, frames.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub wrong: Vec<(u32, &'static str, &'static str, usize)>,
}

/// Scores answers: what was shown, the recording, the probabilities.
#[must_use]
pub fn score(answers: &[(Shape, u32, [f32; SHAPES])]) -> Score {
    let mut score = Score {
        n: answers.len(),
        ..Score::default()
    };
    let (mut right, mut sure, mut outside, mut accepted) = (0, 0, 0, 0);
    let mut wrong: BTreeMap<_, usize> = BTreeMap::new();
    for (shown, recording, probabilities) in answers {
        let best = math::argmax(probabilities).unwrap_or(SHAPES - 1);
        let taken = Shape::ALL[best];
        let confident = probabilities[best] > 0.9;
        let row = score.confusion.entry(shown.name()).or_default();
        *row.entry(taken.name()).or_default() += 1;
        if taken == *shown {
            right += 1;
            sure += usize::from(confident);
        } else {
            let key = (*recording, shown.name(), taken.name());
            *wrong.entry(key).or_default() += 1;
        }
        if *shown == Shape::None {
            outside += 1;
            accepted += usize::from(confident && taken != Shape::None);
        }
    }
    let percent = |part: usize, of: usize| 100.0 * part as f64 / of.max(1) as f64;
    score.accuracy = percent(right, answers.len());
    score.sure = percent(sure, answers.len());
    score.false_accepts = (outside > 0).then(|| percent(accepted, outside));
    score.wrong = wrong
        .into_iter()
        .map(|((r, s, t), n)| (r, s, t, n))
        .collect();
    score
}

/// What the unit makes of hands: a network's answers, without what the fingers rule out.
#[must_use]
pub fn answers(network: &Network, hands: &[&Labelled]) -> Vec<(Shape, u32, [f32; SHAPES])> {
    let answer = |hand: &&Labelled| {
        let mut probabilities = network.classify(&hand.features);
        curl::rule_out(&mut probabilities, &hand.folds);
        (hand.shape, hand.recording, probabilities)
    };
    hands.iter().map(answer).collect()
}

/// Answers to every hand by a network that saw none of its recording.
#[must_use]
pub fn cross_validate(
    hands: &[Labelled],
    count: usize,
    seed: u64,
) -> Vec<(Shape, u32, [f32; SHAPES])> {
    let all: Vec<&Labelled> = hands.iter().collect();
    let folds = folds(&all, count, seed);
    let parts: Vec<_> = (0..count)
        .into_par_iter()
        .map(|fold| {
            let (held, kept): (Vec<&Labelled>, Vec<&Labelled>) =
                all.iter().partition(|h| folds[&h.recording] == fold);
            answers(&learn(&kept, seed), &held)
        })
        .collect();
    parts.concat()
}

/// The network as Rust source for core/src/gesture/shape_table.rs.
#[must_use]
pub fn table(network: &Network) -> String {
    let rows = |rows: &mut dyn Iterator<Item = &[f32]>| {
        rows.fold(String::new(), |mut text, row| {
            let numbers: Vec<String> = row.iter().map(|w| format!("{w:.4}")).collect();
            let _ = writeln!(text, "        [{}],", numbers.join(", "));
            text
        })
    };
    format!(
        "//! Weights of the network that tells shapes apart, written by `deictic-eval gestures train`.\n\n\
         use super::shape::Network;\n\n\
         /// Trained on recordings of the authors' toolbox (imitrob teleop_gesture_toolbox, Apache-2.0) and on\n\
         /// hands of made-up people.\n\
         #[rustfmt::skip]\n\
         pub static NETWORK: Network = Network {{\n    hidden: [\n{}    ],\n    output: [\n{}    ],\n}};\n",
        rows(&mut network.hidden.iter().map(|row| row.as_slice())),
        rows(&mut network.output.iter().map(|row| row.as_slice())),
    )
}
