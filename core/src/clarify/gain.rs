//! What a question is expected to tell, and which one is put.
//!
//! The gain of a question is the mutual information of its answer and the intent, in nats: by how much
//! the answer is expected to lower the entropy of the intent. An answer depends on the intent through
//! one option only, or through whether it is the intent that was asked about, so that
//!
//! ```text
//! gain = H(answer) - sum over options of p(option) H(answer | option)
//! ```
//!
//! needs marginals only. A person's word is heard right with the probability that
//! [`super::calibration::RELIABILITY`] has for the noise that was heard, and as any other option alike
//! otherwise. What is asked is the question of the largest gain per cost.

use super::calibration::RELIABILITY;
use crate::joint::belief::shares;
use crate::math::{self, larger};

/// What a yes or a no costs the person: a word ...
pub const CONFIRM: f32 = 1.0;
/// ... and a name, which one has to think of or to pick from a list.
///
/// Everything once more would cost six words, tells less than either about what is in doubt
/// (`deictic-eval clarify`), and is asked for when nothing was understood only.
pub const WHICH: f32 = 1.25;

/// An option less probable than this is not taken for the answer.
const LIKELY: f32 = 0.03;

/// The probability that a word of `options` options is heard right at a noise of 0..=3
/// ([`crate::joint::belief::Belief::noise`]).
#[must_use]
pub fn reliability(options: usize, noise: f32) -> f32 {
    let last = RELIABILITY.last();
    let Some(row) = RELIABILITY.get(options.saturating_sub(2)).or(last) else {
        return 0.0;
    };
    let mut mean = 0.0;
    for (share, p) in shares(noise).into_iter().zip(row) {
        mean += share * f32::from(*p) * (1.0 / 1000.0);
    }
    mean
}

/// The gain of a yes or a no to an intent of this probability.
#[must_use]
pub fn confirm(p: f32, noise: f32) -> f32 {
    let p = math::clamp_unit(p);
    let right = reliability(2, noise);
    let yes = p * right + (1.0 - p) * (1.0 - right);
    let of_one = surprise(right) + surprise(1.0 - right);
    larger(surprise(yes) + surprise(1.0 - yes) - of_one, 0.0)
}

/// The gain of naming an option of these probabilities; what they lack of 1 is no option at all. Only
/// options above `LIKELY` count as what could be mistaken for each other: an answer that sounds like
/// an improbable one is not believed.
#[must_use]
#[inline(never)]
pub fn which(marginal: &[f32], noise: f32) -> f32 {
    let (mut likely, mut all) = (0_u8, 0.0);
    for p in marginal.iter().filter(|p| **p > LIKELY) {
        likely = likely.saturating_add(1);
        all += p;
    }
    if likely == 0 || marginal.len() < 2 {
        return 0.0;
    }
    // Of one likely option the answer tells whether it is that one.
    let rest = larger(1.0 - all, 0.0);
    let n = f32::from(likely.max(2));
    let right = reliability(usize::from(likely.max(2)), noise);
    let wrong = (1.0 - right) / (n - 1.0);
    let mut entropy = 0.0;
    let mut spread = 0.0;
    let shared = if likely == 1 { 0.0 } else { rest / n };
    for p in marginal.iter().filter(|p| **p > LIKELY) {
        let heard = shared + p * right + (all - p) * wrong;
        let heard = if likely == 1 {
            heard + rest * wrong
        } else {
            heard
        };
        entropy += surprise(heard);
        spread += heard;
    }
    if likely == 1 {
        entropy += surprise(1.0 - spread);
        return larger(entropy - surprise(right) - surprise(wrong), 0.0);
    }
    let of_one = surprise(right) + (n - 1.0) * surprise(wrong);
    larger(entropy - all * of_one - rest * math::ln(n), 0.0)
}

/// -p ln p.
fn surprise(p: f32) -> f32 {
    if p > 1e-9 { -p * math::ln(p) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_certain_teaches_nothing() {
        for noise in [0.0, 1.0, 2.5, 3.0] {
            assert!(confirm(1.0, noise) < 1e-5);
            assert!(confirm(0.0, noise) < 1e-5);
            assert!(which(&[0.0, 1.0, 0.0], noise) < 1e-5);
        }
        assert_eq!(which(&[1.0], 0.0), 0.0);
        assert_eq!(which(&[], 0.0), 0.0);
    }

    #[test]
    fn an_even_chance_teaches_most_and_noise_takes_it() {
        assert!(confirm(0.5, 0.0) > confirm(0.8, 0.0));
        assert!(confirm(0.5, 0.0) > confirm(0.5, 3.0));
        assert!(confirm(0.5, 0.0) > 0.6 && confirm(0.5, 0.0) <= 0.6932);
        assert!(which(&[0.25; 4], 0.0) > which(&[0.5, 0.5, 0.0, 0.0], 0.0));
    }
}
