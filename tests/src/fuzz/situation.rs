//! Vocabularies, scenes, sentences and profiles of all kinds that are sound.

use deictic_core::board::{Entity, Observations, Scene, Sentence, Vocabulary, Word};
use deictic_core::category::{BitSet, Category};
use deictic_core::merge::Merge;
use deictic_core::profile::{
    BetaScope, Missing, Model, Presence, Profile, SeveralClear, Threshold,
};
use deictic_core::sentence::MODALITIES;
use deictic_core::vocabulary::{Action, Requirement, Signature};

use super::source::Source;

/// How many features a thing has.
const FEATURES: u8 = 6;

/// Up to eight actions over objects, storages, distances, directions.
pub fn vocabulary(source: &mut Source<'_>) -> Vocabulary {
    let parameters = [
        1 + source.small(5),
        1 + source.small(4),
        1,
        1 + source.small(3),
    ];
    let actions: Vec<Action> = (0..1 + source.small(8))
        .map(|i| {
            let compulsory = BitSet(u32::from(source.byte()) << 1 & 0b1_1110);
            let voluntary = BitSet(u32::from(source.byte()) << 1 & 0b1_1110 & !compulsory.0);
            let signature = match i {
                // The stop action takes nothing.
                0 => Signature::default(),
                _ => Signature {
                    compulsory,
                    voluntary,
                },
            };
            Action {
                signature,
                object: requirement(source),
                storage: requirement(source),
            }
        })
        .collect();
    let stop = source.flag().then_some(0);
    Vocabulary::new(&actions, &parameters, FEATURES, stop, source.word())
        .expect("it is made to be sound")
}

fn requirement(source: &mut Source<'_>) -> Requirement {
    let wanted = source.set(usize::from(FEATURES));
    let unwanted = BitSet(source.set(usize::from(FEATURES)).0 & !wanted.0);
    // Most things of a scene fail most conjunctions of many features.
    let few = 0b11 << source.small(FEATURES);
    Requirement {
        wanted: BitSet(wanted.0 & few),
        unwanted: BitSet(unwanted.0 & !few & (few << 1)),
    }
}

/// A scene with some of the vocabulary's things.
pub fn scene(source: &mut Source<'_>, vocabulary: &Vocabulary) -> Scene {
    let mut scene = Scene::new(1 + source.word() % 1000);
    let there = u32::from(source.byte()) | u32::from(source.byte()) << 8;
    let things = [Category::OBJECT, Category::STORAGE]
        .into_iter()
        .flat_map(|c| (0..vocabulary.options_of(c)).map(move |option| (c, option)));
    for (i, (category, option)) in things.enumerate() {
        if there >> i & 1 == 0 {
            continue;
        }
        let entity = Entity {
            category,
            option: option as u8,
            position: [0.4, 0.1 * option as f32, 0.0],
            features: (0..vocabulary.features()).map(|_| source.unit()).collect(),
        };
        scene
            .push(entity, vocabulary)
            .expect("it is made to be sound");
    }
    scene
}

/// A sentence of up to five words that the vocabulary has.
pub fn sentence(source: &mut Source<'_>, modality: u8, vocabulary: &Vocabulary) -> Sentence {
    let mut sentence = Sentence::new(modality);
    for _ in 0..source.small(6) {
        let word = word(source, vocabulary);
        sentence.push(word).expect("there is room for five");
    }
    sentence
}

fn word(source: &mut Source<'_>, vocabulary: &Vocabulary) -> Word {
    let all = vocabulary.options().len();
    let q = source.below(all + 1);
    let Some(category) = Category::from_index(q).filter(|_| q < all) else {
        return Word::ABSENT;
    };
    let mut categories = vec![0.0; all];
    let sure = 0.5 + source.unit() / 2.0;
    categories[q] = sure;
    categories[source.below(all)] += (1.0 - sure) * 0.5;
    let likelihoods: Vec<f32> = (0..vocabulary.options_of(category))
        .map(|_| source.unit())
        .collect();
    // A second probability may fall on the same category, but never makes another one the likeliest.
    let word = Word::new(&categories, &likelihoods).expect("it is made to fit");
    if source.byte() < 32 {
        let metres = source.unit();
        word.with_quantity(metres)
    } else {
        word
    }
}

/// What up to three modalities observed.
pub fn observations(source: &mut Source<'_>, vocabulary: &Vocabulary) -> Observations {
    let mut observations = Observations::new();
    for _ in 0..source.small(4) {
        let modality = source.small(MODALITIES as u8);
        let sentence = sentence(source, modality, vocabulary);
        // Probabilities that sum to a hair more than 1 are refused, and the modality is then silent.
        let _ = observations.insert(&sentence, vocabulary);
    }
    observations
}

/// Any variant of the method that is sound.
pub fn profile(source: &mut Source<'_>) -> Profile {
    let unclear = source.unit() / 2.0;
    Profile {
        model: source.pick(&[Model::M3, Model::M2, Model::M1, Model::Baseline]),
        merge: source.pick(&[Merge::Add, Merge::Mul, Merge::Max]),
        penalised: source.flag(),
        threshold: source.pick(&[
            Threshold::Entropy,
            Threshold::WhiteNoise,
            Threshold::None,
            Threshold::FIXED,
            Threshold::Fixed {
                clear: unclear + 0.1,
                unclear,
            },
        ]),
        weights: [
            1.0,
            source.pick(&[1.0, 0.5, 2.0]),
            1.0,
            source.pick(&[1.0, 10.0]),
        ],
        signature_penalty: source.pick(&[0.2, 1.0, 0.01]),
        beta: source.pick(&[BetaScope::Clear, BetaScope::Any]),
        presence: source.pick(&[Presence::Probability, Presence::Sum(0.1)]),
        missing: source.pick(&[Missing::Skip, Missing::Zero]),
        lead: source.pick(&[0.01, 0.0, 0.3]),
        least_h: source.pick(&[0.01, 0.1]),
        several_clear: source.pick(&[SeveralClear::Ask, SeveralClear::TakeBest]),
        guarded: source.flag(),
        ..Profile::PAPER
    }
}
