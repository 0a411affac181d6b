//! How well every option explains a word: the noise that it takes to report these likelihoods when
//! that option is meant.
//!
//! An element of a word is explained by what the sensor reports when option `k` is meant, or as one of
//! its [rivals](super::rivals).
//!
//! On a Cortex-M4F an element costs about 25 instructions per option, and 20 more where it may be
//! raised.

use super::cost::{Costs, MOST};
use super::element::{Element, Seen};
use super::rivals::{NOT_RAISED, RAISED, RIVAL, RIVAL_ACTION, leave_out, repeated};
use super::sensors::Rows;
use crate::math::larger;
use crate::vocabulary::Action;

/// How much less likely any option is that a word is about another one altogether, than the best of
/// those: 1 to 1000.
pub(super) const CLASH: u16 = 319;

/// What a word can cost an option at most, 128 octaves: seven words stay below [`MOST`].
pub const DEAREST: u16 = 0x0fff;

/// Elements that stay below [`MOST`] together.
const FEW: usize = 54;

/// Room to work on a word.
pub struct Room<'a> {
    /// One per option.
    pub elements: &'a mut [Element],
    /// Costs of live options, one after the other.
    pub sums: &'a mut [Costs],
    /// Those with other signatures raised.
    pub raised: &'a mut [Costs],
    /// What its own element costs every option; added to.
    pub named: &'a mut [Costs],
}

/// A word and its sensor.
#[derive(Clone, Copy)]
pub struct Reading<'a> {
    /// One likelihood per option, in 0..=1.
    pub likelihoods: &'a [f32],
    /// What the sensor reports.
    pub rows: Rows<'a>,
    /// The options that are weighed.
    pub live: &'a [u8],
    /// How much the word counts, in 256ths.
    pub weight: u32,
    /// Whether it is the first of its category: what is added to counts as 0 then.
    pub first: bool,
}

impl<'a> Reading<'a> {
    /// What is reported of every option when it is meant itself.
    #[inline(always)]
    fn expected(&self) -> impl Iterator<Item = u8> + use<'a> {
        let (bytes, step) = (self.rows.bytes, self.likelihoods.len().wrapping_add(1));
        let mut diagonal = 0_usize;
        core::iter::from_fn(move || {
            let expected = bytes.get(diagonal).copied();
            diagonal = diagonal.wrapping_add(step);
            Some(expected.unwrap_or(u8::MAX))
        })
    }

    /// Reads every element of a flat sensor, which reports `elsewhere` of all but what is meant; gives
    /// what they cost when none is named.
    #[inline(always)]
    fn prepare_flat(
        &self,
        elsewhere: u8,
        elements: &mut [Element],
        named: &mut [Costs],
        rival: Costs,
        raises: bool,
    ) -> Costs {
        let mut sum = Costs::ZERO;
        let elements = elements.iter_mut().zip(self.likelihoods);
        let elements = elements.zip(named).zip(self.expected());
        for (((element, &likelihood), named), expected) in elements {
            let seen = Seen::new(likelihood);
            let (own, cost) = (seen.cost(expected), seen.cost(elsewhere));
            let other = cost.least(own.plus(rival));
            element.own = own;
            element.other = other.bar();
            if raises {
                let raised = cost.plus(NOT_RAISED).least(own.plus(RAISED));
                element.raised = raised.bar();
            }
            put(named, own, self.first);
            sum = sum.plus(other);
        }
        sum
    }

    /// Reads every element of a sensor that is not flat; gives what they cost when they are named
    /// themselves.
    #[inline(always)]
    fn prepare(
        &self,
        elements: &mut [Element],
        named: &mut [Costs],
        rival: Costs,
        raises: bool,
    ) -> Costs {
        let mut sum = Costs::ZERO;
        let elements = elements.iter_mut().zip(self.likelihoods);
        let elements = elements.zip(named).zip(self.expected());
        for (((element, &likelihood), named), expected) in elements {
            let seen = Seen::new(likelihood);
            let own = seen.cost(expected);
            element.seen = seen;
            element.other = own.plus(rival).bar();
            if raises {
                element.raised = NOT_RAISED.below(own.plus(RAISED).bar()).bar();
            }
            put(named, own, self.first);
            sum = sum.plus(own);
        }
        sum
    }
}

/// Adds a parameter word's costs to what was heard.
#[inline(never)]
pub fn parameter(reading: &Reading<'_>, room: &mut Room<'_>, heard: &mut [Costs]) {
    let mut best = Costs::all(MOST);
    if let Some(elsewhere) = reading.rows.elsewhere {
        let all = reading.prepare_flat(elsewhere, room.elements, room.named, RIVAL, false);
        for (&k, place) in reading.live.iter().zip(&mut *room.sums) {
            let mut sum = all;
            if let Some(named) = room.elements.get(usize::from(k)) {
                sum = sum.minus(named.other.costs()).plus(named.own);
            }
            sum = bounded(sum, room.elements);
            best = best.least(sum);
            *place = sum;
        }
    } else {
        let own = reading.prepare(room.elements, room.named, RIVAL, false);
        let all = own.plus(RIVAL.times(room.elements.len()));
        for (&k, place) in reading.live.iter().zip(&mut *room.sums) {
            let mut sum = all;
            let row = reading.rows.of(usize::from(k));
            for (element, &expected) in room.elements.iter().zip(row) {
                let cost = element.seen.cost(expected);
                sum = sum.minus(cost.below(element.other));
            }
            sum = bounded(sum, room.elements);
            best = best.least(sum);
            *place = sum;
        }
    }
    let floor = Costs::all(best.lowest());
    add(reading, room.sums, best, floor, heard);
}

/// Adds an action word's costs to what was heard, with rivals anywhere, and to what was heard should
/// the actions of other signatures be raised.
#[inline(never)]
pub fn action(
    reading: &Reading<'_>,
    actions: &[Action],
    room: &mut Room<'_>,
    heard: &mut [Costs],
    heard_raised: &mut [Costs],
) {
    let (mut best, mut best_raised) = (Costs::all(MOST), Costs::all(MOST));
    let (mut of, mut beside) = (None, Costs::ZERO);
    let repeated = repeated(reading.likelihoods, reading.live);
    let sums = room.sums.iter_mut().zip(&mut *room.raised);
    let live = reading.live.iter().zip(sums);
    if let Some(elsewhere) = reading.rows.elsewhere {
        let all = reading.prepare_flat(elsewhere, room.elements, room.named, RIVAL_ACTION, true);
        let all = leave_out(repeated, room.elements, all, Costs::ZERO);
        for (&k, (plain, raised)) in live {
            let k = usize::from(k);
            let (Some(named), Some(action)) = (room.elements.get(k), actions.get(k)) else {
                continue;
            };
            let signature = action.signature.compulsory;
            if of != Some(signature) {
                of = Some(signature);
                beside = Costs::ZERO;
                for (element, action) in room.elements.iter().zip(actions) {
                    let other = if action.signature.compulsory == signature {
                        element.other
                    } else {
                        element.raised
                    };
                    beside = beside.plus(other.costs());
                }
            }
            let swapped = |all: Costs| all.minus(named.other.costs()).plus(named.own);
            let (sum, other) = (swapped(all), swapped(beside));
            (*plain, *raised) = (bounded(sum, room.elements), bounded(other, room.elements));
            (best, best_raised) = (best.least(*plain), best_raised.least(*raised));
        }
    } else {
        let own = reading.prepare(room.elements, room.named, RIVAL_ACTION, true);
        let own = leave_out(repeated, room.elements, own, RIVAL_ACTION);
        let counted = room
            .elements
            .len()
            .saturating_sub(repeated.count_ones() as usize);
        let all = own.plus(RIVAL_ACTION.times(counted));
        for (&k, (plain, raised)) in live {
            let k = usize::from(k);
            let Some(action) = actions.get(k) else {
                continue;
            };
            let signature = action.signature.compulsory;
            if of != Some(signature) {
                of = Some(signature);
                let pairs = room.elements.iter().zip(actions);
                let of_it = |(element, action): &(&Element, &Action)| {
                    element.counts() && action.signature.compulsory == signature
                };
                let same = pairs.filter(of_it).count();
                beside = own
                    .plus(RIVAL_ACTION.times(same))
                    .plus(RAISED.times(counted.saturating_sub(same)));
            }
            let (mut sum, mut other) = (all, beside);
            let row = room.elements.iter().zip(reading.rows.of(k)).zip(actions);
            for ((element, &expected), action) in row {
                let cost = element.seen.cost(expected);
                let below = cost.below(element.other);
                sum = sum.minus(below);
                other = other.minus(if action.signature.compulsory == signature {
                    below
                } else {
                    cost.below(element.raised)
                });
            }
            (*plain, *raised) = (bounded(sum, room.elements), bounded(other, room.elements));
            (best, best_raised) = (best.least(*plain), best_raised.least(*raised));
        }
    }
    let floor = Costs::all(best.least(best_raised).lowest());
    add(reading, room.sums, best, floor, heard);
    add(reading, room.raised, best_raised, floor, heard_raised);
}

/// The sum of so many elements, so that [`Costs::least`] can compare it.
#[inline(always)]
fn bounded(costs: Costs, elements: &[Element]) -> Costs {
    if elements.len() <= FEW {
        return costs;
    }
    Costs::new(costs.lanes().map(|cost| cost.min(MOST)))
}

/// Adds costs of which `best` are the least. No option is less likely than that the word is about
/// another one; `floor`, which all have, is left out.
#[inline(always)]
fn add(reading: &Reading<'_>, sums: &[Costs], best: Costs, floor: Costs, heard: &mut [Costs]) {
    let most = u32::from(floor.lowest()).saturating_add(u32::from(DEAREST));
    let most = most.min(u32::from(MOST)) as u16;
    let limit = best.least(Costs::all(most.saturating_sub(CLASH)));
    let limit = limit.plus(Costs::all(CLASH));
    let (bar, dearest) = (limit.bar(), limit.minus(floor));
    let sums = sums.get(..reading.live.len()).unwrap_or(sums);
    for (heard, sum) in heard.iter_mut().zip(sums) {
        let mut cost = dearest.minus(sum.below(bar));
        if reading.weight != 256 {
            cost = cost.weighed(reading.weight).least(Costs::all(DEAREST));
        }
        put(heard, cost, reading.first);
    }
}

/// Adds a cost, the first to nothing.
#[inline(always)]
pub(super) fn put(sum: &mut Costs, cost: Costs, first: bool) {
    *sum = if first { cost } else { sum.plus(cost) };
}

/// A weight in 256ths, at most 16.
#[must_use]
pub fn in_256ths(weight: f32) -> u32 {
    ((larger(weight, 0.0) * 256.0) as u32).min(16 * 256)
}
