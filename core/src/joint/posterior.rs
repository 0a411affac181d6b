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

use super::cost::Costs;
use super::factors::{Factors, Marginal, NEGLIGIBLE, Options};
use super::level::{Level, Place, Weighed};
use super::weight::weight;
use super::{LEVELS, Levels};
use crate::math;

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
    /// How much of the posterior it holds, 0..=1.
    pub posterior: f32,
    /// The noise that was heard, as the mean level of all branches, 0..=3.
    pub noise: f32,
    /// How much every level holds.
    pub shares: Levels,
    /// The level that holds most.
    pub level: usize,
}

impl Factors<'_> {
    /// The best intent; the marginals of actions, objects and storages are filled in. Of `room`
    /// there must be as much as there are rows of each kind. `None` when nothing can be done.
    #[inline(never)]
    pub fn solve(
        &self,
        mut room: [&mut [Weighed]; 2],
        marginals: &mut [Marginal<'_>; 3],
    ) -> Option<Found> {
        for marginal in marginals.iter_mut() {
            marginal.of.iter_mut().for_each(|p| *p = 0.0);
        }
        if self.deeds.live.is_empty() {
            return None;
        }
        let [objects, storages] = &self.things;
        let least = [self.deeds.least(), objects.least(), storages.least()];
        let mut base = self.rest;
        for least in least {
            for (base, least) in base.iter_mut().zip(least.lanes()) {
                // No more than 31 categories of 2^16 together.
                *base = base.wrapping_add(u32::from(least));
            }
        }
        let best = base.iter().copied().min()?;
        let mut levels = [Level::default(); LEVELS];
        let mut total = 0.0;
        for (b, (level, base)) in levels.iter_mut().zip(base).enumerate() {
            let above = base.saturating_sub(best);
            if above <= NEGLIGIBLE {
                level.scale = weight(above);
                self.weigh(b, &least, level, &mut room, marginals);
                total += level.share;
            }
        }
        // Not above 0 either when it is not a number.
        if !(total > 0.0 && total < f32::INFINITY) {
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
        let live = [self.deeds.live, objects.live, storages.live];
        for (marginal, live) in marginals.iter_mut().zip(live) {
            expand(marginal.of, live, per_total);
        }
        let (best, share) = self.best(&levels, &least)?;
        Some(Found {
            best: self.triple(&best)?,
            posterior: math::clamp_unit(share * per_total),
            noise,
            shares: levels.each_ref().map(|level| level.share * per_total),
            level: most.1,
        })
    }

    /// The best of the levels' best intents, and what it holds at all levels.
    #[inline(never)]
    fn best(&self, levels: &[Level], least: &[Costs; 3]) -> Option<(Place, f32)> {
        let mut largest = None;
        let mut share = 0.0;
        for candidate in levels.iter().filter(|level| level.peak > 0.0) {
            let candidate = &candidate.best;
            if largest == Some(candidate) {
                continue;
            }
            let mut sum = 0.0;
            let known = levels
                .iter()
                .enumerate()
                .filter(|(_, level)| level.scale > 0.0);
            for (b, level) in known {
                sum += if level.peak > 0.0 && level.best == *candidate {
                    level.peak
                } else {
                    self.share(b, level, least, candidate)
                };
            }
            if sum > share {
                (largest, share) = (Some(candidate), sum);
            }
        }
        Some((*largest?, share))
    }

    /// The intent in these places.
    fn triple(&self, place: &Place) -> Option<Triple> {
        let [objects, storages] = &self.things;
        let [object, storage] = place.things;
        let at = |options: &Options<'_>, at: u8| options.live.get(usize::from(at)).copied();
        Some(Triple {
            action: at(&self.deeds, place.action)?,
            things: [at(objects, object), at(storages, storage)],
        })
    }
}

/// Moves what stands in the places of live options to the options themselves, scaled; all others
/// are 0.
#[inline(never)]
fn expand(of: &mut [f32], live: &[u8], scale: f32) {
    let mut upto = of.len();
    for (at, &option) in live.iter().enumerate().rev() {
        // No option has a place beyond its own number.
        let option = usize::from(option);
        let Some(p) = of.get(at).copied() else {
            continue;
        };
        if let Some(others) = of.get_mut(option..upto)
            && let [to, others @ ..] = others
        {
            *to = p * scale;
            others.iter_mut().for_each(|p| *p = 0.0);
        }
        upto = option;
    }
    if let Some(others) = of.get_mut(..upto) {
        others.iter_mut().for_each(|p| *p = 0.0);
    }
}
