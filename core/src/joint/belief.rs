//! How far a posterior can be trusted: a confidence that means what it says, and the cut that keeps
//! wrong executions rare.
//!
//! The confidence is the logits of the posterior and of its action's marginal, scaled and shifted by
//! the noise that was heard and by how many kinds of words there were (Platt's scaling, linear
//! between the levels): doubt about the action means another thing than as much doubt about the
//! object, and one word tells less of the noise than three. It is never told the noise.
//! `calibration` holds the figures: fitted to generated samples, the cut by learn-then-test
//! (Angelopoulos et al. 2021), whose program and assumptions are in `deictic-eval calibrate`.

use super::calibration::{ACTION, CUTS, OFFSET, RISKS, SLOPE};
use super::{KINDS, LEVELS, Levels};
use crate::clarify::calibration::{EARLY, LAST};
use crate::math::{self, clamp_unit, larger};

/// No logit counts beyond this: what a posterior of 0.99988 has, and about what thousands of
/// samples can tell.
const FARTHEST: f32 = 9.0;

/// Which of its looks at a command a decision is. Each is a chance to be wrong, and a command counts as
/// wrong when one of them is, so that their cuts go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// The only one: no question can be asked.
    Only,
    /// More can follow.
    Early,
    /// The last of several.
    Last,
}

impl Look {
    /// The look after which `left` of `questions` can still be asked.
    #[must_use]
    pub fn of(questions: u8, left: u8) -> Self {
        match (questions, left) {
            (0, _) => Self::Only,
            (_, 0) => Self::Last,
            _ => Self::Early,
        }
    }
}

/// What the joint model believes of its best intent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Belief {
    /// The best intent's posterior, 0..=1.
    pub posterior: f32,
    /// The posterior of its action, whatever its parameters, 0..=1.
    pub action: f32,
    /// How many of actions, objects and storages were spoken of; 0 counts as 1.
    pub kinds: u8,
    /// The noise that was heard, as the mean level of all branches: 0 (as measured on real gestures)
    /// to 3 (standard deviation 0.6).
    pub noise: f32,
}

impl Belief {
    /// Nothing believed.
    pub const NONE: Self = Self {
        posterior: 0.0,
        action: 0.0,
        kinds: 0,
        noise: 0.0,
    };

    /// Logit of the confidence.
    #[must_use]
    pub fn logit(&self) -> f32 {
        let at = |tables: &[Levels; KINDS]| {
            let knots = tables.get(self.kind());
            knots.map_or(0.0, |knots| between(knots, self.noise))
        };
        at(&SLOPE) * logit(self.posterior) + at(&ACTION) * logit(self.action) + at(&OFFSET)
    }

    /// Which of the [`KINDS`] it is.
    #[must_use]
    pub fn kind(&self) -> usize {
        usize::from(self.kinds)
            .saturating_sub(1)
            .min(KINDS.saturating_sub(1))
    }

    /// The probability that the best intent is what was meant, on the samples it was fitted to.
    #[must_use]
    pub fn confidence(&self) -> f32 {
        1.0 / (1.0 + math::exp(-self.logit()))
    }

    /// The logit from which on the intent is executed when this share of all commands may be executed
    /// wrongly: that of the largest risk in [`RISKS`] that is no larger, out of reach when there is
    /// none.
    #[must_use]
    pub fn cut(&self, risk: f32, look: Look) -> f32 {
        let cuts = match look {
            Look::Only => &CUTS,
            Look::Early => &EARLY,
            Look::Last => &LAST,
        };
        let mut cut = f32::INFINITY;
        for (known, knots) in RISKS.iter().zip(cuts) {
            if *known <= risk {
                cut = between(knots, self.noise);
            }
        }
        cut
    }

    /// Whether the confidence suffices for a risk.
    #[must_use]
    pub fn suffices(&self, risk: f32, look: Look) -> bool {
        self.logit() >= self.cut(risk, look)
    }
}

/// ln(p / (1 - p)), at most 9 from 0.
#[must_use]
pub fn logit(p: f32) -> f32 {
    let p = clamp_unit(p);
    let odds = larger(p, 1e-9) / larger(1.0 - p, 1e-9);
    math::ln(odds).clamp(-FARTHEST, FARTHEST)
}

/// The level below a noise, the last but one at most, and how far above it the noise is, 0..=1.
fn place(noise: f32) -> (usize, f32) {
    let last = LEVELS.saturating_sub(2);
    let level = (noise as usize).min(last);
    (level, clamp_unit(noise - level as f32))
}

/// How much each level's figure counts at a noise between them: 1 in all.
#[must_use]
pub fn shares(noise: f32) -> Levels {
    let (level, above) = place(noise);
    let mut shares = [0.0; LEVELS];
    for (share, part) in shares.iter_mut().skip(level).zip([1.0 - above, above]) {
        *share = part;
    }
    shares
}

fn between(knots: &Levels, noise: f32) -> f32 {
    let (level, above) = place(noise);
    let at = |level: usize| knots.get(level).copied().unwrap_or(0.0);
    let low = at(level);
    low + above * (at(level.saturating_add(1)) - low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_linear_between_the_levels() {
        assert_eq!(shares(0.0), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(shares(2.25), [0.0, 0.0, 0.75, 0.25]);
        assert_eq!(shares(3.0), [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(between(&[1.0, 2.0, 4.0, 8.0], 1.5), 3.0);
    }

    #[test]
    fn logits_are_bounded_and_total() {
        assert_eq!(logit(1.0), 9.0);
        assert_eq!(logit(0.0), -9.0);
        assert_eq!(logit(0.5), 0.0);
        assert_eq!(logit(f32::NAN), -9.0);
    }

    #[test]
    fn more_posterior_is_more_confidence() {
        for noise in [0.0, 0.7, 1.0, 2.5, 3.0] {
            for kinds in 0..5 {
                let of = |posterior| {
                    let belief = Belief {
                        posterior,
                        action: posterior,
                        kinds,
                        noise,
                    };
                    belief.confidence()
                };
                let [low, middle, high] = [0.3, 0.6, 0.99].map(of);
                assert!(low < middle && middle < high, "noise {noise}, {kinds}");
            }
        }
    }
}
