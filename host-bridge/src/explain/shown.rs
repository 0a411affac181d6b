//! A sentence of likelihoods, as one would type it.

use deictic_core::large::{Sentence, Word};
use deictic_core::math;

use crate::vocabulary::Lexicon;

/// An option this much less likely than the best is not worth a word.
const ASIDE: f32 = 0.2;

/// A sentence's words, each with its likeliest options: `put-into cup|cube drawer`.
#[must_use]
pub fn sentence(sentence: &Sentence, lexicon: &Lexicon) -> String {
    let words = sentence.words().iter().filter_map(|w| word(w, lexicon));
    words.collect::<Vec<_>>().join(" ")
}

fn word(word: &Word, lexicon: &Lexicon) -> Option<String> {
    let category = word.category()?;
    let best = *word.likelihoods().get(math::argmax(word.likelihoods())?)?;
    let mut options: Vec<(f32, u8)> = word.likelihoods().iter().copied().zip(0..).collect();
    options.retain(|(p, _)| *p > 0.0 && *p >= ASIDE * best);
    options.sort_by(|a, b| b.0.total_cmp(&a.0));
    let names = options
        .iter()
        .map(|(_, o)| lexicon.option_name(category, *o));
    Some(names.collect::<Vec<_>>().join("|"))
}
