//! The whole method on one set of observations (the paper, Proposed solution): align, merge, check
//! feasibility, decide.
//!
//! On a Cortex-M4F one M3 decision over the paper's vocabulary stays below 12,000 instructions; the
//! golden figures are in `tests/expected/`.

use crate::category::Category;
use crate::decision::Decision;
use crate::entropy;
use crate::joint;
use crate::judgement::judge;
use crate::merge::Mix;
use crate::mixed::mixed;
use crate::profile::{Model, Profile, ProfileError, Threshold};
use crate::sentence::Word;
pub use crate::situation::Situation;
use crate::trace::Trace;

/// Decides with the profile's own mixing operator; see [`fuse_with`].
///
/// # Errors
/// [`ProfileError`] when the profile is not sound; the trace is then empty.
pub fn fuse<const N: usize, const C: usize, const F: usize, const E: usize, const W: usize>(
    situation: Situation<'_, N, C, F, E, W>,
    profile: &Profile,
    trace: &mut Trace<C, N>,
) -> Result<Decision<C>, ProfileError> {
    fuse_with(situation, profile, &profile.merge, trace)
}

/// Decides with any mixing operator, and leaves in `trace` why. The joint model mixes nothing.
///
/// # Errors
/// [`ProfileError`] when the profile is not sound; the trace is then empty.
pub fn fuse_with<const N: usize, const C: usize, const F: usize, const E: usize, const W: usize>(
    situation: Situation<'_, N, C, F, E, W>,
    profile: &Profile,
    mix: &impl Mix,
    trace: &mut Trace<C, N>,
) -> Result<Decision<C>, ProfileError> {
    if profile.model == Model::Joint {
        return joint::fuse(situation, profile, trace);
    }
    mixed(situation, profile, mix, trace)
}

/// Whether a word alone clearly says one option, with nothing else to draw on: used for `stop`,
/// which does not wait for other modalities.
#[must_use]
pub fn says_clearly<const C: usize, const N: usize>(
    word: &Word<C, N>,
    category: Category,
    option: u8,
    profile: &Profile,
) -> bool {
    if word.category() != Some(category) || !word.is_present() {
        return false;
    }
    let mut p = [0.0; N];
    let mut h = [0.0; N];
    let n = word.likelihoods().len().min(N);
    let (Some((p, _)), Some((h, _))) = (p.split_at_mut_checked(n), h.split_at_mut_checked(n))
    else {
        return false;
    };
    for (to, from) in p.iter_mut().zip(word.likelihoods()) {
        *to = *from;
    }
    entropy::normalise(p);
    let entropy = entropy::diagonal_cross_entropy(p, h);
    let (judgement, _) = judge(p, h, entropy, Threshold::Entropy);
    judgement.clear.count_ones() == 1 && judgement.decided(profile.lead) == Some(option)
}
