//! One likelihood of a word, and what it costs to be explained in one way or another.

use super::cost::{Bar, Costs};
use super::tables::LINES;

/// A likelihood as it was reported.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// In 255ths.
    at: u8,
    /// Whether it is 0 or 1, where clipping gathers all that lies beyond: such errors cost others than
    /// those that lie between.
    end: bool,
}

impl Seen {
    /// Reads a likelihood in 0..=1.
    #[inline(always)]
    pub fn new(likelihood: f32) -> Self {
        let at = (likelihood * 255.0 + 0.5) as u32 as u8;
        Self {
            at,
            end: at.wrapping_add(1) < 2,
        }
    }

    /// Its place among 8 words of 32 bits, and its bit there.
    #[inline(always)]
    pub fn place(self) -> (usize, u32) {
        let bit = 1_u32.wrapping_shl(u32::from(self.at));
        (usize::from(self.at.wrapping_shr(5)), bit)
    }

    /// What it costs when this was to be reported.
    #[inline(always)]
    pub fn cost(self, expected: u8) -> Costs {
        let error = usize::from(self.at.abs_diff(expected));
        let place = usize::from(self.end).wrapping_shl(8) | error;
        // There is a place for every error.
        let cost = LINES.as_flattened().get(place);
        cost.copied().unwrap_or(Costs::ZERO)
    }
}

/// An element of a word, ready to be explained by any option of a sensor's table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// What was reported.
    pub seen: Seen,
    /// What it costs when it is named itself.
    pub own: Costs,
    /// What it costs when another is named: as a scattered rival, and of a flat sensor as what that
    /// reports of all others, whichever is less.
    pub other: Bar,
    /// The same of an action whose signature is raised, when one of another is named; of a sensor
    /// that is not flat without what it costs not to be raised.
    pub raised: Bar,
}

impl Element {
    /// Of no word.
    pub const NONE: Self = Self {
        seen: Seen { at: 0, end: false },
        own: Costs::ZERO,
        other: Bar::ZERO,
        raised: Bar::ZERO,
    };

    /// Whether it was not left out ([`super::rivals::leave_out`]).
    #[inline(always)]
    pub fn counts(&self) -> bool {
        self.other != Bar::ZERO
    }
}
