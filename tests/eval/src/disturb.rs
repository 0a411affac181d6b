//! Sentences that are out of step: what aligning words by category is for, and by position not.
//!
//! In step, every modality's words stand in the order of the categories, and one that is not there
//! keeps its place, as the paper has it. Everything else happens to each sentence on its own.

use clap::ValueEnum;
use deictic_core::board::Word;
use deictic_core::category::Category;
use deictic_core::sentence::SentenceError;
use rand::seq::{IndexedRandom, SliceRandom};
use rand::{Rng, RngExt};
use serde::Serialize;

use crate::catalogue::Catalogue;
use crate::maker::Maker;
use crate::order::Order;
use crate::record::{CATEGORIES, Record, Words};

/// What happens to the sentences of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Disturbance {
    /// Nothing.
    InStep,
    /// Their words come in any order.
    Shuffled,
    /// One word of one of them is not observed, and those behind it move up.
    Dropped,
    /// One word of each is observed twice, with errors of its own, the second time anywhere later.
    Repeated,
    /// One word of each first names something else, and is put right at once.
    Corrected,
    /// What one word of each is about is not sure: its own category has a probability of 0.6, the
    /// others share the rest.
    Unsure,
    /// All of these, but for the correction, one after the other.
    All,
}

/// How sure a category is that is not sure.
const UNSURE: f32 = 0.6;

/// A word before it is the core's.
#[derive(Clone, Debug)]
struct Draft {
    category: usize,
    likelihoods: Option<Vec<f32>>,
    sure: bool,
}

impl Disturbance {
    fn has(self, other: Self) -> bool {
        self == other || self == Self::All
    }

    /// What the two modalities of a sample say then, in the core's words and order of options.
    ///
    /// # Errors
    /// The core's, for a word that it has no room for.
    pub fn sentences(
        self,
        catalogue: &Catalogue,
        order: &Order,
        maker: Maker,
        record: &Record,
        rng: &mut impl Rng,
    ) -> Result<Vec<Vec<Word>>, SentenceError> {
        let drops = rng.random_range(0..record.words.len());
        let mut sentences = Vec::new();
        for (m, words) in record.words.iter().enumerate() {
            let mut drafts = drafts(words);
            let spoken = |drafts: &[Draft]| -> Vec<usize> {
                let there = drafts.iter().enumerate();
                there
                    .filter(|(_, d)| d.likelihoods.is_some())
                    .map(|(i, _)| i)
                    .collect()
            };
            if self.has(Self::Repeated)
                && let Some(&i) = spoken(&drafts).choose(rng)
            {
                let again = maker.words(catalogue, record, m, rng);
                let mut again = drafts[i].clone_with(&again);
                // What a fairer set leaves out the second time was heard as it was.
                again.likelihoods = again.likelihoods.or_else(|| drafts[i].likelihoods.clone());
                drafts.insert(rng.random_range(i + 1..=drafts.len()), again);
            }
            if self == Self::Corrected
                && let Some(&i) = spoken(&drafts).choose(rng)
            {
                let wrong = drafts[i].other(rng);
                drafts.insert(i, wrong);
            }
            if self.has(Self::Dropped)
                && m == drops
                && let Some(&i) = spoken(&drafts).choose(rng)
            {
                drafts.remove(i);
            }
            if self.has(Self::Unsure)
                && let Some(&i) = spoken(&drafts).choose(rng)
            {
                drafts[i].sure = false;
            }
            if self.has(Self::Shuffled) {
                drafts.shuffle(rng);
            }
            let words = drafts.iter().map(|draft| draft.word(order));
            sentences.push(words.collect::<Result<_, _>>()?);
        }
        Ok(sentences)
    }
}

/// One per category, absent ones too.
fn drafts(words: &Words) -> Vec<Draft> {
    let draft = |(category, word): (usize, &Option<Vec<f32>>)| Draft {
        category,
        likelihoods: word.clone(),
        sure: true,
    };
    words.iter().enumerate().map(draft).collect()
}

impl Draft {
    fn clone_with(&self, words: &Words) -> Self {
        Self {
            likelihoods: words[self.category].clone(),
            ..self.clone()
        }
    }

    /// A word that names another option as this one names its own: all move on by as many places.
    fn other(&self, rng: &mut impl Rng) -> Self {
        let mut other = self.clone();
        if let Some(likelihoods) = &mut other.likelihoods
            && likelihoods.len() > 1
        {
            let places = rng.random_range(1..likelihoods.len());
            likelihoods.rotate_right(places);
        }
        other
    }

    fn word(&self, order: &Order) -> Result<Word, SentenceError> {
        let (Some(word), Some(category)) = (&self.likelihoods, Category::from_index(self.category))
        else {
            return Ok(Word::ABSENT);
        };
        let places = order.places(self.category).iter();
        let likelihoods: Vec<f32> = places.map(|&option| word[usize::from(option)]).collect();
        if self.sure {
            return Word::certain(category, &likelihoods);
        }
        let mut categories = [(1.0 - UNSURE) / (CATEGORIES - 1) as f32; CATEGORIES];
        categories[self.category] = UNSURE;
        Word::new(&categories, &likelihoods)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Kind, set};
    use crate::noise::Level;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn each_disturbance_does_what_it_says() {
        let (catalogue, recipe) = Catalogue::papers();
        let maker = Maker::Paper(Kind::Aligned, Level::N2);
        let set = set(&catalogue, &recipe, Kind::Aligned, Level::N2, 60, 3);
        let order = Order::own(&catalogue);
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut shuffled = 0;
        for record in &set.records {
            let mut said = |d: Disturbance| -> Vec<Vec<Word>> {
                let said = d.sentences(&catalogue, &order, maker, record, &mut rng);
                let present = |words: Vec<Word>| words.into_iter().filter(Word::is_present);
                let said = said.unwrap().into_iter();
                said.map(|words| present(words).collect()).collect()
            };
            let categories =
                |words: &[Word]| -> Vec<_> { words.iter().filter_map(Word::category).collect() };
            let plain = said(Disturbance::InStep);
            let count = |said: &[Vec<Word>]| said.iter().map(Vec::len).sum::<usize>();
            assert_eq!(count(&said(Disturbance::Dropped)) + 1, count(&plain));
            for (m, plain) in plain.iter().enumerate() {
                let mut mixed = said(Disturbance::Shuffled)[m].clone();
                shuffled += usize::from(mixed != *plain);
                mixed.sort_by_key(Word::category);
                assert_eq!(mixed, *plain);
                for twice in [Disturbance::Repeated, Disturbance::Corrected] {
                    let mut found = categories(&said(twice)[m]);
                    assert_eq!(found.len(), plain.len() + 1, "{twice:?}");
                    found.sort();
                    found.dedup();
                    assert_eq!(found, categories(plain), "{twice:?}");
                }
                let unsure = &said(Disturbance::Unsure)[m];
                let changed = unsure.iter().zip(plain).filter(|(a, b)| a != b).count();
                assert_eq!((changed, categories(unsure)), (1, categories(plain)));
            }
        }
        assert!(shuffled > 40, "{shuffled}");
    }
}
