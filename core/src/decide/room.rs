//! All that a decision looks at, and the intent that it finds there.

use heapless::Vec;

use crate::category::Category;
use crate::intent::{Intent, Parameter};
use crate::profile::Profile;
use crate::scene::Scene;
use crate::trace::{CategoryTrace, Trace};
use crate::vocabulary::Vocabulary;

/// All that a decision looks at.
pub(super) struct Room<'a, const N: usize, const C: usize, const F: usize, const E: usize> {
    pub(super) vocabulary: &'a Vocabulary<N, C, F>,
    pub(super) scene: &'a Scene<E, F>,
    pub(super) profile: &'a Profile,
    pub(super) trace: &'a Trace<C, N>,
}

impl<const N: usize, const C: usize, const F: usize, const E: usize> Room<'_, N, C, F, E> {
    pub(super) fn word(&self, category: usize) -> Option<&CategoryTrace<N>> {
        self.trace.categories().get(category)
    }

    pub(super) fn action(&self) -> &CategoryTrace<N> {
        const { assert!(C > 0, "the action is a category") };
        let [first, ..] = self.trace.categories() else {
            return &CategoryTrace::NONE;
        };
        first
    }

    /// The action with the best option of every category of its signature that was expressed.
    pub(super) fn intent(&self, action: u8) -> Intent<C> {
        let mut intent = Intent {
            action,
            parameters: Vec::new(),
        };
        self.complete(&mut intent);
        intent
    }

    /// Adds an action's parameters to an intent without any. Apart, so that [`Room::intent`] has
    /// nothing to move.
    #[inline(never)]
    fn complete(&self, intent: &mut Intent<C>) {
        let Some(known) = self.vocabulary.actions().get(usize::from(intent.action)) else {
            return;
        };
        let expressed = known.signature.compulsory.union(known.signature.voluntary);
        for q in expressed.iter() {
            let (Some(word), Some(category)) = (self.word(q), Category::from_index(q)) else {
                continue;
            };
            if let Some(option) = word.judgement.best {
                let quantity = word.quantity;
                // At most one parameter per category, and there are C categories.
                let _ = intent.parameters.push(Parameter {
                    category,
                    option,
                    quantity,
                });
            }
        }
    }
}
