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
use super::fit::{KINDS, WHOLE, takes};
use super::{LEVELS, Levels};
use crate::category::{Category, CategorySet};
use crate::math::{self, larger};
use crate::vocabulary::Action;

/// What a level may cost beside the best before it is left out, and an action beside the best.
const NEGLIGIBLE: u32 = 352;

/// One category's options.
pub struct Options<'a> {
    /// Those that are weighed.
    pub live: &'a [u8],
    /// What each costs.
    pub costs: &'a [Costs],
}

/// All that the posterior is made of.
pub struct Posterior<'a> {
    /// All actions.
    pub actions: &'a [Action],
    /// The categories that some word speaks of.
    pub spoken: CategorySet,
    /// What the actions cost, their words' presence included.
    pub deeds: Options<'a>,
    /// Objects, then storages.
    pub things: [Options<'a>; 2],
    /// How well options fit: see [`super::fit::Survey::fits`].
    pub fits: &'a [u8],
    /// Options that an action has room for in `fits`.
    pub stride: usize,
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

/// What one level came to.
#[derive(Clone, Copy, Default)]
struct Level {
    /// The level's likelihood beside the best's; 0 when it is left out.
    scale: f32,
    /// The mean weights of objects and storages.
    mean: [f32; 2],
    share: f32,
    best: Option<Triple>,
    /// What the best holds.
    peak: f32,
}

/// What of an intent's kind of thing an action takes.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    /// None: any word about it names nothing.
    None,
    /// One that it needs.
    Needed,
    /// One that was said without need: a share of all.
    Given,
}

impl Posterior<'_> {
    /// The best intent; the marginals of actions, objects and storages are filled in. `None` when
    /// nothing can be done.
    #[inline(never)]
    pub fn solve(&self, marginals: &mut [Marginal<'_>; 3]) -> Option<Found> {
        for marginal in marginals.iter_mut() {
            marginal.of.iter_mut().for_each(|p| *p = 0.0);
            marginal.weights.iter_mut().for_each(|w| *w = 0.0);
        }
        if self.deeds.live.is_empty() {
            return None;
        }
        let [objects, storages] = &self.things;
        let least = [&self.deeds, objects, storages].map(least);
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
                self.weigh(b, &least, level, marginals);
                total += level.share;
            }
        }
        // Not above 0 either when it is not a number.
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        let per_total = 1.0 / total;
        let (mut noise, mut knot, mut most) = (0.0, 0.0, (0.0, 0));
        let (mut peaks, mut alike, mut first) = (0.0, true, None);
        for (b, level) in levels.iter().enumerate() {
            noise += level.share * per_total * knot;
            knot += 1.0;
            if level.share > most.0 {
                most = (level.share, b);
            }
            if level.best.is_some() {
                peaks += level.peak;
                alike &= *first.get_or_insert(level.best) == level.best;
            }
        }
        let mut largest = (peaks, first.flatten());
        if !alike {
            largest = (0.0, None);
            for level in &levels {
                if let Some(triple) = level.best.filter(|_| level.best != largest.1) {
                    let share = self.share(&levels, &least, triple);
                    if share > largest.0 {
                        largest = (share, level.best);
                    }
                }
            }
        }
        for marginal in marginals.iter_mut() {
            marginal.of.iter_mut().for_each(|p| *p *= per_total);
        }
        Some(Found {
            best: largest.1?,
            belief: Belief {
                posterior: math::clamp_unit(largest.0 * per_total),
                noise,
            },
            shares: levels.map(|level| level.share * per_total),
            level: most.1,
        })
    }

    /// How well the options of a kind fit an action, in 255ths.
    #[inline(always)]
    fn fits(&self, a: usize, kind: usize) -> &[u8] {
        let start = a
            .wrapping_mul(2)
            .wrapping_add(kind)
            .wrapping_mul(self.stride);
        self.fits.get(start..).unwrap_or(&[])
    }

    #[inline(always)]
    fn part(&self, action: &Action, category: Category) -> Part {
        if action.signature.compulsory.contains(category.index()) {
            Part::Needed
        } else if takes(action, self.spoken, category) {
            Part::Given
        } else {
            Part::None
        }
    }

    /// Weighs all intents at level `b` and adds them to the marginals.
    fn weigh(
        &self,
        b: usize,
        least: &[Costs; 3],
        level: &mut Level,
        marginals: &mut [Marginal<'_>; 3],
    ) {
        let [least_deed, least @ ..] = least;
        let [deeds, things @ ..] = marginals;
        let mut count = [0.0; 2];
        let kinds = self.things.iter().zip(things.iter_mut()).zip(least);
        for (((options, marginal), least), (mean, count)) in
            kinds.zip(level.mean.iter_mut().zip(&mut count))
        {
            let total = spread(options, b, least.at(b), marginal.weights);
            *count = 1.0 / options.live.len().max(1) as f32;
            *mean = if options.live.is_empty() {
                1.0
            } else {
                total * *count
            };
        }
        let mut largest = 0.0;
        for &option in self.deeds.live {
            let a = usize::from(option);
            let (Some(action), Some(cost)) = (self.actions.get(a), self.deeds.costs.get(a)) else {
                continue;
            };
            let above = cost.at(b).saturating_sub(least_deed.at(b));
            if above > NEGLIGIBLE {
                continue;
            }
            let own = level.scale * weight(above);
            let mut sums = level.mean;
            let mut peak = own;
            let mut units = [0.0; 2];
            for (kind, (category, marginal)) in KINDS.into_iter().zip(things.iter()).enumerate() {
                let (Some(sum), Some(unit), Some(count)) =
                    (sums.get_mut(kind), units.get_mut(kind), count.get(kind))
                else {
                    continue;
                };
                let top = match self.part(action, category) {
                    Part::None => *sum,
                    part => {
                        *unit = if part == Part::Needed {
                            1.0 / WHOLE
                        } else {
                            count / WHOLE
                        };
                        let (total, top) = total(self.fits(a, kind), marginal.weights);
                        *sum = total * *unit;
                        top * *unit
                    }
                };
                peak *= top;
            }
            let [object, storage] = sums;
            let share = own * object * storage;
            level.share += share;
            if let Some(p) = deeds.of.get_mut(a) {
                *p += share;
            }
            if peak > largest {
                largest = peak;
                level.best = Some(Triple {
                    action: option,
                    things: [None; 2],
                });
            }
            let rests = [own * storage, own * object];
            for (kind, ((rest, unit), marginal)) in rests
                .into_iter()
                .zip(units)
                .zip(things.iter_mut())
                .enumerate()
            {
                if unit > 0.0 {
                    add(self.fits(a, kind), marginal, rest * unit);
                }
            }
        }
        level.peak = largest;
        if let Some(best) = &mut level.best {
            let a = usize::from(best.action);
            let action = self.actions.get(a);
            for (kind, ((category, marginal), option)) in KINDS
                .into_iter()
                .zip(things.iter())
                .zip(&mut best.things)
                .enumerate()
            {
                if action.is_some_and(|action| self.part(action, category) != Part::None) {
                    *option = favourite(self.fits(a, kind), marginal.weights);
                }
            }
        }
    }

    /// What an intent holds at all levels.
    fn share(&self, levels: &[Level; LEVELS], least: &[Costs; 3], triple: Triple) -> f32 {
        let a = usize::from(triple.action);
        let (Some(action), Some(cost)) = (self.actions.get(a), self.deeds.costs.get(a)) else {
            return 0.0;
        };
        let [least_deed, least @ ..] = least;
        let mut share = 0.0;
        for (b, level) in levels
            .iter()
            .enumerate()
            .filter(|(_, level)| level.scale > 0.0)
        {
            let mut product = level.scale * weight(cost.at(b).saturating_sub(least_deed.at(b)));
            let kinds = KINDS.into_iter().zip(&self.things).zip(least);
            let parts = triple.things.into_iter().zip(level.mean);
            for (kind, (((category, options), least), (option, mean))) in
                kinds.zip(parts).enumerate()
            {
                let Some(o) = option.map(usize::from) else {
                    product *= mean;
                    continue;
                };
                let unit = match self.part(action, category) {
                    Part::Given => 1.0 / (WHOLE * options.live.len().max(1) as f32),
                    _ => 1.0 / WHOLE,
                };
                let fit = self.fits(a, kind).get(o).copied().unwrap_or(0);
                let cost = options.costs.get(o).map_or(0, |costs| costs.at(b));
                product *= unit * f32::from(fit) * weight(cost.saturating_sub(least.at(b)));
            }
            share += product;
        }
        share
    }
}

/// The least costs of the live options, 0 when there are none.
fn least(options: &Options<'_>) -> Costs {
    let mut least = Costs::all(MOST);
    for &o in options.live {
        if let Some(costs) = options.costs.get(usize::from(o)) {
            least = least.least(*costs);
        }
    }
    if options.live.is_empty() {
        Costs::ZERO
    } else {
        least
    }
}

/// Fills in the weights of the live options at a level; gives their sum.
fn spread(options: &Options<'_>, b: usize, least: u32, weights: &mut [f32]) -> f32 {
    let mut total = 0.0;
    for &o in options.live {
        let o = usize::from(o);
        if let (Some(to), Some(costs)) = (weights.get_mut(o), options.costs.get(o)) {
            *to = weight(costs.at(b).saturating_sub(least));
            total += *to;
        }
    }
    total
}

/// The sum of fitting weights, and the largest of them.
#[inline(always)]
fn total(fits: &[u8], weights: &[f32]) -> (f32, f32) {
    let (mut sum, mut top) = (0.0, 0.0);
    for (&fit, weight) in fits.iter().zip(weights) {
        if fit != 0 {
            let weight = f32::from(fit) * weight;
            sum += weight;
            top = larger(top, weight);
        }
    }
    (sum, top)
}

/// Adds fitting weights, multiplied, to a marginal.
#[inline(always)]
fn add(fits: &[u8], marginal: &mut Marginal<'_>, rest: f32) {
    let options = marginal.of.iter_mut().zip(&*marginal.weights);
    for ((p, weight), &fit) in options.zip(fits) {
        if fit != 0 {
            *p += rest * f32::from(fit) * weight;
        }
    }
}

/// The option of the largest fitting weight.
fn favourite(fits: &[u8], weights: &[f32]) -> Option<u8> {
    let (mut top, mut best) = (0.0, None);
    for (o, (&fit, weight)) in (0_u8..).zip(fits.iter().zip(weights)) {
        let weight = f32::from(fit) * weight;
        if weight > top {
            top = weight;
            best = Some(o);
        }
    }
    best
}
