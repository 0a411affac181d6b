//! What a posterior is made of: what was heard of the live options, and how well they fit.

use super::LEVELS;
use super::cost::{Costs, MOST};
use super::fits::Fits;

/// What a level may cost beside the best before it is left out, and an action beside the best.
pub(super) const NEGLIGIBLE: u32 = 352;

/// One category's options.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// Those that are weighed, in rising order.
    pub live: &'a [u8],
    /// What each of them costs.
    pub costs: &'a [Costs],
    /// One over their number, 1 when there are none.
    pub per_count: f32,
}

impl<'a> Options<'a> {
    /// Those of `live`, by whose places the costs are.
    #[must_use]
    pub fn new(live: &'a [u8], costs: &'a [Costs]) -> Self {
        let per_count = 1.0 / live.len().max(1) as f32;
        Self {
            live,
            costs: costs.get(..live.len()).unwrap_or(costs),
            per_count,
        }
    }

    /// The least costs of the live options, 0 when there are none.
    #[must_use]
    pub fn least(&self) -> Costs {
        let mut least = Costs::all(if self.live.is_empty() { 0 } else { MOST });
        for costs in self.costs {
            least = least.least(*costs);
        }
        least
    }
}

/// All that the posterior is made of, one factor per category.
pub struct Factors<'a> {
    /// What the actions cost, their words' presence included.
    pub deeds: Options<'a>,
    /// Objects, then storages.
    pub things: [Options<'a>; 2],
    /// How well options fit.
    pub fits: Fits<'a>,
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
