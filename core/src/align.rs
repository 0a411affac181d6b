//! Which words of different modalities speak of the same thing.
//!
//! The paper assumes synchronised sentences, so that the i-th words correspond. As each category
//! occurs at most once in an action (Problem formulation), words of one category correspond whatever
//! their place, which gives the same pairs for synchronised sentences and right ones for others.

use crate::category::Category;
use crate::math::larger;
use crate::observations::Observations;
use crate::sentence::{MODALITIES, Word};

/// The words that speak of one category, by modality.
pub type Slot<'a, const C: usize, const N: usize> = [Option<&'a Word<C, N>>; MODALITIES];

/// The words of all sentences by category and modality.
pub struct Alignment<'a, const C: usize, const N: usize> {
    slots: [Slot<'a, C, N>; C],
    present: [f32; C],
}

impl<'a, const C: usize, const N: usize> Alignment<'a, C, N> {
    /// Aligns what was observed. Of several words of one modality that speak of a category it is the
    /// one most likely to belong to it, the later among equals, as people correct themselves
    /// forwards. Absent words do not count.
    #[must_use]
    pub fn of<const W: usize>(observations: &'a Observations<W, C, N>) -> Self {
        let mut aligned = Self::NONE;
        aligned.fill(observations);
        aligned
    }

    /// Nothing observed.
    pub(crate) const NONE: Self = Self {
        slots: [[None; MODALITIES]; C],
        present: [0.0; C],
    };

    /// Adds what was observed to nothing: [`Alignment::of`] without moving 160 bytes.
    #[inline(never)]
    pub(crate) fn fill<const W: usize>(&mut self, observations: &'a Observations<W, C, N>) {
        for sentence in observations.iter() {
            let modality = usize::from(sentence.modality());
            let mut tops = [0.0; C];
            for word in sentence.words().iter().filter(|word| word.is_present()) {
                let Some((q, p)) = note(&mut self.present, word.categories()) else {
                    continue;
                };
                let (Some(slot), Some(top)) = (self.slots.get_mut(q), tops.get_mut(q)) else {
                    continue;
                };
                if p >= *top
                    && let Some(place) = slot.get_mut(modality)
                {
                    *top = p;
                    *place = Some(word);
                }
            }
        }
    }

    /// The words that speak of this category, by modality.
    #[must_use]
    pub fn slot(&self, category: Category) -> Slot<'a, C, N> {
        self.slots
            .get(category.index())
            .copied()
            .unwrap_or_default()
    }

    /// p(`category` is in the merged sentence): the largest p(C(w) = C^q) over all present words.
    /// Words of different modalities are about the same thing, so their probabilities do not add up.
    #[must_use]
    pub fn presence(&self, category: Category) -> f32 {
        self.present.get(category.index()).copied().unwrap_or(0.0)
    }
}

/// Notes that a word of these category probabilities is present; gives its likeliest category, the
/// first among equals, and that one's probability.
#[inline(never)]
fn note(present: &mut [f32], categories: &[f32]) -> Option<(usize, f32)> {
    let mut likeliest = None;
    let mut top = f32::NEG_INFINITY;
    for (q, (present, &p)) in present.iter_mut().zip(categories).enumerate() {
        *present = larger(*present, p);
        if p > top {
            top = p;
            likeliest = Some((q, p));
        }
    }
    likeliest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sentence::Sentence;
    use crate::vocabulary::{Action, Vocabulary};

    type W = Word<4, 2>;

    fn observed(sentences: &[&[W]]) -> Observations<4, 4, 2> {
        let v: Vocabulary<2, 4, 1> =
            Vocabulary::new(&[Action::default(); 2], &[2, 2], 0, None, 0).unwrap();
        let mut o = Observations::new();
        for (m, words) in sentences.iter().enumerate() {
            let mut s = Sentence::new(m as u8);
            for w in *words {
                s.push(w.clone()).unwrap();
            }
            o.insert(s, &v).unwrap();
        }
        o
    }

    #[test]
    fn the_most_probable_word_speaks_the_later_among_equals() {
        let unsure = W::new(&[0.1, 0.6, 0.3], &[1.0, 0.0]).unwrap();
        let sure = W::certain(Category::OBJECT, &[0.0, 1.0]).unwrap();
        let corrected = W::certain(Category::OBJECT, &[0.5, 0.5]).unwrap();
        let o = observed(&[
            &[sure.clone(), unsure.clone()],
            &[sure.clone(), corrected.clone(), unsure, W::ABSENT],
        ]);
        let aligned = Alignment::of(&o);
        assert_eq!(
            aligned.slot(Category::OBJECT),
            [Some(&sure), Some(&corrected), None, None]
        );
        assert_eq!(aligned.slot(Category::STORAGE), [None; MODALITIES]);
    }

    #[test]
    fn presence_is_the_largest_probability_of_a_present_word() {
        let o = observed(&[
            &[W::new(&[0.0, 0.7, 0.3], &[1.0, 0.0]).unwrap()],
            &[W::new(&[0.0, 0.6, 0.4], &[0.0, 1.0]).unwrap()],
            &[W::certain(Category::ACTION, &[0.0, 1e-4]).unwrap()],
        ]);
        let aligned = Alignment::of(&o);
        assert_eq!(aligned.presence(Category::OBJECT), 0.7);
        assert_eq!(aligned.presence(Category::STORAGE), 0.4);
        assert_eq!(aligned.presence(Category::ACTION), 0.0);
    }
}
