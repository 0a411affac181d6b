//! A sample in the core's own types.

use deictic_core::board;
use deictic_core::category::Category;
use deictic_core::clarify::Confirmation;
use deictic_core::fuse::Situation;
use deictic_core::joint::Tables;
use deictic_core::sentence::ANSWER;

use crate::catalogue::Catalogue;
use crate::order::Order;
use crate::record::{CATEGORIES, Record, Thing, Words};

/// In which form the core sees a feature of a thing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum FeatureForm {
    /// As 0 or 1, as the reference reads it.
    #[default]
    Sure,
    /// As the likelihood in the file. In the reference's sets `stackable` falls with roundness as a
    /// likelihood and rises with it as a truth value, so stacking suffers.
    Graded,
}

/// A sample that the core can decide on.
#[derive(Clone, Debug)]
pub struct Prepared {
    scene: board::Scene,
    observations: board::Observations,
}

impl Prepared {
    /// Translates a sample, options in the given order, as long as `vocabulary` was made of the
    /// same catalogue and order.
    ///
    /// # Errors
    /// The core's own, in words, for a sample that does not fit the vocabulary.
    pub fn new(
        record: &Record,
        catalogue: &Catalogue,
        order: &Order,
        vocabulary: &board::Vocabulary,
        form: FeatureForm,
    ) -> anyhow::Result<Self> {
        let mut sample = Self::silent(record, catalogue, order, vocabulary, form)?;
        for (modality, words) in (0_u8..).zip(&record.words) {
            sample.observe(modality, &in_order(words, order)?, vocabulary)?;
        }
        Ok(sample)
    }

    /// The scene of a sample, of which nothing was observed yet.
    ///
    /// # Errors
    /// As [`Prepared::new`].
    pub fn silent(
        record: &Record,
        catalogue: &Catalogue,
        order: &Order,
        vocabulary: &board::Vocabulary,
        form: FeatureForm,
    ) -> anyhow::Result<Self> {
        let mut scene = board::Scene::new(0);
        for category in 1..CATEGORIES {
            for thing in record.things(category) {
                let entity = entity(thing, category, catalogue, order, form);
                scene
                    .push(entity, vocabulary)
                    .map_err(|e| anyhow::anyhow!("the core refuses the scene: {e:?}"))?;
            }
        }
        Ok(Self {
            scene,
            observations: board::Observations::new(),
        })
    }

    /// Adds what a modality observed, in place of what it had.
    ///
    /// # Errors
    /// The core's own, in words.
    pub fn observe(
        &mut self,
        modality: u8,
        words: &[board::Word],
        vocabulary: &board::Vocabulary,
    ) -> anyhow::Result<()> {
        let mut sentence = board::Sentence::new(modality);
        for word in words {
            sentence
                .push(word.clone())
                .map_err(|e| anyhow::anyhow!("the core refuses a word: {e:?}"))?;
        }
        self.observations
            .insert(sentence, vocabulary)
            .map_err(|e| anyhow::anyhow!("the core refuses a sentence: {e:?}"))
    }

    /// Adds the answer to a question, a word of this category with options in the core's order.
    ///
    /// # Errors
    /// The core's own, in words.
    pub fn answer(
        &mut self,
        answers: &[(Category, Vec<f32>)],
        vocabulary: &board::Vocabulary,
    ) -> anyhow::Result<()> {
        let mut sentence = board::Sentence::new(ANSWER);
        for (category, likelihoods) in answers {
            board::Word::certain(*category, likelihoods)
                .and_then(|word| sentence.push(word))
                .map_err(|e| anyhow::anyhow!("the core refuses a word: {e:?}"))?;
        }
        self.observations
            .answer(&sentence, vocabulary)
            .map_err(|e| anyhow::anyhow!("the core refuses an answer: {e:?}"))
    }

    /// All that was said, shown and answered.
    #[must_use]
    pub fn observations(&self) -> &board::Observations {
        &self.observations
    }

    /// Adds a yes or a no.
    pub fn confirm(&mut self, confirmation: Confirmation) {
        self.observations.confirm(confirmation);
    }

    /// What the core decides on.
    #[must_use]
    pub fn with<'a>(
        &'a self,
        vocabulary: &'a board::Vocabulary,
    ) -> Situation<
        'a,
        { board::OPTIONS },
        { board::CATEGORIES },
        { board::FEATURES },
        { board::ENTITIES },
        { board::WORDS },
    > {
        Situation {
            vocabulary,
            scene: &self.scene,
            observations: &self.observations,
            sensors: Tables::NONE,
        }
    }
}

/// Words that surely are of their categories, in the core's order of options; absent ones are left
/// out.
///
/// # Errors
/// The core's own, in words.
pub fn in_order(words: &Words, order: &Order) -> anyhow::Result<Vec<board::Word>> {
    let mut said = Vec::new();
    for (c, word) in words.iter().enumerate() {
        let (Some(word), Some(category)) = (word, Category::from_index(c)) else {
            continue;
        };
        let places = order.places(c).iter();
        let likelihoods: Vec<f32> = places.map(|&option| word[usize::from(option)]).collect();
        let word = board::Word::certain(category, &likelihoods)
            .map_err(|e| anyhow::anyhow!("the core refuses a word: {e:?}"))?;
        said.push(word);
    }
    Ok(said)
}

fn entity(
    thing: &Thing,
    category: usize,
    catalogue: &Catalogue,
    order: &Order,
    form: FeatureForm,
) -> board::Entity {
    let features = thing.features.iter().map(|f| match form {
        FeatureForm::Sure => f32::from(u8::from(f.holds)),
        FeatureForm::Graded => f.likelihood,
    });
    let types = (0_u8..)
        .take(catalogue.types.len())
        .map(|t| f32::from(u8::from(thing.kind == Some(t))));
    board::Entity {
        category: Category::from_index(category).unwrap_or(Category::OBJECT),
        option: order.inside(category, thing.option),
        position: [0.0; 3],
        features: features.chain(types).collect(),
    }
}
