//! Categories of words (the paper, Problem formulation: `C_a`, `C_o`, `C_s`, `C_d`, ...) and sets of
//! them.

use serde::{Deserialize, Serialize};

/// The kind of thing a word names. Seven are fixed, users number their own from
/// [`Category::user`]`(0)` on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Category(u8);

impl Category {
    /// The target action.
    pub const ACTION: Self = Self(0);
    /// The object to be manipulated.
    pub const OBJECT: Self = Self(1);
    /// Where the object goes: a container, a zone, another object.
    pub const STORAGE: Self = Self(2);
    /// A distance, in metres.
    pub const DISTANCE: Self = Self(3);
    /// A direction of movement.
    pub const DIRECTION: Self = Self(4);
    /// An angle, in radians.
    pub const ANGLE: Self = Self(5);
    /// A number of things or a quantity.
    pub const AMOUNT: Self = Self(6);

    /// How many categories a [`CategorySet`] can tell apart.
    pub const LIMIT: usize = 32;

    /// The `n`-th category of the user's own, counted from 0; `None` above 24, where sets end.
    #[must_use]
    pub const fn user(n: u8) -> Option<Self> {
        Self::from_index(n.saturating_add(7) as usize)
    }

    /// The category with this index into a vocabulary's list of categories.
    #[must_use]
    pub const fn from_index(index: usize) -> Option<Self> {
        if index < Self::LIMIT {
            Some(Self(index as u8))
        } else {
            None
        }
    }

    /// Its index into a vocabulary's list of categories.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// Whether its options are things of the scene, so that feature requirements apply to them.
    #[must_use]
    pub const fn is_entity(self) -> bool {
        matches!(self, Self::OBJECT | Self::STORAGE)
    }
}

/// A set of at most 32 small numbers in one word: categories of a signature, features of a
/// requirement.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct BitSet(pub u32);

impl BitSet {
    /// The empty set.
    pub const EMPTY: Self = Self(0);

    /// This set and `member`; a member of 32 or more is ignored, which [`BitSet::fits`] of a set's
    /// user makes visible.
    #[must_use]
    pub const fn with(self, member: usize) -> Self {
        match 1_u32.checked_shl(member as u32) {
            Some(bit) => Self(self.0 | bit),
            None => self,
        }
    }

    /// Whether `member` is in the set.
    #[must_use]
    pub const fn contains(self, member: usize) -> bool {
        match 1_u32.checked_shl(member as u32) {
            Some(bit) => self.0 & bit != 0,
            None => false,
        }
    }

    /// Whether the set is empty.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Members of either set.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Members of both sets.
    #[must_use]
    pub const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Whether every member is below `count`.
    #[must_use]
    pub const fn fits(self, count: usize) -> bool {
        match self.0.checked_shr(count as u32) {
            Some(rest) => rest == 0,
            None => true,
        }
    }

    /// The members, smallest first.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        let mut rest = self.0;
        core::iter::from_fn(move || {
            if rest == 0 {
                return None;
            }
            let member = rest.trailing_zeros() as usize;
            rest &= rest.wrapping_sub(1);
            Some(member)
        })
    }
}

/// A set of categories.
pub type CategorySet = BitSet;
/// A set of features.
pub type FeatureSet = BitSet;

impl FromIterator<Category> for CategorySet {
    fn from_iter<T: IntoIterator<Item = Category>>(iter: T) -> Self {
        iter.into_iter()
            .fold(Self::EMPTY, |set, category| set.with(category.index()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_keeps_what_it_is_given() {
        let set = BitSet::EMPTY
            .with(0)
            .with(5)
            .with(31)
            .with(32)
            .with(usize::MAX);
        assert_eq!(set.iter().collect::<std::vec::Vec<_>>(), [0, 5, 31]);
        assert!(set.contains(5) && !set.contains(4) && !set.contains(32));
        assert!(set.fits(32) && !set.fits(31) && BitSet::EMPTY.fits(0));
    }

    #[test]
    fn user_categories_follow_the_seven_fixed_ones() {
        assert_eq!(Category::user(0).map(Category::index), Some(7));
        assert_eq!(Category::user(24).map(Category::index), Some(31));
        assert_eq!(Category::user(25), None);
    }
}
