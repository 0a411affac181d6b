//! The posterior over whole intents. At every noise level it is a product of one factor per
//! category,
//!
//! ```text
//! p(a, o, s) = sum over levels of  w(a) fit(a, o) w(o) fit(a, s) w(s) / total
//! ```
//!
//! where a category that the action does not take counts with the mean of its options: whatever
//! such a word names, it names nothing of the intent. Levels and actions that are 2^11 times less likely
//! than the best are left out.

use super::belief::Belief;
use super::cost::{Costs, MOST, weight};
use super::level::{Level, Weighed};
use super::survey::Fits;
use super::{LEVELS, Levels};
use crate::math;

/// What a level may cost beside the best before it is left out, and an action beside the best.
pub(super) const NEGLIGIBLE: u32 = 352;

/// One category's options.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// Those that are weighed.
    pub live: &'a [u8],
    /// What each costs.
    pub costs: &'a [Costs],
    /// One over their number, 1 when there are none.
    pub per_count: f32,
}

impl<'a> Options<'a> {
    /// Those of `live`.
    #[must_use]
    pub fn new(live: &'a [u8], costs: &'a [Costs]) -> Self {
        let per_count = 1.0 / live.len().max(1) as f32;
        Self {
            live,
            costs,
            per_count,
        }
    }

    /// The least costs of the live options, 0 when there are none.
    #[must_use]
    pub fn least(&self) -> Costs {
        let mut least = Costs::all(if self.live.is_empty() { 0 } else { MOST });
        for &o in self.live {
            if let Some(costs) = self.costs.get(usize::from(o)) {
                least = least.least(*costs);
            }
        }
        least
    }
}

/// All that the posterior is made of.
pub struct Posterior<'a> {
    /// What the actions cost, their words' presence included.
    pub deeds: Options<'a>,
    /// Objects, then storages.
    pub things: [Options<'a>; 2],
    /// How well options fit.
    pub fits: Fits<'a>,
    /// What the other categories' best options cost at every level.
    pub rest: [u32; LEVELS],
}

/// What a category's marginal posterior is written to, and room to work.
pub struct Marginal<'a> {
    /// The probability of every option.
    pub of: &'a mut [f32],
    /// Their weights at the level at hand.
    pub weights: &'a mut [f32],
}

/// An action with its object and storage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triple {
    /// The action's option.
    pub action: u8,
    /// The object's and the storage's.
    pub things: [Option<u8>; 2],
}

/// What the posterior is largest for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// The best intent.
    pub best: Triple,
    /// How much of the posterior it holds, and at which noise.
    pub belief: Belief,
    /// How much every level holds.
    pub shares: Levels,
    /// The level that holds most.
    pub level: usize,
}

impl Posterior<'_> {
    /// The best intent; the marginals of actions, objects and storages are filled in. Of `room`
    /// there must be as much as there are rows. `None` when nothing can be done.
    #[inline(never)]
    pub fn solve(&self, room: &mut [Weighed], marginals: &mut [Marginal<'_>; 3]) -> Option<Found> {
        for marginal in marginals.iter_mut() {
            marginal.of.iter_mut().for_each(|p| *p = 0.0);
        }
        if self.deeds.live.is_empty() {
            return None;
        }
        let [objects, storages] = &self.things;
        let least = [&self.deeds, objects, storages].map(Options::least);
        let mut base = self.rest;
        for least in least {
            for (base, least) in base.iter_mut().zip(least.lanes()) {
                *base = base.saturating_add(u32::from(least));
            }
        }
        let best = base.iter().copied().min()?;
        let mut levels = [Level::default(); LEVELS];
        let mut total = 0.0;
        for (b, (level, base)) in levels.iter_mut().zip(base).enumerate() {
            let above = base.saturating_sub(best);
            if above <= NEGLIGIBLE {
                level.scale = weight(above);
                self.weigh(b, &least, level, room, marginals);
                total += level.share;
            }
        }
        // Not above 0 either when it is not a number.
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        let per_total = 1.0 / total;
        let (mut noise, mut knot, mut most) = (0.0, 0.0, (0.0, 0));
        for (b, level) in levels.iter().enumerate() {
            noise += level.share * per_total * knot;
            knot += 1.0;
            if level.share > most.0 {
                most = (level.share, b);
            }
        }
        for marginal in marginals.iter_mut() {
            marginal.of.iter_mut().for_each(|p| *p *= per_total);
        }
        let (best, share) = self.best(&levels, &least)?;
        Some(Found {
            best,
            belief: Belief {
                posterior: math::clamp_unit(share * per_total),
                noise,
            },
            shares: levels.map(|level| level.share * per_total),
            level: most.1,
        })
    }

    /// The best of the levels' best intents, and what it holds at all levels.
    fn best(&self, levels: &[Level; LEVELS], least: &[Costs; 3]) -> Option<(Triple, f32)> {
        let mut largest = None;
        let mut share = 0.0;
        for candidate in levels.iter().filter_map(|level| level.best) {
            if largest == Some(candidate) {
                continue;
            }
            let mut sum = 0.0;
            for (b, level) in levels.iter().enumerate() {
                if level.best == Some(candidate) {
                    sum += level.peak;
                } else if level.scale > 0.0 {
                    sum += self.share(b, level, least, candidate);
                }
            }
            if sum > share {
                (largest, share) = (Some(candidate), sum);
            }
        }
        Some((largest?, share))
    }
}
