//! What the scene allows: which actions are weighed, and how well things fit them.

use super::fit::{KINDS, product};
use crate::category::{Category, CategorySet};
use crate::vocabulary::{Action, Requirement};

/// How far the words' presence may contradict an action's signature, beside the action that it fits
/// best, before the action is not weighed at all: a word out of place, in nearly every modality.
const PRUNED: u16 = 520;

/// A likelihood of 1 in a fit.
pub const WHOLE: f32 = 255.0;

/// A thing on the table.
#[derive(Clone, Copy)]
pub struct Thing<'a> {
    /// Object or storage.
    pub category: Category,
    /// Which of them.
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

/// One way to take a kind of thing, which actions share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// Objects (0) or storages (1).
    kind: u8,
    part: Part,
    /// An action that takes it so.
    action: u8,
    /// The best fit of all things, in 255ths.
    best: u8,
}

impl Row {
    /// Of no action.
    pub const NONE: Self = Self {
        kind: 0,
        part: Part::None,
        action: 0,
        best: 0,
    };

    /// Objects (0) or storages (1), and whether it is needed.
    #[must_use]
    #[inline(always)]
    pub fn kind(&self) -> (usize, Part) {
        (usize::from(self.kind), self.part)
    }
}

/// How well things fit actions.
#[derive(Clone, Copy)]
pub struct Fits<'a> {
    /// The rows in use.
    pub rows: &'a [Row],
    /// Which of them every action has, for its object and its storage.
    pub of: &'a [[u8; 2]],
    /// How well every option fits, in 255ths, row after row; what is not there does not fit.
    pub bytes: &'a [u8],
    /// Options that a row has room for.
    pub stride: usize,
}

impl<'a> Fits<'a> {
    /// What an action takes of a kind of thing (objects 0, storages 1), and how well each option fits.
    #[must_use]
    #[inline(always)]
    pub fn of(&self, action: usize, kind: usize) -> (Part, &'a [u8]) {
        let of = self.of.get(action).and_then(|of| of.get(kind));
        let row = of.map_or(usize::MAX, |row| usize::from(*row));
        let part = self.rows.get(row).map_or(Part::None, |row| row.part);
        (part, self.row(row))
    }

    /// How well each option fits a row.
    #[must_use]
    #[inline(always)]
    pub fn row(&self, row: usize) -> &'a [u8] {
        let start = row.wrapping_mul(self.stride);
        self.bytes.get(start..).unwrap_or(&[])
    }
}

/// The actions that are examined, and all that is found out about them.
pub struct Survey<'a> {
    /// All actions.
    pub actions: &'a [Action],
    /// What is there.
    pub things: &'a [Thing<'a>],
    /// The categories that some word speaks of.
    pub spoken: CategorySet,
    /// What the words' presence costs every action; beside the best afterwards.
    pub prior: &'a mut [u16],
    /// Room for as many rows as there are actions times kinds.
    pub rows: &'a mut [Row],
    /// See [`Fits::of`]; those of actions that are not examined mean nothing.
    pub of: &'a mut [[u8; 2]],
    /// See [`Fits::bytes`].
    pub bytes: &'a mut [u8],
    /// Options that a row has room for.
    pub stride: usize,
    /// How well the best things fit every action; 0 for those that are not to be weighed.
    pub possible: &'a mut [f32],
    /// The objects and the storages that some of them can be done to.
    pub usable: [&'a mut [bool]; 2],
}

impl Survey<'_> {
    /// Examines actions, likeliest by the words' presence first, until the next is too unlikely
    /// beside the first that can be done. Gives how many rows are in use.
    #[inline(never)]
    pub fn run(&mut self) -> usize {
        for flags in &mut self.usable {
            flags.iter_mut().for_each(|flag| *flag = false);
        }
        let mut used = 0;
        let mut bar = u16::MAX;
        let mut best = None;
        self.possible.iter_mut().for_each(|p| *p = 0.0);
        // Priors above those examined so far, in rising order: few differ.
        let mut next = self.prior.iter().copied().min();
        while let Some(level) = next.filter(|level| *level <= bar) {
            next = None;
            for a in 0..self.actions.len() {
                let Some(&prior) = self.prior.get(a) else {
                    break;
                };
                if prior > level {
                    next = Some(next.map_or(prior, |next: u16| next.min(prior)));
                }
                if prior != level {
                    continue;
                }
                let possible = self.examine(a, &mut used);
                if possible > 0.0 {
                    best = best.or(Some(level));
                    bar = best.unwrap_or(0).saturating_add(PRUNED);
                    if let Some(place) = self.possible.get_mut(a) {
                        *place = possible;
                    }
                }
            }
        }
        let best = best.unwrap_or(0);
        for prior in self.prior.iter_mut() {
            *prior = prior.saturating_sub(best);
        }
        used
    }

    /// How well the best things fit an action.
    fn examine(&mut self, a: usize, used: &mut usize) -> f32 {
        let Some(action) = self.actions.get(a) else {
            return 0.0;
        };
        let mut possible = 1.0;
        for (kind, category) in (0_u8..).zip(KINDS) {
            let part = Part::of(action, self.spoken, category);
            let requirement = action.requirement(category);
            let alike = |row: &Row| {
                let other = self.actions.get(usize::from(row.action));
                row.kind == kind
                    && row.part == part
                    && (part == Part::None
                        || other.is_some_and(|other| other.requirement(category) == requirement))
            };
            let known = self.rows.iter().take(*used).position(alike);
            let at = known.unwrap_or(*used);
            if known.is_none() {
                let best = match part {
                    Part::None => 0,
                    _ => self.fill(at, usize::from(kind), category, requirement),
                };
                if let Some(row) = self.rows.get_mut(at) {
                    *row = Row {
                        kind,
                        part,
                        action: a as u8,
                        best,
                    };
                }
                *used = used.saturating_add(1);
            }
            if let Some(of) = self
                .of
                .get_mut(a)
                .and_then(|of| of.get_mut(usize::from(kind)))
            {
                *of = at as u8;
            }
            if part == Part::Needed {
                let best = self.rows.get(at).map_or(0, |row| row.best);
                possible *= f32::from(best) * (1.0 / WHOLE);
            }
        }
        possible
    }

    /// Finds how well every option fits a row; gives the best fit.
    fn fill(&mut self, at: usize, kind: usize, category: Category, requirement: Requirement) -> u8 {
        let mut best = 0;
        let start = at.wrapping_mul(self.stride);
        let (Some(usable), Some(fits)) = (self.usable.get_mut(kind), self.bytes.get_mut(start..))
        else {
            return best;
        };
        for (fit, _) in fits.iter_mut().zip(&**usable) {
            *fit = 0;
        }
        for thing in self.things.iter().filter(|t| t.category == category) {
            let option = usize::from(thing.option);
            if let (Some(fit), Some(usable)) = (fits.get_mut(option), usable.get_mut(option)) {
                *fit = (product(requirement, thing.features) * WHOLE + 0.5) as u32 as u8;
                *usable |= *fit > 0;
                best = best.max(*fit);
            }
        }
        best
    }
}
