//! The joint model: what holds for any input, and what it must never do.

#[path = "common/any.rs"]
mod any;
mod common;

use any::{any_scene, any_word};
use common::*;
use deictic_core::board::{Observations, Scene, Sentence, Trace, Vocabulary, Word};
use deictic_core::category::Category;
use deictic_core::decide::{Decision, Outcome, Reason};
use deictic_core::fuse::{Situation, fuse};
use deictic_core::joint::Tables;
use deictic_core::joint::belief::Look;
use deictic_core::profile::{Model, Profile, ProfileError, Threshold};
use proptest::prelude::*;

/// As a unit is configured: what cannot be had is asked about.
const JOINT: Profile = Profile {
    guarded: true,
    ..Profile::JOINT
};
const BOARD: usize = deictic_core::board::CATEGORIES;

fn decide_joint(
    vocabulary: &Vocabulary,
    scene: &Scene,
    sentences: &[Sentence],
    sensors: Tables<'_>,
) -> (Decision<BOARD>, Trace) {
    let mut observations = Observations::new();
    for sentence in sentences {
        observations.insert(sentence.clone(), vocabulary).unwrap();
    }
    let mut trace = Trace::new();
    let situation = Situation {
        vocabulary,
        scene,
        observations: &observations,
        sensors,
    };
    let decision = fuse(situation, &JOINT, &mut trace).unwrap();
    (decision, trace)
}

fn any_sentence(modality: u8) -> impl Strategy<Value = Sentence> {
    any::any_sentence(modality, any_word)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 384, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn marginals_are_finite_and_sum_to_one(
        scene in any_scene(), a in any_sentence(0), b in any_sentence(1),
    ) {
        let (decision, trace) = decide_joint(&vocabulary(), &scene, &[a, b], Tables::NONE);
        for word in trace.categories() {
            prop_assert!(word.merged().iter().all(|p| p.is_finite() && (0.0..=1.0001).contains(p)));
            prop_assert!(word.merged().iter().sum::<f32>() <= 1.0001);
        }
        prop_assert!(trace.belief.posterior.is_finite() && trace.belief.logit().is_finite());
        prop_assert!((0.0..=3.0001).contains(&trace.belief.noise));
        if decision.best.is_some() {
            let sum: f32 = trace.categories()[0].merged().iter().sum();
            prop_assert!((sum - 1.0).abs() < 1e-4, "{}", sum);
        }
    }

    #[test]
    fn only_things_that_are_there_and_fit_are_acted_upon(
        scene in any_scene(), a in any_sentence(0), b in any_sentence(1),
    ) {
        let vocabulary = vocabulary();
        let (decision, trace) = decide_joint(&vocabulary, &scene, &[a, b], Tables::NONE);
        if let Outcome::Execute(intent) = decision.outcome {
            prop_assert!(trace.belief.suffices(0.01, Look::Early));
            let action = vocabulary.actions()[usize::from(intent.action)];
            for q in action.signature.compulsory.iter() {
                let category = Category::from_index(q).unwrap();
                prop_assert!(scene.find(category, intent.option(category).unwrap()).is_some());
            }
        }
    }

    #[test]
    fn renumbering_objects_renumbers_the_answer(
        scene in any_scene(), a in any_sentence(0), b in any_sentence(1), by in 1_u8..5,
    ) {
        let vocabulary = vocabulary();
        let turned = |option: u8| (option + by) % 5;
        let mut other = Scene::new(1);
        for thing in scene.entities() {
            let mut thing = thing.clone();
            if thing.category == Category::OBJECT {
                thing.option = turned(thing.option);
            }
            other.push(thing, &vocabulary).unwrap();
        }
        let turn = |s: &Sentence| {
            let words: Vec<Word> = s.words().iter().map(|word| {
                let mut likelihoods = word.likelihoods().to_vec();
                if word.category() == Some(Category::OBJECT) {
                    likelihoods.rotate_right(usize::from(by));
                }
                word.category().map_or(Word::ABSENT, |c| Word::certain(c, &likelihoods).unwrap())
            }).collect();
            sentence(s.modality(), &words)
        };
        let (_, trace) = decide_joint(&vocabulary, &scene, &[a.clone(), b.clone()], Tables::NONE);
        let (_, turned_trace) = decide_joint(&vocabulary, &other, &[turn(&a), turn(&b)], Tables::NONE);
        for option in 0..5 {
            let was = trace.categories()[1].merged()[usize::from(option)];
            let is = turned_trace.categories()[1].merged()[usize::from(turned(option))];
            prop_assert!((was - is).abs() < 1e-3, "{} {}", was, is);
        }
        prop_assert!((trace.belief.posterior - turned_trace.belief.posterior).abs() < 1e-3);
    }
}

#[test]
fn nothing_said_is_a_repetition_and_no_action_a_question() {
    let vocabulary = vocabulary();
    let scene = Scene::new(0);
    let (decision, _) = decide_joint(&vocabulary, &scene, &[], Tables::NONE);
    assert_eq!(decision.outcome, Outcome::Repeat);
    let word = Word::certain(Category::OBJECT, &[1.0, 0.3, 0.3, 0.3, 0.3]).unwrap();
    let (decision, _) = decide_joint(&vocabulary, &scene, &[sentence(1, &[word])], Tables::NONE);
    let Outcome::Ask(question) = decision.outcome else {
        panic!("{decision:?}")
    };
    assert_eq!(
        (question.category, question.reason),
        (Category::ACTION, Reason::Missing)
    );
    assert_eq!(decision.best, None);
}

#[test]
fn the_joint_model_goes_with_risk_or_no_threshold() {
    let check = |model, threshold| {
        Profile {
            model,
            threshold,
            ..Profile::PAPER
        }
        .check()
    };
    let refused = Err(ProfileError::ModelAndThreshold);
    assert_eq!(check(Model::Joint, Threshold::RISK), Ok(()));
    assert_eq!(check(Model::Joint, Threshold::None), Ok(()));
    assert_eq!(check(Model::Joint, Threshold::Entropy), refused);
    assert_eq!(check(Model::M3, Threshold::RISK), refused);
}

/// What one modality says clearly.
fn clear(modality: u8, said: &[(Category, u8, usize)]) -> Sentence {
    let words: Vec<Word> = said
        .iter()
        .map(|&(category, option, options)| {
            let mut likelihoods = vec![0.3; options];
            likelihoods[usize::from(option)] = 1.0;
            Word::certain(category, &likelihoods).unwrap()
        })
        .collect();
    sentence(modality, &words)
}

fn question(decision: &Decision<BOARD>) -> (Category, Reason) {
    match &decision.outcome {
        Outcome::Ask(question) => (question.category, question.reason),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_clear_command_is_executed() {
    let vocabulary = vocabulary();
    let said = [
        (Category::ACTION, PUT, 9),
        (Category::OBJECT, CAN, 5),
        (Category::STORAGE, DRAWER, 4),
    ];
    let both = [clear(0, &said), clear(1, &said)];
    let (decision, trace) = decide_joint(&vocabulary, &scene(), &both, Tables::NONE);
    let Outcome::Execute(intent) = decision.outcome else {
        panic!("{decision:?} {:?}", trace.belief)
    };
    assert_eq!(
        (
            intent.action,
            intent.option(Category::OBJECT),
            intent.option(Category::STORAGE)
        ),
        (PUT, Some(CAN), Some(DRAWER))
    );
    assert!(trace.belief.confidence() > 0.9, "{:?}", trace.belief);
}

#[test]
fn a_clear_word_for_what_is_not_there_is_asked_about() {
    let vocabulary = vocabulary();
    let said = [(Category::ACTION, PICK, 9), (Category::OBJECT, CUP, 5)];
    let both = [clear(0, &said), clear(1, &said)];
    let (decision, _) = decide_joint(&vocabulary, &scene(), &both, Tables::NONE);
    assert_eq!(question(&decision), (Category::OBJECT, Reason::NotInScene));
}

#[test]
fn what_cannot_be_done_to_the_thing_that_was_meant_is_asked_about() {
    let vocabulary = vocabulary();
    let said = [(Category::ACTION, PICK, 9), (Category::OBJECT, BOX, 5)];
    let both = [clear(0, &said), clear(1, &said)];
    let (decision, _) = decide_joint(&vocabulary, &scene(), &both, Tables::NONE);
    assert_eq!(question(&decision), (Category::OBJECT, Reason::Infeasible));
}

#[test]
fn an_action_whose_storage_nobody_gave_is_asked_about() {
    let vocabulary = vocabulary();
    let said = [(Category::ACTION, PUT, 9), (Category::OBJECT, CAN, 5)];
    let both = [clear(0, &said), clear(1, &said)];
    let (decision, _) = decide_joint(&vocabulary, &scene(), &both, Tables::NONE);
    // Which action, since the words' presence speaks for another one than the words themselves.
    assert_eq!(question(&decision), (Category::ACTION, Reason::TooClose));
}

#[test]
fn a_trace_that_was_used_before_changes_nothing() {
    let paper = vocabulary();
    let vocabulary = Vocabulary::new(paper.actions(), &[5, 4, 1, 2], 10, Some(STOP), 7).unwrap();
    let direction = Category::from_index(4).unwrap();
    let scene = scene();
    let belief = |trace: &mut Trace, direction_said: [f32; 2]| {
        let mut said = clear(
            0,
            &[(Category::ACTION, PICK, 9), (Category::OBJECT, CAN, 5)],
        );
        said.push(Word::certain(direction, &direction_said).unwrap())
            .unwrap();
        let mut observations = Observations::new();
        observations.insert(said, &vocabulary).unwrap();
        let situation = Situation {
            vocabulary: &vocabulary,
            scene: &scene,
            observations: &observations,
            sensors: Tables::NONE,
        };
        let decision = fuse(situation, &JOINT, trace);
        (
            decision,
            trace.belief,
            trace.categories()[4].merged().to_vec(),
        )
    };
    let fresh = belief(&mut Trace::new(), [1.0, 0.3]);
    assert!(fresh.2[0] > 0.9, "{:?}", fresh.2);
    let mut used = Trace::new();
    assert!(belief(&mut used, [0.2, 0.9]).0.is_ok());
    assert_eq!(belief(&mut used, [1.0, 0.3]), fresh);
}
