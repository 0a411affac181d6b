//! Which words of different modalities speak of the same thing.
//!
//! The paper assumes synchronised sentences, so that the i-th words correspond. As each category
//! occurs at most once in an action (Problem formulation), words of one category correspond whatever
//! their place, which gives the same pairs for synchronised sentences and right ones for others.

use crate::category::Category;
use crate::sentence::{Observations, Sentence, Word};

/// The word of `sentence` that speaks of `category`: the one most likely to belong to it, the later
/// among equals, as people correct themselves forwards. Absent words do not count.
#[must_use]
pub fn word_of<const W: usize, const C: usize, const N: usize>(
    sentence: &Sentence<W, C, N>,
    category: Category,
) -> Option<&Word<C, N>> {
    let mut best = None;
    let mut top = 0.0;
    for word in sentence.words() {
        let p = probability(word, category);
        if p >= top && word.category() == Some(category) && word.is_present() {
            top = p;
            best = Some(word);
        }
    }
    best
}

/// p(`category` is in the merged sentence): the largest p(C(w) = C^q) over all present words. Words
/// of different modalities are about the same thing, so their probabilities do not add up.
#[must_use]
pub fn presence<const W: usize, const C: usize, const N: usize>(
    observations: &Observations<W, C, N>,
    category: Category,
) -> f32 {
    observations
        .iter()
        .flat_map(Sentence::words)
        .filter(|word| word.is_present())
        .fold(0.0, |p, word| f32::max(p, probability(word, category)))
}

fn probability<const C: usize, const N: usize>(word: &Word<C, N>, category: Category) -> f32 {
    word.categories()
        .get(category.index())
        .copied()
        .unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    type W = Word<4, 2>;

    fn sentence(modality: u8, words: &[W]) -> Sentence<4, 4, 2> {
        let mut s = Sentence::new(modality);
        for w in words {
            s.push(w.clone()).unwrap();
        }
        s
    }

    #[test]
    fn the_most_probable_word_speaks_the_later_among_equals() {
        let unsure = W::new(&[0.1, 0.6, 0.3], &[1.0, 0.0]).unwrap();
        let sure = W::certain(Category::OBJECT, &[0.0, 1.0]).unwrap();
        let s = sentence(0, &[sure.clone(), unsure.clone()]);
        assert_eq!(word_of(&s, Category::OBJECT), Some(&sure));
        let corrected = W::certain(Category::OBJECT, &[0.5, 0.5]).unwrap();
        let s = sentence(0, &[sure, corrected.clone(), unsure, W::ABSENT]);
        assert_eq!(word_of(&s, Category::OBJECT), Some(&corrected));
        assert_eq!(word_of(&s, Category::STORAGE), None);
    }

    #[test]
    fn presence_is_the_largest_probability_of_a_present_word() {
        let mut o = Observations::new();
        o.insert(sentence(
            0,
            &[W::new(&[0.0, 0.7, 0.3], &[1.0, 0.0]).unwrap()],
        ))
        .unwrap();
        o.insert(sentence(
            1,
            &[W::new(&[0.0, 0.6, 0.4], &[0.0, 1.0]).unwrap()],
        ))
        .unwrap();
        o.insert(sentence(
            2,
            &[W::certain(Category::ACTION, &[0.0, 1e-4]).unwrap()],
        ))
        .unwrap();
        assert_eq!(presence(&o, Category::OBJECT), 0.7);
        assert_eq!(presence(&o, Category::STORAGE), 0.4);
        assert_eq!(presence(&o, Category::ACTION), 0.0);
    }
}
