//! Merging the words of all modalities that speak of the same thing (the paper, Merging algorithm,
//! eq. 3 and 4; METHOD, section 2).

use serde::{Deserialize, Serialize};

use crate::entropy;
use crate::math::{larger, smaller};

/// What a product is held below: so far from the end of the floats that a word of such likelihoods can still be summed,
/// and so far above what any two modalities give that only certainty in three or more of them gets there.
const LARGEST: f32 = 1e30;

/// The mixing operator of eq. 3, applied option by option.
pub trait Mix {
    /// The merged likelihood so far and that of one more modality, mixed.
    fn mix(&self, merged: f32, word: f32) -> f32;

    /// The same for all options of a word that is weighted with `weight`.
    fn mix_in(&self, merged: &mut [f32], word: &[f32], weight: f32) {
        for (m, w) in merged.iter_mut().zip(word) {
            *m = self.mix(*m, weight * w);
        }
    }
}

/// The paper's three mixing operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Merge {
    /// The larger of the two: the Baseline's.
    Max,
    /// Their product.
    Mul,
    /// Their sum: the most robust against noise.
    Add,
}

impl Mix for Merge {
    fn mix(&self, merged: f32, word: f32) -> f32 {
        match self {
            Self::Max => larger(merged, word),
            Self::Mul => smaller(merged * word, LARGEST),
            Self::Add => merged + word,
        }
    }

    #[inline(never)]
    fn mix_in(&self, merged: &mut [f32], word: &[f32], weight: f32) {
        let each = merged.iter_mut().zip(word);
        match self {
            Self::Max => each.for_each(|(m, w)| *m = larger(*m, weight * w)),
            Self::Mul => each.for_each(|(m, w)| *m = smaller(*m * (weight * w), LARGEST)),
            Self::Add => each.for_each(|(m, w)| *m += weight * w),
        }
    }
}

/// Weighs the first word of a merged one; most weights are 1 and change nothing.
#[inline(never)]
pub(crate) fn weigh(word: &mut [f32], weight: f32) {
    if weight != 1.0 {
        word.iter_mut().for_each(|w| *w *= weight);
    }
}

/// Divides every likelihood by its diagonal cross-entropy, so that what stands out counts for more
/// (eq. 4), into `penalised`. `h` is scratch with one place per option and keeps the cross-entropy;
/// it is held at or above `least_h` so that a certain option stays finite.
#[inline(never)]
pub fn penalise(word: &[f32], h: &mut [f32], least_h: f32, penalised: &mut [f32]) {
    entropy::with_cross_entropy(word, h, penalised, |penalised, w, h| {
        *penalised = w / larger(h, least_h);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operators_do_as_they_are_called() {
        assert_eq!(Merge::Max.mix(0.2, 0.5), 0.5);
        assert_eq!(Merge::Mul.mix(0.5, 0.5), 0.25);
        assert_eq!(Merge::Add.mix(0.2, 0.5), 0.7);
    }

    #[test]
    fn whole_words_are_mixed_as_their_options_are() {
        for merge in [Merge::Max, Merge::Mul, Merge::Add] {
            let mut merged = [0.25, 0.5];
            merge.mix_in(&mut merged, &[1.0, 0.5], 0.5);
            assert_eq!(merged, [merge.mix(0.25, 0.5), merge.mix(0.5, 0.25)]);
        }
    }

    #[test]
    fn certainty_in_every_modality_stays_finite() {
        let mut merged = [1e14, 1e-14];
        for _ in 0..3 {
            Merge::Mul.mix_in(&mut merged, &[1e14, 1e-14], 1000.0);
        }
        entropy::normalise(&mut merged);
        assert_eq!(merged, [1.0, 0.0]);
    }

    #[test]
    fn penalisation_sharpens_and_stays_finite() {
        let mut h = [0.0; 2];
        let mut word = [0.0; 2];
        penalise(&[0.6, 0.3], &mut h, 0.01, &mut word);
        assert!(word[0] / word[1] > 2.0);
        penalise(&[1.0, 0.0], &mut h, 0.01, &mut word);
        assert_eq!(word[0], 100.0);
        assert!(word[1] < 1e-10);
    }
}
