//! What the core made of one category, read from its trace in the reference's terms.

use deictic_core::board;
use deictic_core::category::Category;
use deictic_core::profile::Profile;

/// The reference's two answers for one category, as the core's options.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The option that may be acted upon: clear, and ahead of the next.
    pub decided: Option<u8>,
    /// The likeliest option, clear or not; `None` when the word is absent.
    pub likeliest: Option<u8>,
}

/// Reads one category.
#[must_use]
pub fn choice(trace: &board::Trace, category: usize, profile: &Profile) -> Choice {
    let judgement = Category::from_index(category)
        .and_then(|c| trace.category(c))
        .map(|word| word.judgement);
    Choice {
        decided: judgement.and_then(|j| j.decided(profile.lead)),
        likeliest: judgement.and_then(|j| j.best),
    }
}
