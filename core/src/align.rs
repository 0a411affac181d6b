//! Which words of different modalities speak of the same thing.
//!
//! The paper assumes synchronised sentences, so that the i-th words correspond
//! ([`Align::Position`]). As each category occurs at most once in an action (Problem formulation),
//! words of one category correspond whatever their place ([`Align::Category`]), which gives the same
//! pairs for synchronised sentences and right ones for others: spoken in another order than shown,
//! said twice, or left out.
//!
//! Time counts twice. Sentences of different modalities that are observed together are brought
//! together by the unit ([`crate::unit::pairing`]), and within a sentence, whose words stand in the
//! order in which they were observed, a later word corrects an earlier one that is no surer of its
//! category.

use crate::category::Category;
use crate::math::{argmax, larger};
use crate::observations::Observations;
use crate::profile::Align;
use crate::sentence::{ANSWER, MODALITIES, Word};

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
    pub fn of<const W: usize>(observations: &'a Observations<W, C, N>, align: Align) -> Self {
        let mut aligned = Self::NONE;
        aligned.fill(observations, align);
        aligned
    }

    /// Nothing observed.
    pub(crate) const NONE: Self = Self {
        slots: [[None; MODALITIES]; C],
        present: [0.0; C],
    };

    /// Adds what was observed to nothing: [`Alignment::of`] without moving 160 bytes.
    #[inline(never)]
    pub(crate) fn fill<const W: usize>(
        &mut self,
        observations: &'a Observations<W, C, N>,
        align: Align,
    ) {
        for sentence in observations.iter() {
            let modality = usize::from(sentence.modality());
            let mut tops = [0.0; C];
            for (place, word) in sentence.words().iter().enumerate() {
                if !word.is_present() || !corresponds(observations, align, modality, place) {
                    continue;
                }
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

/// Whether a word speaks of what the words of its place do: by position that is the category with the
/// largest sum of probabilities over all modalities, the first among equals, since likelihoods of
/// different categories' options cannot be merged. Answers were given later, and have no place.
#[inline]
pub(crate) fn corresponds<const W: usize, const C: usize, const N: usize>(
    observations: &Observations<W, C, N>,
    align: Align,
    modality: usize,
    place: usize,
) -> bool {
    align == Align::Category
        || modality == usize::from(ANSWER)
        || stands(observations, modality, place)
}

#[inline(never)]
fn stands<const W: usize, const C: usize, const N: usize>(
    observations: &Observations<W, C, N>,
    modality: usize,
    place: usize,
) -> bool {
    let mut sums = [0.0; C];
    let mut own = None;
    for sentence in observations.iter() {
        if sentence.modality() == ANSWER {
            continue;
        }
        let there = sentence.words().get(place);
        let Some(word) = there.filter(|word| !word.likelihoods().is_empty()) else {
            continue;
        };
        for (sum, p) in sums.iter_mut().zip(word.categories()) {
            *sum += p;
        }
        if usize::from(sentence.modality()) == modality {
            own = word.category();
        }
    }
    own.map(Category::index) == argmax(&sums)
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
        let aligned = Alignment::of(&o, Align::Category);
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
        let aligned = Alignment::of(&o, Align::Category);
        assert_eq!(aligned.presence(Category::OBJECT), 0.7);
        assert_eq!(aligned.presence(Category::STORAGE), 0.4);
        assert_eq!(aligned.presence(Category::ACTION), 0.0);
    }

    #[test]
    fn by_position_only_words_of_one_category_stand_together() {
        let word = |category, likelihoods: [f32; 2]| W::certain(category, &likelihoods).unwrap();
        let (pick, can) = (
            word(Category::ACTION, [1.0, 0.0]),
            word(Category::OBJECT, [1.0, 0.0]),
        );
        let (push, cup) = (
            word(Category::ACTION, [0.0, 1.0]),
            word(Category::OBJECT, [0.0, 1.0]),
        );
        let slots = |o: &Observations<4, 4, 2>, align| {
            let aligned = Alignment::of(o, align);
            [Category::ACTION, Category::OBJECT].map(|q| {
                let [shown, said, ..] = aligned.slot(q);
                [shown.cloned(), said.cloned()]
            })
        };
        let both = [
            [Some(pick.clone()), Some(push.clone())],
            [Some(can.clone()), Some(cup.clone())],
        ];
        let synchronised = observed(&[&[pick.clone(), can.clone()], &[push.clone(), cup.clone()]]);
        let crossed = observed(&[&[pick.clone(), can.clone()], &[cup.clone(), push.clone()]]);
        let gap = observed(&[
            &[pick.clone(), W::ABSENT, can.clone()],
            &[push.clone(), W::ABSENT, cup.clone()],
        ]);
        for o in [&synchronised, &crossed, &gap] {
            assert_eq!(slots(o, Align::Category), both);
        }
        assert_eq!(slots(&synchronised, Align::Position), both);
        assert_eq!(slots(&gap, Align::Position), both);
        // At either place it is the first category among equals that counts.
        assert_eq!(
            slots(&crossed, Align::Position),
            [[Some(pick), Some(push)], [None, None]]
        );
        // Where they do not agree, the surer one does.
        let likely = W::new(&[0.7, 0.3], &[1.0, 0.0]).unwrap();
        let o = observed(&[&[likely], std::slice::from_ref(&cup)]);
        assert_eq!(
            slots(&o, Align::Position),
            [[None, None], [None, Some(cup)]]
        );
    }
}
