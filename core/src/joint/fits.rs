//! How well things fit actions: a row of fits for every way to take a kind of thing, which all actions
//! share that take it alike.

use super::fit::product;
use crate::category::{Category, CategorySet};
use crate::vocabulary::{Action, Requirement};

/// A likelihood of 1 in a fit.
pub const WHOLE: f32 = 255.0;

/// What an action has instead of a row when it takes nothing of a kind.
pub const NO_ROW: u8 = u8::MAX;

/// A thing on the table.
#[derive(Clone, Copy)]
pub struct Thing<'a> {
    /// Which option of its category it is.
    pub option: u8,
    /// The likelihood of every feature.
    pub features: &'a [f32],
}

/// What of an intent's kind of thing an action takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// None: any word about it names nothing.
    None,
    /// One that it needs.
    Needed,
    /// One that was said without need: a share of all.
    Given,
}

impl Part {
    /// What an action takes of a category in a sentence that speaks of `spoken`.
    #[must_use]
    pub fn of(action: &Action, spoken: CategorySet, category: Category) -> Self {
        let q = category.index();
        if action.signature.compulsory.contains(q) {
            Self::Needed
        } else if action.signature.voluntary.contains(q) && spoken.contains(q) {
            Self::Given
        } else {
            Self::None
        }
    }
}

/// One way to take a kind of thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// An action that takes it so.
    action: u8,
    /// Whether it was said without need.
    given: bool,
    /// The best fit of all things, in 255ths.
    best: u8,
}

impl Row {
    /// Of no action.
    pub const NONE: Self = Self {
        action: 0,
        given: false,
        best: 0,
    };

    /// What of an intent's kind of thing its actions take.
    #[must_use]
    #[inline(always)]
    pub fn part(&self) -> Part {
        if self.given {
            Part::Given
        } else {
            Part::Needed
        }
    }
}

/// How well the things of one kind fit.
#[derive(Clone, Copy)]
pub struct Kind<'a> {
    /// The rows in use.
    pub rows: &'a [Row],
    /// How well every live option fits, in 255ths, row after row.
    pub bytes: &'a [u8],
}

impl Kind<'_> {
    /// The rows with their fits, of which each has room for `stride`.
    #[inline(always)]
    pub(super) fn iter(&self, stride: usize) -> impl Iterator<Item = (&Row, &[u8])> {
        let mut bytes = self.bytes;
        self.rows.iter().map_while(move |row| {
            let (fits, rest) = bytes.split_at_checked(stride)?;
            bytes = rest;
            Some((row, fits))
        })
    }
}

/// How well things fit actions.
#[derive(Clone, Copy)]
pub struct Fits<'a> {
    /// Objects, then storages.
    pub kinds: [Kind<'a>; 2],
    /// Which row every action has, for its object and its storage; [`NO_ROW`] when it takes none.
    pub of: &'a [[u8; 2]],
    /// Options that a row has room for.
    pub stride: usize,
}

impl<'a> Fits<'a> {
    /// What an action takes of a kind of thing (objects 0, storages 1), and how well each live option
    /// fits.
    #[must_use]
    #[inline(always)]
    pub fn of(&self, action: usize, kind: usize) -> (Part, &'a [u8]) {
        let row = self.of.get(action).and_then(|of| of.get(kind));
        let found = row.zip(self.kinds.get(kind)).and_then(|(&row, kind)| {
            let row = usize::from(row);
            let part = kind.rows.get(row)?.part();
            Some((part, kind.bytes.get(row.wrapping_mul(self.stride)..)?))
        });
        found.unwrap_or((Part::None, &[]))
    }
}

/// The rows of one kind of thing, being made.
pub struct Rows<'a> {
    /// Objects or storages.
    pub category: Category,
    /// All of them that are there, by option.
    pub things: &'a [Thing<'a>],
    /// Room for as many rows as there are actions.
    pub rows: &'a mut [Row],
    /// How many are in use.
    pub used: usize,
    /// How well every thing fits, in 255ths, row after row.
    pub bytes: &'a mut [u8],
    /// Things that a row has room for.
    pub stride: usize,
    /// Which of the things some action of these rows can be done to.
    pub usable: &'a mut [bool],
}

impl Rows<'_> {
    /// The row of an action that takes such a thing, and the best fit in it. A new one is made when no
    /// action before took one alike.
    #[inline(always)]
    pub fn find(&mut self, actions: &[Action], a: usize, part: Part) -> (u8, u8) {
        let given = part == Part::Given;
        let requirement = |a: usize| Some(actions.get(a)?.requirement(self.category));
        let wanted = requirement(a);
        for (row, at) in self.rows.iter().take(self.used).zip(0_u8..) {
            if row.given == given && requirement(usize::from(row.action)) == wanted {
                return (at, row.best);
            }
        }
        let at = self.used;
        let best = wanted.map_or(0, |wanted| self.fill(at, wanted));
        if let Some(row) = self.rows.get_mut(at) {
            *row = Row {
                action: a as u8,
                given,
                best,
            };
        }
        self.used = at.saturating_add(1);
        (at as u8, best)
    }

    /// Finds how well every thing fits a row; gives the best fit.
    #[inline(never)]
    fn fill(&mut self, at: usize, requirement: Requirement) -> u8 {
        let mut best = 0;
        let fits = self.bytes.get_mut(at.wrapping_mul(self.stride)..);
        let places = fits.unwrap_or_default().iter_mut().zip(&mut *self.usable);
        for (thing, (place, usable)) in self.things.iter().zip(places) {
            let fit = (product(requirement, thing.features) * WHOLE + 0.5) as u32 as u8;
            *usable |= fit > 0;
            *place = fit;
            best = best.max(fit);
        }
        best
    }

    /// Lists the things that some action can be done to, and leaves no others in the rows. Gives how
    /// many there are.
    #[inline(never)]
    pub fn close(&mut self, live: &mut [u8]) -> usize {
        let mut count = 0_usize;
        let things = self.things.iter().zip(&*self.usable);
        for (at, (thing, usable)) in things.enumerate() {
            if !*usable {
                continue;
            }
            if let Some(place) = live.get_mut(count) {
                *place = thing.option;
            }
            if at != count {
                let mut row = self.bytes.get_mut(..).unwrap_or_default();
                for _ in 0..self.used {
                    let fit = row.get(at).copied();
                    if let Some((place, fit)) = row.get_mut(count).zip(fit) {
                        *place = fit;
                    }
                    row = row.get_mut(self.stride..).unwrap_or_default();
                }
            }
            count = count.saturating_add(1);
        }
        count
    }
}
