//! Habits of the authors' public implementation that the paper does not have, kept apart for
//! [`crate::profile::Profile::reference_quirks`] (METHOD, section 5).

use crate::category::Category;
use crate::merge::Merge;

/// How far a one-hot word is lifted.
const LIFT: f32 = 0.3;

/// Whether exactly one likelihood is 1 and all others are 0.
#[must_use]
pub fn is_one_hot(word: &[f32]) -> bool {
    let ones = word.iter().filter(|&&w| w == 1.0).count();
    let zeros = word.iter().filter(|&&w| w == 0.0).count();
    ones == 1 && zeros.saturating_add(1) == word.len()
}

/// Lifts every likelihood of a one-hot language word for which `lifted` holds, clipped to 1.
pub fn lift(word: &mut [f32], lifted: impl Fn(usize) -> bool) {
    for (i, w) in word.iter_mut().enumerate() {
        if lifted(i) {
            *w = (*w + LIFT).min(1.0);
        }
    }
}

/// Stretches the likelihoods for which `stretched` holds from their own range to 0.3..1: what
/// happens to a gesture's object word beside a one-hot object word of language.
pub fn stretch(word: &mut [f32], stretched: impl Fn(usize) -> bool) {
    let inside = || {
        word.iter()
            .enumerate()
            .filter(|(i, _)| stretched(*i))
            .map(|(_, w)| *w)
    };
    let least = inside().fold(f32::INFINITY, f32::min);
    let range = inside().fold(f32::NEG_INFINITY, f32::max) - least;
    if range <= 0.0 {
        return;
    }
    for (i, w) in word.iter_mut().enumerate() {
        if stretched(i) {
            *w = (*w - least) / range * (1.0 - LIFT) + LIFT;
        }
    }
}

/// Multiplies the merged likelihoods of a product by 1.4 and clips them to 1; objects are spared.
pub fn boost(merged: &mut [f32], category: Category, merge: Merge) {
    if merge == Merge::Mul && category != Category::OBJECT {
        merged.iter_mut().for_each(|w| *w = (1.4 * *w).min(1.0));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_one_hot_words_are_lifted() {
        assert!(is_one_hot(&[0.0, 1.0, 0.0]));
        assert!(!is_one_hot(&[0.0, 1.0, 1.0]));
        assert!(!is_one_hot(&[0.0, 1.0, 0.1]));
        let mut word = [0.0, 1.0, 0.0];
        lift(&mut word, |i| i != 2);
        assert_eq!(word, [0.3, 1.0, 0.0]);
    }

    #[test]
    fn stretching_keeps_the_order_and_leaves_flat_words_alone() {
        let mut word = [0.2, 0.6, 0.4, 0.0];
        stretch(&mut word, |i| i != 3);
        assert!((word[0] - 0.3).abs() < 1e-6 && (word[1] - 1.0).abs() < 1e-6);
        assert!((word[2] - 0.65).abs() < 1e-6 && word[3] == 0.0);
        let mut flat = [0.5; 3];
        stretch(&mut flat, |_| true);
        assert_eq!(flat, [0.5; 3]);
    }

    #[test]
    fn only_products_are_boosted() {
        let mut word = [0.5, 0.9];
        boost(&mut word, Category::OBJECT, Merge::Mul);
        boost(&mut word, Category::ACTION, Merge::Add);
        assert_eq!(word, [0.5, 0.9]);
        boost(&mut word, Category::STORAGE, Merge::Mul);
        assert_eq!(word, [0.7, 1.0]);
    }
}
