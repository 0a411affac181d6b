//! What can be said and shown: categories, their options, and what every action needs (the paper,
//! Problem formulation: action parameters and object features).
//!
//! The core knows numbers only. Names live on the host; [`Vocabulary::fingerprint`] is the host's
//! hash over them, so that both sides can tell that they mean the same words.

mod action;
mod check;
mod error;

use heapless::Vec;

use crate::category::Category;
use check::saturate;

pub use action::{Action, Requirement, Signature};
pub use error::VocabularyError;

/// All words of one installation, without their names.
///
/// `N` options per category at most (actions too), `C` categories, `F` features; no more than 64
/// options whatever `N`, as sets of options are 64 bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Vocabulary<const N: usize, const C: usize, const F: usize> {
    actions: Vec<Action, N>,
    options: Vec<u8, C>,
    features: u8,
    stop: Option<u8>,
    fingerprint: u32,
}

impl<const N: usize, const C: usize, const F: usize> Default for Vocabulary<N, C, F> {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl<const N: usize, const C: usize, const F: usize> Vocabulary<N, C, F> {
    /// The vocabulary of a unit that was not told one: every sentence is refused.
    pub const EMPTY: Self = Self {
        actions: Vec::new(),
        options: Vec::new(),
        features: 0,
        stop: None,
        fingerprint: 0,
    };

    const OPTIONS: usize = if N < 64 { N } else { 64 };

    /// A checked vocabulary.
    ///
    /// `parameters[i]` is the number of options of category `i + 1` (objects first): 0 when the
    /// vocabulary has no such category, 1 for one that carries a quantity only. `stop` is the
    /// action that beats everything, `fingerprint` the host's hash over all names.
    ///
    /// # Errors
    /// [`VocabularyError`] for what does not fit or contradicts itself, with its place.
    pub fn new(
        actions: &[Action],
        parameters: &[u8],
        features: u8,
        stop: Option<u8>,
        fingerprint: u32,
    ) -> Result<Self, VocabularyError> {
        let mut vocabulary = Self::EMPTY;
        vocabulary.set(actions, parameters, features, stop, fingerprint)?;
        Ok(vocabulary)
    }

    /// Becomes the vocabulary that [`Vocabulary::new`] makes of the same, in place.
    ///
    /// # Errors
    /// Those of [`Vocabulary::new`]; it is then as it was.
    pub fn set(
        &mut self,
        actions: &[Action],
        parameters: &[u8],
        features: u8,
        stop: Option<u8>,
        fingerprint: u32,
    ) -> Result<(), VocabularyError> {
        let too_many_actions = VocabularyError::TooManyActions {
            capacity: saturate(Self::OPTIONS),
        };
        let too_many = VocabularyError::TooManyCategories {
            capacity: saturate(C.min(Category::LIMIT)),
        };
        if actions.is_empty() {
            return Err(VocabularyError::NoActions);
        }
        if actions.len() > Self::OPTIONS {
            return Err(too_many_actions);
        }
        for (&count, q) in parameters.iter().zip(1..) {
            let category = Category::from_index(q).ok_or(too_many)?;
            if usize::from(count) > Self::OPTIONS {
                return Err(VocabularyError::TooManyOptions {
                    category,
                    capacity: saturate(Self::OPTIONS),
                });
            }
        }
        if parameters.len() >= C {
            return Err(too_many);
        }
        if usize::from(features) > F.min(32) {
            return Err(VocabularyError::TooManyFeatures {
                capacity: saturate(F.min(32)),
            });
        }
        check::actions(actions, parameters, features, stop)?;
        self.clear();
        self.actions
            .extend_from_slice(actions)
            .map_err(|_| too_many_actions)?;
        self.options
            .push(saturate(actions.len()))
            .map_err(|_| too_many)?;
        self.options
            .extend_from_slice(parameters)
            .map_err(|_| too_many)?;
        self.features = features;
        self.stop = stop;
        self.fingerprint = fingerprint;
        Ok(())
    }

    /// Becomes [`Vocabulary::EMPTY`], in place.
    pub fn clear(&mut self) {
        self.actions.clear();
        self.options.clear();
        self.features = 0;
        self.stop = None;
        self.fingerprint = 0;
    }

    /// The actions, in the order of an action word's likelihoods.
    #[must_use]
    pub fn actions(&self) -> &[Action] {
        &self.actions
    }

    /// The number of options of every category, actions first.
    #[must_use]
    pub fn options(&self) -> &[u8] {
        &self.options
    }

    /// How many options this category has; 0 for one that the vocabulary does not have.
    #[must_use]
    pub fn options_of(&self, category: Category) -> usize {
        self.options
            .get(category.index())
            .map_or(0, |&n| usize::from(n))
    }

    /// How many features a thing of the scene has.
    #[must_use]
    pub fn features(&self) -> usize {
        usize::from(self.features)
    }

    /// The action that beats everything, if there is one.
    #[must_use]
    pub fn stop(&self) -> Option<u8> {
        self.stop
    }

    /// The host's hash over all names.
    #[must_use]
    pub fn fingerprint(&self) -> u32 {
        self.fingerprint
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::category::{BitSet, CategorySet};

    type Small = Vocabulary<4, 4, 8>;

    /// Is done to an object with the second feature and without the first.
    pub(super) fn pick() -> Action {
        Action {
            signature: Signature {
                compulsory: [Category::OBJECT].into_iter().collect(),
                voluntary: CategorySet::EMPTY,
            },
            object: Requirement {
                wanted: BitSet(0b10),
                unwanted: BitSet(0b01),
            },
            storage: Requirement::default(),
        }
    }

    #[test]
    fn a_good_vocabulary_is_kept_as_given() {
        let v = Small::new(&[Action::default(), pick()], &[3, 2], 2, Some(0), 7).unwrap();
        assert_eq!(v.options(), [2, 3, 2]);
        assert_eq!((v.features(), v.stop(), v.fingerprint()), (2, Some(0), 7));
        assert_eq!(v.options_of(Category::DISTANCE), 0);
    }

    #[test]
    fn what_does_not_fit_is_refused_by_name() {
        let many = [Action::default(); 5];
        assert_eq!(
            Small::new(&[], &[], 0, None, 0),
            Err(VocabularyError::NoActions)
        );
        assert_eq!(
            Small::new(&many, &[], 0, None, 0),
            Err(VocabularyError::TooManyActions { capacity: 4 })
        );
        assert_eq!(
            Small::new(&[pick()], &[5], 2, None, 0),
            Err(VocabularyError::TooManyOptions {
                category: Category::OBJECT,
                capacity: 4
            })
        );
        assert_eq!(
            Small::new(&[pick()], &[1, 1, 1, 1], 2, None, 0),
            Err(VocabularyError::TooManyCategories { capacity: 4 })
        );
        assert_eq!(
            Small::new(&[pick()], &[1], 9, None, 0),
            Err(VocabularyError::TooManyFeatures { capacity: 8 })
        );
    }
}
