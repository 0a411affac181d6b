//! Merging the words of all modalities that speak of the same thing (the paper, Merging algorithm,
//! eq. 3 and 4; METHOD, section 2).

use serde::{Deserialize, Serialize};

use crate::entropy;

/// The mixing operator of eq. 3, applied option by option.
pub trait Mix {
    /// The merged likelihood so far and that of one more modality, mixed.
    fn mix(&self, merged: f32, word: f32) -> f32;
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
            Self::Max => merged.max(word),
            Self::Mul => merged * word,
            Self::Add => merged + word,
        }
    }
}

/// Divides every likelihood by its diagonal cross-entropy, so that what stands out counts for more
/// (eq. 4). `h` is scratch with one place per option and keeps the cross-entropy; it is held at or
/// above `least_h` so that a certain option stays finite.
pub fn penalise(word: &mut [f32], h: &mut [f32], least_h: f32) {
    entropy::diagonal_cross_entropy(word, h);
    for (w, h) in word.iter_mut().zip(h) {
        *w = (*w + entropy::EPSILON) / h.max(least_h);
    }
}

/// Mixes one more weighted word into `merged`; the `first` one is copied.
pub fn mix_in(merged: &mut [f32], word: &[f32], weight: f32, first: bool, mix: &impl Mix) {
    for (m, w) in merged.iter_mut().zip(word) {
        let w = weight * w;
        *m = if first { w } else { mix.mix(*m, w) };
    }
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
    fn the_first_word_alone_is_itself_weighted() {
        let mut merged = [9.0; 2];
        mix_in(&mut merged, &[0.5, 1.0], 0.5, true, &Merge::Mul);
        assert_eq!(merged, [0.25, 0.5]);
        mix_in(&mut merged, &[1.0, 0.5], 1.0, false, &Merge::Add);
        assert_eq!(merged, [1.25, 1.0]);
    }

    #[test]
    fn penalisation_sharpens_and_stays_finite() {
        let mut word = [0.6, 0.3];
        let mut h = [0.0; 2];
        penalise(&mut word, &mut h, 0.01);
        assert!(word[0] / word[1] > 2.0);
        let mut word = [1.0, 0.0];
        penalise(&mut word, &mut h, 0.01);
        assert_eq!(word[0], 100.0);
        assert!(word[1] < 1e-10);
    }
}
