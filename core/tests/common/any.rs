//! Anything that can be said, shown and stand on the table.
#![allow(dead_code, reason = "every test uses a part of it")]

use deictic_core::board::{Scene, Sentence, Word};
use deictic_core::category::Category;
use proptest::prelude::*;

use crate::common::{entity, sentence, vocabulary};

/// Any likelihoods, those at an end more often than by chance.
pub fn likelihoods(count: usize) -> impl Strategy<Value = Vec<f32>> {
    let any = prop_oneof![4 => 0.0_f32..=1.0, 1 => Just(0.0), 1 => Just(1.0)];
    proptest::collection::vec(any, count)
}

/// Any word that is certainly of this category.
pub fn any_word(category: Category, options: usize) -> impl Strategy<Value = Word> {
    likelihoods(options).prop_map(move |it| Word::certain(category, &it).unwrap())
}

/// An action, an object and a storage, each such a word or, one time in five, none.
pub fn any_sentence<S: Strategy<Value = Word>>(
    modality: u8,
    any_word: impl Fn(Category, usize) -> S,
) -> impl Strategy<Value = Sentence> {
    let kinds = [
        (Category::ACTION, 9),
        (Category::OBJECT, 5),
        (Category::STORAGE, 4),
    ];
    let words = kinds.map(|(category, options)| {
        let absent = proptest::bool::weighted(0.2);
        (any_word(category, options), absent)
            .prop_map(|(word, absent)| if absent { Word::ABSENT } else { word })
    });
    words.prop_map(move |words| sentence(modality, &words))
}

prop_compose! {
    /// Any of the things on the table, of any features.
    pub fn any_scene()(
        features in proptest::collection::vec(proptest::collection::vec(
            prop_oneof![0.0_f32..=1.0, Just(0.0), Just(1.0)], 10), 9),
        there in proptest::collection::vec(any::<bool>(), 9),
    ) -> Scene {
        let vocabulary = vocabulary();
        let mut scene = Scene::new(1);
        for (i, features) in features.iter().enumerate().filter(|(i, _)| there[*i]) {
            let (category, option) = if i < 5 { (Category::OBJECT, i) } else { (Category::STORAGE, i - 5) };
            let mut thing = entity(category, option as u8, &[]);
            thing.features = features.iter().copied().collect();
            scene.push(thing, &vocabulary).unwrap();
        }
        scene
    }
}
