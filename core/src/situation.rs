//! What a decision is made on.

use crate::joint::sensors::Tables;
use crate::observations::Observations;
use crate::scene::Scene;
use crate::vocabulary::Vocabulary;

/// All that one decision looks at, besides the profile.
#[derive(Clone, Copy)]
pub struct Situation<
    'a,
    const N: usize,
    const C: usize,
    const F: usize,
    const E: usize,
    const W: usize,
> {
    /// What can be said.
    pub vocabulary: &'a Vocabulary<N, C, F>,
    /// What is there.
    pub scene: &'a Scene<E, F>,
    /// What was said and shown.
    pub observations: &'a Observations<W, C, N>,
    /// What the sensors report of each option, where that is known; the joint model goes by it.
    pub sensors: Tables<'a>,
}
