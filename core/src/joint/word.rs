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

use super::cost::{Bar, Costs, MOST};
use super::sensors::Rows;
use super::tables::{LINES, Line};
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
    /// Costs by error; of 0 and 1, where clipping gathers all that lies beyond, others than of what
    /// lies between. Not a mere reference, since what is all zeros in memory must be an element.
    line: Option<&'static Line>,
    /// The categories that its action takes.
    signature: u32,
    /// What it costs when it is named itself.
    own: Costs,
    /// What it costs as a scattered rival, or of a flat sensor, when another is named.
    other: Bar,
    /// The same of an action whose signature is raised, when one of another is named.
    raised: Bar,
}

impl Element {
    /// Of no word.
    pub const NONE: Self = Self {
        seen: 0,
        line: None,
        signature: 0,
        own: Costs::ZERO,
        other: Bar::ZERO,
        raised: Bar::ZERO,
    };

    /// Reads a likelihood of which `expected` would be reported were it named.
    #[inline(always)]
    fn read(&mut self, likelihood: f32, expected: u8) {
        self.seen = (likelihood * 255.0 + 0.5) as u32 as u8;
        let at_end = self.seen.wrapping_add(1) < 2;
        let [between, end] = &LINES;
        self.line = Some(if at_end { end } else { between });
        self.own = self.cost(expected);
    }

    /// What it costs when this is expected.
    #[inline(always)]
    fn cost(&self, expected: u8) -> Costs {
        let error = self.seen.abs_diff(expected);
        let cost = self.line.and_then(|line| line.get(usize::from(error)));
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
    /// Whether it is the first of its category: what is added to counts as 0 then.
    pub first: bool,
}

impl Reading<'_> {
    /// Reads every element, and what it costs when it is named itself and when it is not; gives the
    /// sum of the latter. Of a sensor that is not flat only rivals are known here.
    #[inline(always)]
    fn prepare(&self, room: &mut Room<'_>, rival: Costs, raises: bool) -> Costs {
        let mut diagonal = 0_usize;
        let next = self.likelihoods.len().wrapping_add(1);
        let mut named = room.named.iter_mut();
        let mut read = |element: &mut Element, likelihood: f32| {
            let expected = self.rows.bytes.get(diagonal).copied();
            diagonal = diagonal.wrapping_add(next);
            element.read(likelihood, expected.unwrap_or(u8::MAX));
            if let Some(named) = named.next() {
                put(named, element.own, self.first);
            }
        };
        let mut sum = Costs::ZERO;
        let elements = room.elements.iter_mut().zip(self.likelihoods);
        if let Some(elsewhere) = self.rows.elsewhere {
            for (element, &likelihood) in elements {
                read(element, likelihood);
                let cost = element.cost(elsewhere);
                let other = cost.least(element.own.plus(rival));
                element.other = other.bar();
                sum = sum.plus(other);
                if raises {
                    let raised = cost.plus(NOT_RAISED).least(element.own.plus(RAISED));
                    element.raised = raised.bar();
                }
            }
        } else {
            for (element, &likelihood) in elements {
                read(element, likelihood);
                let other = element.own.plus(rival);
                element.other = other.bar();
                sum = sum.plus(other);
                if raises {
                    element.raised = element.own.plus(RAISED).bar();
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
                sum = sum.minus(named.other.costs()).plus(named.own);
            }
        } else {
            for (element, &expected) in room.elements.iter().zip(reading.rows.of(k)) {
                sum = sum.minus(element.cost(expected).below(element.other));
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
    let (mut of, mut beside) = (None, Costs::ZERO);
    let sums = room.sums.iter_mut().zip(&mut *room.raised);
    for (&k, (plain, raised)) in reading.live.iter().zip(sums) {
        let k = usize::from(k);
        let Some(named) = room.elements.get(k) else {
            continue;
        };
        let signature = named.signature;
        if of != Some(signature) {
            of = Some(signature);
            beside = Costs::ZERO;
            for element in room.elements.iter() {
                let other = if element.signature == signature {
                    element.other
                } else {
                    element.raised
                };
                beside = beside.plus(other.costs());
            }
        }
        let (mut sum, mut other) = (all, beside);
        if reading.rows.elsewhere.is_some() {
            let more = named.own;
            sum = sum.minus(named.other.costs()).plus(more);
            other = other.minus(named.other.costs()).plus(more);
        } else {
            for (element, &expected) in room.elements.iter().zip(reading.rows.of(k)) {
                let cost = element.cost(expected);
                let below = cost.below(element.other);
                sum = sum.minus(below);
                other = other.minus(if element.signature == signature {
                    below
                } else {
                    cost.plus(NOT_RAISED).below(element.raised)
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
#[inline(never)]
fn add(reading: &Reading<'_>, sums: &[Costs], best: Costs, floor: Costs, heard: &mut [Costs]) {
    let most = u32::from(floor.lowest()).saturating_add(u32::from(DEAREST));
    let most = most.min(u32::from(MOST)) as u16;
    let limit = best.least(Costs::all(most.saturating_sub(CLASH)));
    let limit = limit.plus(Costs::all(CLASH)).bar();
    for (&k, sum) in reading.live.iter().zip(sums) {
        let mut cost = limit.costs().minus(sum.below(limit)).minus(floor);
        if reading.weight != 256 {
            cost = cost.weighed(reading.weight).least(Costs::all(DEAREST));
        }
        if let Some(heard) = heard.get_mut(usize::from(k)) {
            put(heard, cost, reading.first);
        }
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
