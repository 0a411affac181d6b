//! All intents at one noise level.

use super::cost::{Costs, weight};
use super::posterior::{Marginal, NEGLIGIBLE, Options, Posterior, Triple};
use super::survey::{Part, WHOLE};

/// What a row comes to at the level at hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighed {
    /// The fitting weights of its options, together.
    total: f32,
    /// The largest of them.
    top: f32,
    /// What the rest of all its actions' intents weighs.
    rest: f32,
    /// Where the largest is.
    at: u8,
}

impl Weighed {
    /// Nothing.
    pub const NONE: Self = Self {
        total: 0.0,
        top: 0.0,
        rest: 0.0,
        at: 0,
    };
}

/// What one level came to.
#[derive(Clone, Copy, Default)]
pub struct Level {
    /// The level's likelihood beside the best's; 0 when it is left out.
    pub scale: f32,
    /// The mean weights of objects and storages.
    mean: [f32; 2],
    /// What all intents hold.
    pub share: f32,
    /// The best intent.
    pub best: Option<Triple>,
    /// What the best holds.
    pub peak: f32,
}

impl Posterior<'_> {
    /// Weighs all intents at level `b` and adds them to the marginals.
    #[inline(always)]
    pub(super) fn weigh(
        &self,
        b: usize,
        least: &[Costs; 3],
        level: &mut Level,
        rows: &mut [Weighed],
        marginals: &mut [Marginal<'_>; 3],
    ) {
        let [least_deed, least @ ..] = least;
        let [deeds, things @ ..] = marginals;
        for (((options, marginal), least), mean) in self
            .things
            .iter()
            .zip(things.iter_mut())
            .zip(least)
            .zip(&mut level.mean)
        {
            let total = spread(options, b, least.at(b), marginal.weights);
            *mean = if options.live.is_empty() {
                1.0
            } else {
                total * options.per_count
            };
        }
        for (at, (row, to)) in self.fits.rows.iter().zip(rows.iter_mut()).enumerate() {
            let (kind, part) = row.kind();
            let mean = level.mean.get(kind).copied().unwrap_or(1.0);
            *to = Weighed {
                total: mean,
                top: mean,
                ..Weighed::NONE
            };
            if part != Part::None
                && let Some(marginal) = things.get(kind)
            {
                total(
                    self.fits.row(at),
                    marginal.weights,
                    self.unit(kind, part),
                    to,
                );
            }
        }
        let mut best = (0, [0; 2]);
        for &option in self.deeds.live {
            let a = usize::from(option);
            let (Some(cost), Some(&of)) = (self.deeds.costs.get(a), self.fits.of.get(a)) else {
                continue;
            };
            let above = cost.at(b).saturating_sub(least_deed.at(b));
            let [object, storage] = of.map(usize::from);
            let (Some(o), Some(s)) = (rows.get(object), rows.get(storage)) else {
                continue;
            };
            if above > NEGLIGIBLE {
                continue;
            }
            let own = level.scale * weight(above);
            let (objects, storages) = (o.total, s.total);
            let peak = own * o.top * s.top;
            let share = own * objects * storages;
            level.share += share;
            if let Some(p) = deeds.of.get_mut(a) {
                *p += share;
            }
            if peak > level.peak {
                level.peak = peak;
                best = (option, [object, storage]);
            }
            for (row, rest) in [(object, own * storages), (storage, own * objects)] {
                if let Some(row) = rows.get_mut(row) {
                    row.rest += rest;
                }
            }
        }
        for (at, (row, weighed)) in self.fits.rows.iter().zip(rows.iter()).enumerate() {
            let (kind, part) = row.kind();
            if part != Part::None
                && weighed.rest > 0.0
                && let Some(marginal) = things.get_mut(kind)
            {
                add(
                    self.fits.row(at),
                    marginal,
                    weighed.rest * self.unit(kind, part),
                );
            }
        }
        let (action, of) = best;
        if level.peak > 0.0 {
            let thing = |row: usize| {
                let (_, part) = self.fits.rows.get(row)?.kind();
                let at = rows.get(row)?.at;
                (part != Part::None).then_some(at)
            };
            level.best = Some(Triple {
                action,
                things: of.map(thing),
            });
        }
    }

    /// What an intent holds at a level.
    #[inline(never)]
    pub(super) fn share(&self, b: usize, level: &Level, least: &[Costs; 3], triple: Triple) -> f32 {
        let a = usize::from(triple.action);
        let [least_deed, least @ ..] = least;
        let Some(cost) = self.deeds.costs.get(a) else {
            return 0.0;
        };
        let mut product = level.scale * weight(cost.at(b).saturating_sub(least_deed.at(b)));
        let kinds = self.things.iter().zip(least);
        let parts = triple.things.into_iter().zip(level.mean);
        for (kind, ((options, least), (option, mean))) in kinds.zip(parts).enumerate() {
            product *= match option.map(usize::from) {
                None => mean,
                Some(o) => {
                    let (part, fits) = self.fits.of(a, kind);
                    let fit = fits.get(o).copied().unwrap_or(0);
                    let cost = options.costs.get(o).map_or(0, |costs| costs.at(b));
                    let weight = weight(cost.saturating_sub(least.at(b)));
                    self.unit(kind, part) * f32::from(fit) * weight
                }
            };
        }
        product
    }

    /// What fits in 255ths are multiplied by: what is given without need is one of all.
    #[inline(always)]
    fn unit(&self, kind: usize, part: Part) -> f32 {
        let count = self.things.get(kind).map_or(1.0, |things| things.per_count);
        match part {
            Part::Given => count * (1.0 / WHOLE),
            _ => 1.0 / WHOLE,
        }
    }
}

/// Fills in the weights of the live options at a level; gives their sum.
#[inline(always)]
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

/// The sum of fitting weights, the largest of them and where it is.
#[inline(always)]
fn total(fits: &[u8], weights: &[f32], unit: f32, to: &mut Weighed) {
    let (mut sum, mut top, mut best) = (0.0, 0.0, 0);
    for (o, (&fit, weight)) in fits.iter().zip(weights).enumerate() {
        if fit != 0 {
            let weight = f32::from(fit) * weight;
            sum += weight;
            if weight > top {
                (top, best) = (weight, o);
            }
        }
    }
    (to.total, to.top, to.at) = (sum * unit, top * unit, best as u8);
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
