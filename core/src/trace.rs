//! Why a decision came out as it did: every intermediate figure, kept for whoever asks.

use crate::category::Category;
use crate::joint::Evidence;
use crate::joint::belief::Belief;
use crate::judgement::Judgement;

/// What one category's merged word says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CategoryTrace<const N: usize> {
    /// Probability that the category is in the merged sentence.
    pub present: f32,
    /// How many options it has; only so many places below are in use.
    pub options: u8,
    /// w^M, the merged word; for actions after alpha and beta. All 0 when the word is absent. With
    /// the joint model the marginal posterior, which has no `entropy`.
    pub merged: [f32; N],
    /// The diagonal cross-entropy of `merged`; 0 with the joint model.
    pub h: [f32; N],
    /// The normalised entropy of `merged`.
    pub entropy: f32,
    /// Against what clarity was judged: t_E on `h`, or t_C on `merged`.
    pub threshold: f32,
    /// The quantity that came with the word.
    pub quantity: Option<f32>,
    /// What is clear, what is not, and what leads.
    pub judgement: Judgement,
}

impl<const N: usize> CategoryTrace<N> {
    pub(crate) const NONE: Self = Self {
        present: 0.0,
        options: 0,
        merged: [0.0; N],
        h: [0.0; N],
        entropy: 0.0,
        threshold: 0.0,
        quantity: None,
        judgement: Judgement::NOTHING,
    };

    /// The merged word, one likelihood per option.
    #[must_use]
    pub fn merged(&self) -> &[f32] {
        self.merged
            .get(..usize::from(self.options))
            .unwrap_or(&self.merged)
    }

    /// Its diagonal cross-entropy, one per option.
    #[must_use]
    pub fn h(&self) -> &[f32] {
        self.h.get(..usize::from(self.options)).unwrap_or(&self.h)
    }

    /// Both at once, to be written.
    pub(crate) fn merged_and_h(&mut self) -> (&mut [f32], &mut [f32]) {
        let n = usize::from(self.options).min(N);
        let (merged, _) = self.merged.split_at_mut_checked(n).unwrap_or_default();
        let (h, _) = self.h.split_at_mut_checked(n).unwrap_or_default();
        (merged, h)
    }
}

/// The intermediate figures of one decision; also its working memory.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace<const C: usize, const N: usize> {
    pub(crate) categories: [CategoryTrace<N>; C],
    /// The merged action word before any penalty.
    pub heard: [f32; N],
    /// alpha of every action (eq. 7); 1 when the model has none.
    pub alpha: [f32; N],
    /// beta of every action (eq. 10); 1 when the model has none.
    pub beta: [f32; N],
    /// What the joint model believed; nothing with the others. Its `alpha` is how likely the words'
    /// presence is beside the best action's, its `beta` how well the best things fit, 0 for actions
    /// that were not weighed.
    pub belief: Belief,
    /// What the joint model heard, to which more can be added.
    pub evidence: Evidence<C, N>,
}

impl<const C: usize, const N: usize> Default for Trace<C, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const C: usize, const N: usize> Trace<C, N> {
    /// The trace of no decision.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            categories: [CategoryTrace::NONE; C],
            heard: [0.0; N],
            alpha: [0.0; N],
            beta: [0.0; N],
            belief: Belief::NONE,
            evidence: Evidence::new(),
        }
    }

    /// Forgets the last decision. Only what it wrote is written again, less than half of the whole.
    pub fn clear(&mut self) {
        self.belief = Belief::NONE;
        let actions = self
            .categories
            .first()
            .map_or(0, |word| usize::from(word.options));
        for figures in [&mut self.heard, &mut self.alpha, &mut self.beta] {
            figures.iter_mut().take(actions).for_each(|x| *x = 0.0);
        }
        for word in self.categories.iter_mut().filter(|word| word.options > 0) {
            *word = CategoryTrace::NONE;
        }
    }

    /// Forgets what a decision over categories of so many options does not write over, the words it
    /// does not speak of aside: nothing at all when the last one was over the same.
    pub(crate) fn restart(&mut self, options: &[u8]) {
        let mut options = options.iter();
        let mut words = self.categories.iter();
        if words.any(|word| word.options != options.next().copied().unwrap_or(0)) {
            self.clear();
        }
    }

    /// All categories, actions first.
    #[must_use]
    pub fn categories(&self) -> &[CategoryTrace<N>] {
        &self.categories
    }

    /// What was made of this category; `None` for one beyond the capacity.
    #[must_use]
    pub fn category(&self, category: Category) -> Option<&CategoryTrace<N>> {
        self.categories.get(category.index())
    }

    /// Whether some word may be of this category.
    pub(crate) fn speaks_of(&self, category: Category) -> bool {
        self.category(category)
            .is_some_and(|word| word.present > 0.0)
    }

    /// The action word and the figures of the actions, to be written.
    #[allow(
        clippy::type_complexity,
        reason = "four parts of one struct, borrowed at once"
    )]
    pub(crate) fn actions_mut(
        &mut self,
    ) -> (
        Option<&mut CategoryTrace<N>>,
        &mut [f32; N],
        &mut [f32; N],
        &mut [f32; N],
    ) {
        (
            self.categories.first_mut(),
            &mut self.heard,
            &mut self.alpha,
            &mut self.beta,
        )
    }

    pub(crate) fn categories_mut(&mut self) -> &mut [CategoryTrace<N>] {
        &mut self.categories
    }
}
