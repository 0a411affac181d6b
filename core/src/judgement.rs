//! Which options of a word are clear, unclear or noise (the paper, Decision over the actions for
//! interaction mode; METHOD, section 4).
//!
//! The paper prints the entropy rule with the inequality the other way round; with h a
//! dissimilarity that would execute noise, and its implementation does as is done here.

use crate::profile::Threshold;

/// Below this a relative likelihood that is not clear is noise: the paper's t_n.
pub const NOISE: f32 = 0.05;

/// What was made of one merged word. Options are bits, so there can be 64 of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// The largest likelihood's option; `None` when the word is absent.
    pub best: Option<u8>,
    /// By how much it leads the next.
    pub lead: f32,
    /// Which options are clear.
    pub clear: u64,
    /// Which options are neither clear nor noise.
    pub unclear: u64,
}

impl Judgement {
    /// Of a word that says nothing.
    pub const NOTHING: Self = Self {
        best: None,
        lead: 0.0,
        clear: 0,
        unclear: 0,
    };

    /// Whether this option is clear.
    #[must_use]
    pub fn is_clear(&self, option: u8) -> bool {
        has(self.clear, option)
    }

    /// The option that can be acted upon: the best, when something is clear and it leads by more
    /// than `lead`.
    #[must_use]
    pub fn decided(&self, lead: f32) -> Option<u8> {
        self.best.filter(|_| self.clear != 0 && self.lead > lead)
    }
}

/// Whether `option` is in a set of options.
pub(crate) fn has(set: u64, option: u8) -> bool {
    option < 64 && set.wrapping_shr(u32::from(option)) & 1 != 0
}

/// The set of one option; empty for one that no set can have.
pub(crate) fn bit(option: u8) -> u64 {
    1_u64.checked_shl(u32::from(option)).unwrap_or(0)
}

/// Judges every option of a word by its likelihood `w`, its cross-entropy `h` and the `entropy` of
/// the whole; gives the threshold that was used beside the judgement.
#[must_use]
#[inline(never)]
pub fn judge(w: &[f32], h: &[f32], entropy: f32, threshold: Threshold) -> (Judgement, f32) {
    let limit = match threshold {
        // The joint model judges whole intents and does not come here with a risk.
        Threshold::None | Threshold::Risk { .. } => 0.0,
        Threshold::Entropy => entropy,
        Threshold::WhiteNoise => crate::entropy::white_noise(w.len()),
        Threshold::Fixed { clear, .. } => clear,
    };
    let judgement = match threshold {
        Threshold::None | Threshold::Risk { .. } => classify(w, h, |_, _| true, |_| false),
        // A single option has no entropy to compare with and is clear when it is there at all.
        _ if w.len() == 1 => classify(w, h, |_, _| true, |_| false),
        Threshold::Entropy | Threshold::WhiteNoise => {
            classify(w, h, |_, h| h < limit, |w| w <= NOISE)
        }
        Threshold::Fixed { clear, unclear } => classify(w, h, |w, _| w > clear, |w| w <= unclear),
    };
    (judgement, limit)
}

/// Judges every option by whether it is clear, given its likelihood and cross-entropy, and if not,
/// whether it is noise.
fn classify(
    w: &[f32],
    h: &[f32],
    clear: impl Fn(f32, f32) -> bool,
    noise: impl Fn(f32) -> bool,
) -> Judgement {
    let mut judgement = Judgement::NOTHING;
    let (mut first, mut second) = (f32::NEG_INFINITY, f32::NEG_INFINITY);
    let mut bit = 1_u64;
    for (i, (&w, &h)) in w.iter().zip(h).enumerate() {
        if clear(w, h) {
            judgement.clear |= bit;
        } else if !noise(w) {
            judgement.unclear |= bit;
        }
        bit = bit.wrapping_shl(1);
        if w > first {
            second = first;
            first = w;
            judgement.best = u8::try_from(i).ok();
        } else if w > second {
            second = w;
        }
    }
    judgement.lead = if second.is_finite() {
        first - second
    } else {
        1.0
    };
    judgement
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::entropy::{diagonal_cross_entropy, normalise};

    fn judged(w: &[f32], threshold: Threshold) -> Judgement {
        let mut p = w.to_vec();
        normalise(&mut p);
        let mut h = std::vec![0.0; w.len()];
        let entropy = diagonal_cross_entropy(&p, &mut h);
        judge(&p, &h, entropy, threshold).0
    }

    #[test]
    fn one_option_that_stands_out_is_clear_and_small_ones_are_noise() {
        let j = judged(&[0.04, 0.9, 0.2, 0.02], Threshold::Entropy);
        assert_eq!((j.best, j.clear, j.unclear), (Some(1), 0b0010, 0b0100));
        assert_eq!(j.decided(0.01), Some(1));
    }

    #[test]
    fn a_flat_word_has_nothing_clear() {
        let j = judged(&[0.5; 4], Threshold::WhiteNoise);
        assert_eq!((j.clear, j.unclear, j.lead), (0, 0b1111, 0.0));
        assert_eq!(j.decided(0.01), None);
    }

    #[test]
    fn fixed_thresholds_look_at_the_likelihood_itself() {
        let (j, t) = judge(&[0.3, 0.2, 0.1], &[0.0; 3], 1.0, Threshold::FIXED);
        assert_eq!((j.clear, j.unclear, t), (0b001, 0b010, 0.25));
    }

    #[test]
    fn a_single_option_is_clear() {
        for threshold in [Threshold::Entropy, Threshold::WhiteNoise, Threshold::FIXED] {
            let j = judged(&[0.02], threshold);
            assert_eq!((j.best, j.clear, j.lead), (Some(0), 1, 1.0));
        }
    }

    #[test]
    fn sixty_four_options_fit() {
        let mut w = [0.0; 64];
        w[63] = 1.0;
        let j = judged(&w, Threshold::Entropy);
        assert!(j.is_clear(63) && !j.is_clear(64) && j.best == Some(63));
    }
}
