//! All intents at one noise level.

use super::cost::Costs;
use super::factors::{Factors, Marginal, NEGLIGIBLE, Options};
use super::fits::{Kind, Part, WHOLE};
use super::weight::weight;

/// What a row comes to at the level at hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighed {
    /// The fitting weights of its options, together.
    total: f32,
    /// The largest of them.
    top: f32,
    /// What the rest of all its actions' intents weighs.
    rest: f32,
    /// Where the largest is, among the live ones.
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

/// An intent by the places of its action, object and storage among the live ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Place {
    /// The action's.
    pub action: u8,
    /// The object's and the storage's; [`NOWHERE`] when it takes none.
    pub things: [u8; 2],
}

/// No place.
pub(super) const NOWHERE: u8 = u8::MAX;

/// What one level came to.
#[derive(Clone, Copy, Default)]
pub(super) struct Level {
    /// The level's likelihood beside the best's; 0 when it is left out.
    pub scale: f32,
    /// The mean weights of objects and storages.
    mean: [f32; 2],
    /// What all intents hold.
    pub share: f32,
    /// The best intent; of no meaning when its share is 0.
    pub best: Place,
    /// What the best holds.
    pub peak: f32,
}

impl Factors<'_> {
    /// Weighs all intents at level `b` and adds them to the marginals, in the places of the live
    /// options.
    #[inline(never)]
    pub(super) fn weigh(
        &self,
        b: usize,
        least: &[Costs; 3],
        level: &mut Level,
        rows: &mut [&mut [Weighed]; 2],
        marginals: &mut [Marginal<'_>; 3],
    ) {
        let [least_deed, least_object, least_storage] = least;
        let [deeds, of_objects, of_storages] = marginals;
        let [objects, storages] = &self.things;
        let [object_kind, storage_kind] = &self.fits.kinds;
        let [object_rows, storage_rows] = rows;
        let stride = self.fits.stride;
        let mean_object = spread(objects, b, least_object.at(b), of_objects.weights);
        let mean_storage = spread(storages, b, least_storage.at(b), of_storages.weights);
        sum(
            object_kind,
            stride,
            of_objects.weights,
            objects,
            object_rows,
        );
        sum(
            storage_kind,
            stride,
            of_storages.weights,
            storages,
            storage_rows,
        );
        let least = least_deed.at(b);
        let (mut share, mut peak, mut best) = (0.0, 0.0, Place::default());
        let live = self.deeds.live.iter().zip(self.deeds.costs);
        for (at_action, ((&option, cost), p)) in (0_u8..).zip(live.zip(&mut *deeds.of)) {
            let above = cost.at(b).saturating_sub(least);
            let Some(&[object, storage]) = self.fits.of.get(usize::from(option)) else {
                continue;
            };
            if above > NEGLIGIBLE {
                continue;
            }
            let object = object_rows.get_mut(usize::from(object));
            let storage = storage_rows.get_mut(usize::from(storage));
            let own = level.scale * weight(above);
            let (all_objects, top_object) = of(&object, mean_object);
            let (all_storages, top_storage) = of(&storage, mean_storage);
            let top = own * top_object * top_storage;
            let all = own * all_objects * all_storages;
            share += all;
            *p += all;
            if top > peak {
                peak = top;
                let at = |row: &Option<&mut Weighed>| row.as_ref().map_or(NOWHERE, |row| row.at);
                best = Place {
                    action: at_action,
                    things: [at(&object), at(&storage)],
                };
            }
            if let Some(row) = object {
                row.rest += own * all_storages;
            }
            if let Some(row) = storage {
                row.rest += own * all_objects;
            }
        }
        level.mean = [mean_object, mean_storage];
        (level.share, level.peak, level.best) = (share, peak, best);
        add(object_kind, stride, of_objects, objects, object_rows);
        add(storage_kind, stride, of_storages, storages, storage_rows);
    }

    /// What an intent holds at a level.
    #[inline(never)]
    pub(super) fn share(&self, b: usize, level: &Level, least: &[Costs; 3], place: &Place) -> f32 {
        let [least_deed, least @ ..] = least;
        let a = usize::from(place.action);
        let (Some(cost), Some(&option)) = (self.deeds.costs.get(a), self.deeds.live.get(a)) else {
            return 0.0;
        };
        let [objects, storages] = &self.things;
        let [least_object, least_storage] = least;
        let [object, storage] = place.things;
        let [mean_object, mean_storage] = level.mean;
        let a = usize::from(option);
        let own = level.scale * weight(cost.at(b).saturating_sub(least_deed.at(b)));
        let object = self.part(a, 0, objects, (b, least_object), object);
        let storage = self.part(a, 1, storages, (b, least_storage), storage);
        own * object.unwrap_or(mean_object) * storage.unwrap_or(mean_storage)
    }

    /// How much a thing fits an action and what was said at a level; `None` when there is none.
    #[inline(never)]
    fn part(
        &self,
        a: usize,
        kind: usize,
        options: &Options<'_>,
        (b, least): (usize, &Costs),
        at: u8,
    ) -> Option<f32> {
        let cost = options.costs.get(usize::from(at))?;
        let (part, fits) = self.fits.of(a, kind);
        let fit = fits.get(usize::from(at)).copied().unwrap_or(0);
        let weight = weight(cost.at(b).saturating_sub(least.at(b)));
        Some(unit(part, options) * f32::from(fit) * weight)
    }
}

/// What fits in 255ths are multiplied by: what is given without need is one of all.
#[inline(always)]
fn unit(part: Part, options: &Options<'_>) -> f32 {
    match part {
        Part::Given => options.per_count * (1.0 / WHOLE),
        _ => 1.0 / WHOLE,
    }
}

/// A row's total and the largest of it; the mean of all options of an action without one.
#[inline(always)]
fn of(row: &Option<&mut Weighed>, mean: f32) -> (f32, f32) {
    match row {
        Some(row) => (row.total, row.top),
        None => (mean, mean),
    }
}

/// Fills in the weights of the live options at a level; gives their mean, 1 when there are none.
#[inline(never)]
fn spread(options: &Options<'_>, b: usize, least: u32, weights: &mut [f32]) -> f32 {
    if options.live.is_empty() {
        return 1.0;
    }
    let mut total = 0.0;
    for (to, costs) in weights.iter_mut().zip(options.costs) {
        *to = weight(costs.at(b).saturating_sub(least));
        total += *to;
    }
    total * options.per_count
}

/// Sums up the fitting weights of every row, and finds the largest of them.
#[inline(never)]
fn sum(
    kind: &Kind<'_>,
    stride: usize,
    weights: &[f32],
    options: &Options<'_>,
    rows: &mut [Weighed],
) {
    let weights = weights.get(..options.costs.len()).unwrap_or(weights);
    for ((row, fits), to) in kind.iter(stride).zip(rows) {
        let (mut sum, mut top, mut best) = (0.0, 0.0, 0);
        for (at, (&fit, weight)) in fits.iter().zip(weights).enumerate() {
            let weight = f32::from(fit) * weight;
            sum += weight;
            if weight > top {
                (top, best) = (weight, at);
            }
        }
        let unit = unit(row.part(), options);
        *to = Weighed {
            total: sum * unit,
            top: top * unit,
            rest: 0.0,
            at: best as u8,
        };
    }
}

/// Adds every row's fitting weights, times the rest of its intents, to the marginal.
#[inline(never)]
fn add(
    kind: &Kind<'_>,
    stride: usize,
    marginal: &mut Marginal<'_>,
    options: &Options<'_>,
    rows: &[Weighed],
) {
    let weights = marginal.weights.get(..options.costs.len());
    let weights = weights.unwrap_or(&*marginal.weights);
    for ((row, fits), weighed) in kind.iter(stride).zip(rows) {
        if weighed.rest > 0.0 {
            let rest = weighed.rest * unit(row.part(), options);
            let places = marginal.of.iter_mut().zip(weights).zip(fits);
            for ((p, weight), &fit) in places {
                *p += rest * f32::from(fit) * weight;
            }
        }
    }
}
