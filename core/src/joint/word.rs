//! How well every option explains a word: the noise that it takes to report these likelihoods when
//! that option is meant.
//!
//! An element of a word is explained by what the sensor reports when option `k` is meant, or as a
//! *rival*: raised beside the one that was meant, as if it were named itself. Rivals are scattered
//! (a few anywhere), or all actions of another signature are raised at once, as when someone
//! shows `pick` with a hand that says `put into` as well (the paper's `D_arity`).
//!
//! On a Cortex-M4F an element costs about 25 instructions per option, and 20 more where it may be
//! raised.

use super::cost::{Costs, MOST};
use super::sensors::Rows;
use super::tables::LINES;
use crate::math::larger;
use crate::vocabulary::Action;

/// How much a rival costs beside an element that is none: 19 to 1 among actions ...
const RIVAL_ACTION: Costs = Costs::all(136);
/// ... and 9 to 1 in other words.
const RIVAL: Costs = Costs::all(101);
/// What an element of another signature costs that is raised with all of them, beside one without
/// any rivals: 95 to 80 ...
const RAISED: Costs = Costs::all(8);
/// ... and one that is not raised for all that: 95 to 20.
const NOT_RAISED: Costs = Costs::all(72);

/// How much less likely any option is that a word is about another one altogether, than the best of
/// those: 1 to 1000.
pub(super) const CLASH: u16 = 319;

/// What a word can cost an option at most, 128 octaves: seven words stay below [`MOST`].
pub const DEAREST: u16 = 0x0fff;

/// Elements that stay below [`MOST`] together.
const FEW: usize = 54;

/// An element of a word, ready to be explained.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// In 255ths.
    seen: u8,
    /// Whether it is 0 or 1, where clipping gathers all that lies beyond.
    at_end: bool,
    /// The categories that its action takes.
    signature: u32,
    /// What it costs when it is named itself.
    own: Costs,
    /// What it costs as a scattered rival, or of a flat sensor, when another is named.
    other: Costs,
    /// The same of an action whose signature is raised, when one of another is named.
    raised: Costs,
}

impl Element {
    /// Of no word.
    pub const NONE: Self = Self {
        seen: 0,
        at_end: false,
        signature: 0,
        own: Costs::ZERO,
        other: Costs::ZERO,
        raised: Costs::ZERO,
    };

    /// What it costs when this is expected.
    #[inline(always)]
    fn cost(&self, expected: u8) -> Costs {
        let error = self.seen.abs_diff(expected);
        let line = LINES.get(usize::from(self.at_end));
        let cost = line.and_then(|line| line.get(usize::from(error)));
        cost.copied().unwrap_or(Costs::ZERO)
    }
}

/// Room to work on a word.
pub struct Room<'a> {
    /// One per option.
    pub elements: &'a mut [Element],
    /// Costs of live options, one after the other.
    pub sums: &'a mut [Costs],
    /// Those with other signatures raised.
    pub raised: &'a mut [Costs],
    /// What its own element costs every option; added to. Empty where nobody wants to know.
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
}

impl Reading<'_> {
    /// Reads every element, and what it costs when it is named itself and as a rival; of a flat
    /// sensor gives the sum of what elements cost that are not named.
    #[inline(always)]
    fn prepare(&self, room: &mut Room<'_>, rival: Costs, raises: bool) -> Costs {
        let n = self.likelihoods.len();
        let mut sum = Costs::ZERO;
        let mut diagonal = self.rows.bytes.iter().step_by(n.saturating_add(1));
        let mut named = room.named.iter_mut();
        for (element, &seen) in room.elements.iter_mut().zip(self.likelihoods) {
            element.seen = (seen * 255.0 + 0.5) as u32 as u8;
            element.at_end = element.seen.wrapping_add(1) < 2;
            let own = element.cost(diagonal.next().copied().unwrap_or(u8::MAX));
            if let Some(named) = named.next() {
                *named = named.plus(own);
            }
            element.own = own;
            element.other = own.plus(rival);
            if raises {
                element.raised = own.plus(RAISED);
            }
            if let Some(elsewhere) = self.rows.elsewhere {
                let cost = element.cost(elsewhere);
                element.other = cost.least(element.other);
                sum = sum.plus(element.other);
                if raises {
                    element.raised = cost.plus(NOT_RAISED).least(element.raised);
                }
            }
        }
        sum
    }
}

/// Adds a parameter word's costs to what was heard.
#[inline(never)]
pub fn parameter(reading: &Reading<'_>, room: &mut Room<'_>, heard: &mut [Costs]) {
    let all = reading.prepare(room, RIVAL, false);
    let few = room.elements.len() <= FEW;
    let mut best = Costs::all(MOST);
    for (&k, place) in reading.live.iter().zip(&mut *room.sums) {
        let k = usize::from(k);
        let mut sum = all;
        if reading.rows.elsewhere.is_some() {
            if let Some(named) = room.elements.get(k) {
                sum = sum.minus(named.other).plus(named.own);
            }
        } else {
            for (element, &expected) in room.elements.iter().zip(reading.rows.of(k)) {
                sum = sum.plus(element.cost(expected).least(element.other));
            }
        }
        if !few {
            sum = bounded(sum);
        }
        best = best.least(sum);
        *place = sum;
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
    let all = reading.prepare(room, RIVAL_ACTION, true);
    let few = room.elements.len() <= FEW;
    for (element, action) in room.elements.iter_mut().zip(actions) {
        element.signature = action.signature.compulsory.0;
    }
    let (mut best, mut best_raised) = (Costs::all(MOST), Costs::all(MOST));
    let mut last = None;
    let sums = room.sums.iter_mut().zip(&mut *room.raised);
    for (&k, (plain, raised)) in reading.live.iter().zip(sums) {
        let k = usize::from(k);
        let Some(named) = room.elements.get(k) else {
            continue;
        };
        let signature = named.signature;
        let (mut sum, mut other) = (all, Costs::ZERO);
        if reading.rows.elsewhere.is_some() {
            let (of, with) = last.unwrap_or((!signature, Costs::ZERO));
            other = with;
            if of != signature {
                other = Costs::ZERO;
                for element in room.elements.iter() {
                    other = other.plus(if element.signature == signature {
                        element.other
                    } else {
                        element.raised
                    });
                }
                last = Some((signature, other));
            }
            sum = sum.minus(named.other).plus(named.own);
            other = other.minus(named.other).plus(named.own);
        } else {
            for (element, &expected) in room.elements.iter().zip(reading.rows.of(k)) {
                let cost = element.cost(expected);
                let alike = cost.least(element.other);
                sum = sum.plus(alike);
                other = other.plus(if element.signature == signature {
                    alike
                } else {
                    cost.plus(NOT_RAISED).least(element.raised)
                });
            }
        }
        if !few {
            (sum, other) = (bounded(sum), bounded(other));
        }
        (best, best_raised) = (best.least(sum), best_raised.least(other));
        (*plain, *raised) = (sum, other);
    }
    let floor = Costs::all(best.least(best_raised).lowest());
    add(reading, room.sums, best, floor, heard);
    add(reading, room.raised, best_raised, floor, heard_raised);
}

/// Costs that [`Costs::least`] can compare.
fn bounded(costs: Costs) -> Costs {
    Costs::new(costs.lanes().map(|cost| cost.min(MOST)))
}

/// Adds costs of which `best` are the least. No option is less likely than that the word is about
/// another one; `floor`, which all have, is left out.
fn add(reading: &Reading<'_>, sums: &[Costs], best: Costs, floor: Costs, heard: &mut [Costs]) {
    let most = u32::from(floor.lowest()).saturating_add(u32::from(DEAREST));
    let most = most.min(u32::from(MOST)) as u16;
    let limit = Costs::new(
        best.lanes()
            .map(|best| best.saturating_add(CLASH).min(most)),
    );
    for (&k, sum) in reading.live.iter().zip(sums) {
        let mut cost = sum.least(limit).minus(floor);
        if reading.weight != 256 {
            cost = cost.weighed(reading.weight).least(Costs::all(DEAREST));
        }
        if let Some(heard) = heard.get_mut(usize::from(k)) {
            *heard = heard.plus(cost);
        }
    }
}

/// A weight in 256ths, at most 16.
#[must_use]
pub fn in_256ths(weight: f32) -> u32 {
    ((larger(weight, 0.0) * 256.0) as u32).min(16 * 256)
}
