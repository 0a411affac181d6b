//! Made-up people before that table, and what the unit's hand reader makes of them.

use deictic::hand::session::Act;
use deictic_core::board::{CATEGORIES, OPTIONS, Scene, Sentence, Vocabulary, WORDS};
use deictic_core::category::Category;
use deictic_core::gesture::context::{Context, Event};
use deictic_core::gesture::mapping::Mapping;
use deictic_core::gesture::pointing::{Aim, Mount};
use deictic_core::gesture::reader::HandReader;
use deictic_core::gesture::stroke::Templates;
use deictic_core::gesture::wire::Sample;
use deictic_core::math::argmax;
use deictic_core::time::Micros;

use crate::gesturing::{meanings, person, scene, vocabulary};

/// The reader that the board has.
pub type Reader = HandReader<OPTIONS, CATEGORIES, WORDS>;

/// What a sample led to, and what was said by then.
pub type Happened = (Event, Option<Sentence>);

/// A word by its category and its likeliest option.
pub type Named = (Category, usize);

/// What a reader goes by.
pub struct Bench {
    /// What can be said.
    pub vocabulary: Vocabulary,
    scene: Scene,
    mapping: Mapping,
}

impl Default for Bench {
    fn default() -> Self {
        Self::new()
    }
}

impl Bench {
    /// The table, and what gestures mean there.
    ///
    /// # Panics
    /// Never.
    #[must_use]
    pub fn new() -> Self {
        let vocabulary = vocabulary();
        let mut mapping = Mapping::new();
        for meaning in meanings() {
            mapping
                .set(meaning.gesture, meaning.action, vocabulary.actions().len())
                .expect("a known action");
        }
        Self {
            vocabulary,
            scene: scene(),
            mapping,
        }
    }

    /// What comes of these samples.
    pub fn read(&self, reader: &mut Reader, samples: &[Sample]) -> Vec<Happened> {
        let context = Context {
            vocabulary: &self.vocabulary,
            scene: &self.scene,
            mapping: &self.mapping,
            templates: Templates::KNOWN,
            mount: &Mount::DEFAULT,
            aim: &Aim::DEFAULT,
        };
        let mut events = Vec::new();
        for (sample, i) in samples.iter().zip(0..) {
            let Some(event) = reader.take(Micros(i * 9_000), sample, &context) else {
                continue;
            };
            let said = matches!(event, Event::Said | Event::Stop).then(|| reader.said().clone());
            events.push((event, said));
        }
        events
    }

    /// What a session says in the end.
    #[must_use]
    pub fn said(&self, acts: &[Act], seed: u64) -> Option<Sentence> {
        let events = self.read(&mut Reader::new(), &person(seed, acts));
        events.into_iter().rev().find_map(|event| match event {
            (Event::Said, said) => said,
            _ => None,
        })
    }
}

/// Every word of a sentence.
///
/// # Panics
/// When a word has no category or no option.
#[must_use]
pub fn words(sentence: &Sentence) -> Vec<Named> {
    let words = sentence.words().iter();
    words
        .map(|word| {
            let option = argmax(word.likelihoods()).expect("a word has options");
            (word.category().expect("a word has a category"), option)
        })
        .collect()
}
