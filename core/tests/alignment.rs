//! Words of several modalities that are out of step, and a third modality beside hand and voice.

mod common;

use common::*;
use deictic_core::board::{Sentence, Word};
use deictic_core::category::Category;
use deictic_core::decide::Outcome;
use deictic_core::profile::{Align, Model, Profile, Threshold};
use deictic_core::sentence::{GESTURE, LANGUAGE};
use proptest::prelude::*;

/// Where a person looks.
const GAZE: u8 = 2;

const CATEGORIES: [(Category, usize); 3] = [
    (Category::ACTION, 9),
    (Category::OBJECT, 5),
    (Category::STORAGE, 4),
];

/// A word of every category, some of which are absent, in order.
fn any_words() -> impl Strategy<Value = Vec<Word>> {
    let word = |(category, options): (Category, usize)| {
        (
            proptest::collection::vec(0.0_f32..=1.0, options),
            0.5_f32..=1.0,
            proptest::bool::weighted(0.2),
        )
            .prop_map(move |(likelihoods, certainty, absent)| {
                let mut categories = [0.0; 3];
                categories[category.index()] = certainty;
                categories[(category.index() + 1) % 3] = (1.0 - certainty) * 0.9;
                match absent {
                    true => Word::ABSENT,
                    false => Word::new(&categories, &likelihoods).unwrap(),
                }
            })
    };
    CATEGORIES.map(word).prop_map(Vec::from)
}

/// The words of three modalities.
fn any_observed() -> impl Strategy<Value = [Vec<Word>; 3]> {
    [any_words(), any_words(), any_words()]
}

fn any_order() -> impl Strategy<Value = Vec<usize>> {
    Just(vec![0, 1, 2]).prop_shuffle()
}

fn any_model() -> impl Strategy<Value = Profile> {
    let papers = |model, threshold| Profile {
        model,
        threshold,
        ..Profile::PAPER
    };
    prop_oneof![
        Just(Profile::JOINT),
        Just(papers(Model::M3, Threshold::Entropy)),
        Just(papers(Model::M2, Threshold::WhiteNoise)),
        Just(Profile::FIXED),
        Just(Profile::BASELINE),
    ]
}

fn sentences(observed: &[Vec<Word>; 3], orders: &[Vec<usize>; 3]) -> [Sentence; 3] {
    std::array::from_fn(|m| {
        let words: Vec<Word> = orders[m].iter().map(|&i| observed[m][i].clone()).collect();
        sentence(m as u8, &words)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn by_category_the_order_of_words_means_nothing(
        observed in any_observed(), orders in [any_order(), any_order(), any_order()],
        profile in any_model(),
    ) {
        let in_order = [(); 3].map(|()| vec![0, 1, 2]);
        let scene = scene();
        prop_assert_eq!(
            decide_in(&scene, &sentences(&observed, &orders), &profile),
            decide_in(&scene, &sentences(&observed, &in_order), &profile)
        );
    }

    #[test]
    fn synchronised_sentences_are_aligned_alike_by_either_rule(
        observed in any_observed(), order in any_order(), profile in any_model(),
    ) {
        let by_position = Profile { align: Align::Position, ..profile };
        let said = sentences(&observed, &[order.clone(), order.clone(), order]);
        let scene = scene();
        prop_assert_eq!(
            decide_in(&scene, &said, &by_position),
            decide_in(&scene, &said, &profile)
        );
    }

    #[test]
    fn of_words_said_twice_the_later_counts(
        observed in any_observed(), again in any_words(), which in 0_usize..3, profile in any_model(),
    ) {
        let sure = |word: &Word| word.category().map_or(Word::ABSENT, |q| {
            Word::certain(q, word.likelihoods()).unwrap()
        });
        let said: Vec<Word> = observed[0].iter().map(sure).collect();
        let later = sure(&again[which]);
        prop_assume!(later.is_present());
        let mut corrected = said.clone();
        corrected[which] = later.clone();
        let twice: Vec<Word> = said.into_iter().chain([later]).collect();
        let scene = scene();
        let other = sentence(LANGUAGE, &observed[1]);
        prop_assert_eq!(
            decide_in(&scene, &[sentence(GESTURE, &twice), other.clone()], &profile),
            decide_in(&scene, &[sentence(GESTURE, &corrected), other], &profile)
        );
    }

    #[test]
    fn which_modality_says_it_means_nothing_to_the_joint_model(
        observed in any_observed(), order in any_order(),
    ) {
        let scene = scene();
        let in_turn = |order: &[usize]| {
            let said = [0, 1, 2].map(|m| sentence(m as u8, &observed[order[m]]));
            let (decision, trace) = decide_in(&scene, &said, &Profile::JOINT);
            let marginals: Vec<_> = trace.categories().iter().map(|w| w.merged().to_vec()).collect();
            (decision, trace.belief, marginals)
        };
        prop_assert_eq!(in_turn(&order), in_turn(&[0, 1, 2]));
    }
}

/// A word that reports 1 of an option and `others` of the rest.
fn reported(category: Category, options: usize, option: u8, others: f32) -> Word {
    let mut likelihoods = vec![others; options];
    likelihoods[usize::from(option)] = 1.0;
    Word::certain(category, &likelihoods).unwrap()
}

#[test]
fn a_third_modality_settles_what_two_contradict_each_other_in() {
    let mut scene = scene();
    let mut loose = entity(Category::OBJECT, CUP, &[]);
    loose.features = scene.find(Category::OBJECT, CAN).unwrap().features.clone();
    scene.push(loose, &vocabulary()).unwrap();
    let object = |option| reported(Category::OBJECT, 5, option, 0.3);
    let push = reported(Category::ACTION, 9, PUSH, 0.3);
    let shown = sentence(GESTURE, &[push.clone(), object(CAN)]);
    let said = sentence(LANGUAGE, &[push, object(CUP)]);
    let decide = |sentences: &[Sentence], profile: &Profile| {
        let (decision, _) = decide_in(&scene, sentences, profile);
        decision.unwrap().outcome
    };
    for profile in [Profile::JOINT, Profile::PAPER] {
        let torn = decide(&[shown.clone(), said.clone()], &profile);
        assert!(matches!(torn, Outcome::Ask(_)), "{torn:?}");
        for looked_at in [CAN, CUP] {
            let gaze = sentence(GAZE, &[object(looked_at)]);
            match decide(&[shown.clone(), said.clone(), gaze], &profile) {
                Outcome::Execute(intent) => {
                    assert_eq!(intent.option(Category::OBJECT), Some(looked_at));
                }
                other => panic!("{:?}, looking at {looked_at}: {other:?}", profile.model),
            }
        }
    }
}
