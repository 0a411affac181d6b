//! Made-up sensors: what a recogniser of given similarity tables and noise says when an option was
//! really shown or said (the paper, Experiments: simulated data; noise levels of METHOD section 7).

use deictic_core::category::Category;
use deictic_core::large::{Sentence, Word};
use deictic_core::math::argmax;
use deictic_core::sentence::SentenceError;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1, StandardNormal, StandardUniform};

use crate::vocabulary::Lexicon;

/// How noisy a made-up sensor is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Noise {
    /// None: the rows of the similarity tables as they are.
    N0,
    /// As measured on people: a random sign, and in equal parts Exp(0.0058) and an exponentially
    /// modified normal distribution around 0.15.
    N1,
    /// Normal with standard deviation 0.2.
    N2,
    /// Normal with standard deviation 0.4.
    N3,
    /// Normal with standard deviation 0.6.
    N4,
}

impl Noise {
    /// One number to be added to a likelihood.
    pub fn draw(self, rng: &mut impl Rng) -> f64 {
        let normal = |rng: &mut _, sigma: f64| {
            let z: f64 = StandardNormal.sample(rng);
            sigma * z
        };
        match self {
            Self::N0 => 0.0,
            Self::N1 => {
                let coin = |rng: &mut _| {
                    let x: f64 = StandardUniform.sample(rng);
                    x < 0.5
                };
                let sign = if coin(rng) { 1.0 } else { -1.0 };
                let decay: f64 = Exp1.sample(rng);
                let size = if coin(rng) {
                    0.005_828 * decay
                } else {
                    let z: f64 = StandardNormal.sample(rng);
                    0.150_73 + 0.057_63 * (z + 1.7685 * decay)
                };
                sign * size
            }
            Self::N2 => normal(rng, 0.2),
            Self::N3 => normal(rng, 0.4),
            Self::N4 => normal(rng, 0.6),
        }
    }
}

/// A pair of made-up sensors, one per modality, that say the same again under the same seed.
#[derive(Clone, Debug)]
pub struct Sensors<'a> {
    lexicon: &'a Lexicon,
    noise: Noise,
    rng: ChaCha8Rng,
}

impl<'a> Sensors<'a> {
    /// Sensors as noisy as this.
    #[must_use]
    pub fn new(lexicon: &'a Lexicon, noise: Noise, seed: u64) -> Self {
        Self {
            lexicon,
            noise,
            rng: ChaCha8Rng::seed_from_u64(seed),
        }
    }

    /// What the sensor of `modality` says when `option` of `category` was meant: the option's row
    /// of the similarity table, noise added to every element, clipped to 0..=1.
    ///
    /// # Errors
    /// [`SentenceError`] when the category is larger than the core holds, which no lexicon's is.
    pub fn word(
        &mut self,
        modality: u8,
        category: Category,
        option: u8,
    ) -> Result<Word, SentenceError> {
        let options = self.lexicon.entries(category).len();
        let mut row = self
            .lexicon
            .similarity()
            .row(modality, category, option, options);
        for likelihood in &mut row {
            let noisy = f64::from(*likelihood) + self.noise.draw(&mut self.rng);
            *likelihood = noisy.clamp(0.0, 1.0) as f32;
        }
        Word::certain(category, &row)
    }

    /// The sentence a sensor of the same modality makes of what was meant by this one: of every
    /// word its likeliest option, observed anew. Absent words stay absent, quantities are kept.
    ///
    /// # Errors
    /// As [`Sensors::word`].
    pub fn observe(&mut self, meant: &Sentence) -> Result<Sentence, SentenceError> {
        let modality = meant.modality();
        let mut observed = Sentence::new(modality);
        for word in meant.words() {
            let option = argmax(word.likelihoods()).and_then(|i| u8::try_from(i).ok());
            let seen = match (word.category().filter(|_| word.is_present()), option) {
                (Some(category), Some(option)) => {
                    let seen = self.word(modality, category, option)?;
                    match word.quantity() {
                        Some(quantity) => seen.with_quantity(quantity),
                        None => seen,
                    }
                }
                _ => word.clone(),
            };
            observed.push(seen)?;
        }
        Ok(observed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use deictic_core::sentence::GESTURE;

    fn spread(noise: Noise) -> (f64, f64) {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let n = 20_000;
        let drawn: Vec<f64> = (0..n).map(|_| noise.draw(&mut rng)).collect();
        let mean = drawn.iter().sum::<f64>() / f64::from(n);
        let square = drawn.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / f64::from(n);
        (mean, square)
    }

    #[test]
    fn noise_has_the_variance_of_its_level() {
        // Of n1: E[X^2] = (2 * 0.005828^2 + 0.05763^2 (1 + K^2) + (0.15073 + 0.05763 K)^2) / 2.
        let k = 1.7685;
        let modified: f64 = 0.05763 * 0.05763 * (1.0 + k * k);
        let shifted: f64 = 0.15073 + 0.05763 * k;
        let n1 = (2.0 * 0.005_828 * 0.005_828 + modified + shifted * shifted) / 2.0;
        let levels = [
            (Noise::N0, 0.0),
            (Noise::N1, n1),
            (Noise::N2, 0.04),
            (Noise::N3, 0.16),
            (Noise::N4, 0.36),
        ];
        for (noise, variance) in levels {
            let (mean, found) = spread(noise);
            assert!(mean.abs() < 0.02, "{noise:?} {mean}");
            assert!(
                (found - variance).abs() <= 0.05 * variance,
                "{noise:?} {found}"
            );
        }
    }

    #[test]
    fn the_same_seed_observes_the_same_and_noise_none_the_tables() {
        let lexicon = Lexicon::tabletop().unwrap();
        let mut meant = Sentence::new(GESTURE);
        meant
            .push(Word::certain(Category::OBJECT, &[0.0, 1.0, 0.0, 0.0, 0.0]).unwrap())
            .unwrap();
        meant.push(Word::ABSENT).unwrap();
        let observe = |noise, seed| Sensors::new(&lexicon, noise, seed).observe(&meant).unwrap();
        assert_eq!(observe(Noise::N3, 7), observe(Noise::N3, 7));
        assert_ne!(observe(Noise::N3, 7), observe(Noise::N3, 8));
        let exact = observe(Noise::N0, 7);
        assert_eq!(exact.words()[0].likelihoods(), [0.2, 1.0, 0.2, 0.2, 0.2]);
        assert!(!exact.words()[1].is_present());
    }
}
