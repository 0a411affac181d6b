//! Normalised entropy and diagonal cross-entropy (the paper, Theoretical background; METHOD,
//! section 1).
//!
//! For likelihoods `w` of `N` options, p = (w + e) / sum(w + e):
//! * H(p) = -sum p ln p / ln N, in 0..=1: 1 for a flat vector, near 0 for a certain one.
//! * h(j) = -ln p_j / ln N, the cross-entropy of the one-hot vector of option `j` relative to p:
//!   small when option `j` is near certain.
//!
//! Costs one logarithm per option and one more, about 60 instructions each on a Cortex-M4F.

use core::iter;

use crate::math::{self, larger};
use crate::tables::{INVERSE_LN, MEAN_ENTROPY};

/// What is added to every likelihood so that its logarithm is finite. With f64's machine epsilon,
/// as the reference uses it, an option of likelihood 0 has h = 16.4 among 9 options.
pub const EPSILON: f32 = 2.220_446e-16;

/// Fills `h` with the diagonal cross-entropy of `w` and returns its normalised entropy.
///
/// Both slices have one place per option. A vector of one option has no entropy: h = 1 and H = 1.
/// The empty vector gives 1.
#[inline(never)]
pub fn diagonal_cross_entropy(w: &[f32], h: &mut [f32]) -> f32 {
    if w.len() < 2 {
        h.iter_mut().for_each(|h| *h = 1.0);
        return 1.0;
    }
    let sum = sum(w);
    let per_sum = 1.0 / sum;
    let mut entropy = 0.0;
    for_each_h(w, h, sum, iter::repeat(()), |(), w, h| {
        entropy += w * per_sum * h;
    });
    entropy
}

/// The same `h`; on the way gives `each` a place of `to`, the likelihood with e added, and its
/// cross-entropy, which saves a second pass.
#[inline(always)]
pub(crate) fn with_cross_entropy(
    w: &[f32],
    h: &mut [f32],
    to: &mut [f32],
    mut each: impl FnMut(&mut f32, f32, f32),
) {
    if w.len() < 2 {
        for ((h, w), to) in h.iter_mut().zip(w).zip(to) {
            *h = 1.0;
            each(to, w + EPSILON, *h);
        }
    } else {
        for_each_h(w, h, sum(w), to.iter_mut(), each);
    }
}

#[inline(always)]
fn sum(w: &[f32]) -> f32 {
    w.iter().map(|w| w + EPSILON).sum()
}

/// Cross-entropies of two options and more.
#[inline(always)]
fn for_each_h<T>(
    w: &[f32],
    h: &mut [f32],
    sum: f32,
    to: impl Iterator<Item = T>,
    mut each: impl FnMut(T, f32, f32),
) {
    let ln_sum = math::ln(sum);
    let per_ln_n = match INVERSE_LN.get(w.len()) {
        Some(per_ln_n) => *per_ln_n,
        None => 1.0 / math::ln(w.len() as f32),
    };
    for ((h, w), to) in h.iter_mut().zip(w).zip(to) {
        let w = w + EPSILON;
        // Rounding can put ln(sum) a hair below ln(w) when one option has everything.
        *h = larger(0.0, (ln_sum - math::ln(w)) * per_ln_n);
        each(to, w, *h);
    }
}

/// The reciprocal of anything below is infinite: a product of four modalities that contradict each other gets there.
const TINY: f32 = 1e-37;

/// Scales `w` so that it sums to 1; leaves a vector of zeros as it is.
#[inline(never)]
pub fn normalise(w: &mut [f32]) {
    let sum: f32 = w.iter().sum();
    if sum >= TINY {
        let per_sum = 1.0 / sum;
        w.iter_mut().for_each(|w| *w *= per_sum);
    } else if sum > 0.0 {
        w.iter_mut().for_each(|w| *w /= sum);
    }
}

/// Mean normalised entropy of `n` independent numbers drawn from 0..1: the threshold that a vector
/// must beat to say more than white noise does (the paper, Entropy-based threshold).
///
/// 1 below two options; the value for 64 above 64, where the table ends (it grows by less than
/// 1e-3 per doubling there).
#[must_use]
pub fn white_noise(n: usize) -> f32 {
    let [.., last] = MEAN_ENTROPY;
    MEAN_ENTROPY.get(n).copied().unwrap_or(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_and_certain_vectors_are_the_extremes() {
        let mut h = [0.0; 4];
        let flat = diagonal_cross_entropy(&[0.3; 4], &mut h);
        assert!((flat - 1.0).abs() < 1e-6);
        assert!(h.iter().all(|h| (h - 1.0).abs() < 1e-6));
        let certain = diagonal_cross_entropy(&[0.0, 1.0, 0.0, 0.0], &mut h);
        assert!(certain < 1e-6 && h[1] < 1e-6 && h[0] > 20.0);
    }

    #[test]
    fn a_worked_example() {
        // p = (0.5, 0.25, 0.25): H = 1.5 / log2 3, h = (1, 2, 2) / log2 3.
        let mut h = [0.0; 3];
        let entropy = diagonal_cross_entropy(&[0.8, 0.4, 0.4], &mut h);
        let log2_3 = 3_f64.ln() / 2_f64.ln();
        assert!((f64::from(entropy) - 1.5 / log2_3).abs() < 1e-6);
        assert!((f64::from(h[0]) - 1.0 / log2_3).abs() < 1e-6);
        assert!((f64::from(h[2]) - 2.0 / log2_3).abs() < 1e-6);
    }

    #[test]
    fn one_option_has_no_entropy() {
        let mut h = [0.0];
        assert_eq!(diagonal_cross_entropy(&[0.4], &mut h), 1.0);
        assert_eq!(h, [1.0]);
        assert_eq!(white_noise(0), 1.0);
        assert_eq!(white_noise(1), 1.0);
        assert_eq!(white_noise(1000), white_noise(64));
    }

    #[test]
    fn normalise_leaves_zeros_alone() {
        let mut w = [0.0; 3];
        normalise(&mut w);
        assert_eq!(w, [0.0; 3]);
        let mut w = [0.5, 1.5];
        normalise(&mut w);
        assert_eq!(w, [0.25, 0.75]);
        let mut w = [f32::from_bits(1), f32::from_bits(3)];
        normalise(&mut w);
        assert_eq!(w, [0.25, 0.75]);
    }
}
