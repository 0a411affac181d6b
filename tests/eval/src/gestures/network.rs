//! Training of the network that tells shapes apart.

use deictic_core::gesture::shape::{FEATURES, HIDDEN, Network, SHAPES};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

/// One example: features, shape, weight.
#[derive(Clone, Copy, Debug)]
pub struct Example {
    /// What the hand looks like.
    pub features: [f64; FEATURES],
    /// The index of what it shows.
    pub shape: usize,
    /// How much it counts.
    pub weight: f64,
}

/// How to train.
#[derive(Clone, Copy, Debug)]
pub struct Recipe {
    /// How often all examples are seen.
    pub epochs: usize,
    /// Examples per step.
    pub batch: usize,
    /// The first step's size; it falls linearly to a twentieth.
    pub rate: f64,
    /// Pull of all weights towards 0.
    pub decay: f64,
    /// Standard deviation of what is added to every feature each time it is seen.
    pub noise: f64,
    /// Of the random numbers.
    pub seed: u64,
}

impl Default for Recipe {
    fn default() -> Self {
        Self {
            epochs: 60,
            batch: 128,
            rate: 4e-3,
            decay: 2e-3,
            noise: 0.03,
            seed: 2,
        }
    }
}

const WIDE: usize = FEATURES + 1;
const TALL: usize = HIDDEN + 1;
const WEIGHTS: usize = HIDDEN * WIDE + SHAPES * TALL;

/// All weights in a row: the hidden units' rows, then the shapes'.
struct Weights(Box<[f64; WEIGHTS]>);

/// Trains a network: Adam (Kingma and Ba 2015) on the weighted cross-entropy.
#[must_use]
pub fn train(examples: &[Example], recipe: &Recipe) -> Network {
    let mut rng = ChaCha8Rng::seed_from_u64(recipe.seed);
    let mut weights = Weights::random(&mut rng);
    let [mut mean, mut square] = [(); 2].map(|()| Box::new([0.0; WEIGHTS]));
    let mut order: Vec<usize> = (0..examples.len()).collect();
    let steps = recipe.epochs * examples.len().div_ceil(recipe.batch);
    let mut step = 0;
    for _ in 0..recipe.epochs {
        order.shuffle(&mut rng);
        for batch in order.chunks(recipe.batch) {
            let mut slope = Box::new([0.0; WEIGHTS]);
            let mut total = 0.0;
            for &at in batch {
                let mut example = examples[at];
                for x in &mut example.features {
                    *x += recipe.noise * gauss(&mut rng);
                }
                weights.slope(&example, &mut slope);
                total += example.weight;
            }
            step += 1;
            let rate = recipe.rate * (1.0 - 0.95 * f64::from(step) / steps as f64);
            let (fade, fade2) = (1.0 - 0.9_f64.powi(step), 1.0 - 0.999_f64.powi(step));
            for i in 0..WEIGHTS {
                let g = slope[i] / total;
                mean[i] += 0.1 * (g - mean[i]);
                square[i] += 0.001 * (g * g - square[i]);
                let w = &mut weights.0[i];
                *w -= rate * (mean[i] / fade / ((square[i] / fade2).sqrt() + 1e-8));
                *w -= rate * recipe.decay * *w;
            }
        }
    }
    weights.network()
}

fn gauss(rng: &mut ChaCha8Rng) -> f64 {
    Normal::new(0.0, 1.0).map_or(0.0, |n| n.sample(rng))
}

impl Weights {
    fn random(rng: &mut ChaCha8Rng) -> Self {
        let mut weights = Box::new([0.0; WEIGHTS]);
        for w in weights.iter_mut() {
            *w = rng.random_range(-0.4..0.4);
        }
        Self(weights)
    }

    /// Adds the slope of the example's loss.
    fn slope(&self, example: &Example, slope: &mut [f64; WEIGHTS]) {
        let (hidden_rows, output_rows) = self.0.split_at(HIDDEN * WIDE);
        let mut sums = [0.0; HIDDEN];
        let mut hidden = [1.0; TALL];
        for (i, row) in hidden_rows.chunks_exact(WIDE).enumerate() {
            sums[i] = row[FEATURES] + dot(row, &example.features);
            hidden[i] = sums[i] / (1.0 + sums[i].abs());
        }
        let mut scores = [0.0; SHAPES];
        for (score, row) in scores.iter_mut().zip(output_rows.chunks_exact(TALL)) {
            *score = dot(row, &hidden);
        }
        let top = scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let powers = scores.map(|s| (s - top).exp());
        let sum: f64 = powers.iter().sum();
        let (hidden_slope, output_slope) = slope.split_at_mut(HIDDEN * WIDE);
        let mut back = [0.0; HIDDEN];
        for (k, power) in powers.iter().enumerate() {
            let target = f64::from(u8::from(k == example.shape));
            let off = (power / sum - target) * example.weight;
            for j in 0..TALL {
                output_slope[k * TALL + j] += off * hidden[j];
            }
            for (j, b) in back.iter_mut().enumerate() {
                *b += off * output_rows[k * TALL + j];
            }
        }
        for (j, b) in back.iter().enumerate() {
            let off = b / (1.0 + sums[j].abs()).powi(2);
            let row = &mut hidden_slope[j * WIDE..(j + 1) * WIDE];
            for (s, x) in row.iter_mut().zip(&example.features) {
                *s += off * x;
            }
            row[FEATURES] += off;
        }
    }

    fn network(&self) -> Network {
        let (hidden, output) = self.0.split_at(HIDDEN * WIDE);
        Network {
            hidden: std::array::from_fn(|i| std::array::from_fn(|j| hidden[i * WIDE + j] as f32)),
            output: std::array::from_fn(|i| std::array::from_fn(|j| output[i * TALL + j] as f32)),
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The network with all its scores over `temperature`: above 1 less sure, below 1 surer.
#[must_use]
pub fn tempered(mut network: Network, temperature: f64) -> Network {
    for w in network.output.as_flattened_mut() {
        *w /= temperature as f32;
    }
    network
}
