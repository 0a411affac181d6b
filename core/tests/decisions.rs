//! What a person can expect of a decision, by the words that were said and shown.

mod common;

use common::*;
use deictic_core::board::{Observations, Trace, Word};
use deictic_core::category::Category;
use deictic_core::decide::Outcome;
use deictic_core::fuse::{Situation, fuse_with};
use deictic_core::joint::Tables;
use deictic_core::merge::{Merge, Mix};
use deictic_core::profile::{Model, Profile, ProfileError, Threshold};
use deictic_core::sentence::{GESTURE, LANGUAGE, SentenceError};

#[test]
fn what_is_said_and_shown_alike_is_executed() {
    let said = command(LANGUAGE, PUT, Some(CAN), Some(DRAWER));
    let shown = command(GESTURE, PUT, Some(CAN), Some(DRAWER));
    let expected = Some((PUT, Some(CAN), Some(DRAWER)));
    let white = Profile {
        threshold: Threshold::WhiteNoise,
        ..Profile::PAPER
    };
    for profile in [Profile::PAPER, Profile::BASELINE, white] {
        let both = decide(&[said.clone(), shown.clone()], &profile).unwrap();
        assert_eq!(executed(&both), expected);
        let alone = decide(std::slice::from_ref(&said), &profile).unwrap();
        assert_eq!(executed(&alone), expected);
    }
}

#[test]
fn this_and_there_are_filled_by_the_hand() {
    let said = sentence(
        LANGUAGE,
        &[word(Category::ACTION, PUT), Word::ABSENT, Word::ABSENT],
    );
    let shown = sentence(
        GESTURE,
        &[
            Word::ABSENT,
            word(Category::OBJECT, CAN),
            word(Category::STORAGE, DRAWER),
        ],
    );
    let decision = decide(&[said, shown], &Profile::PAPER).unwrap();
    assert_eq!(executed(&decision), Some((PUT, Some(CAN), Some(DRAWER))));
}

#[test]
fn the_scene_settles_a_contradiction() {
    // Unglue was said, pick was shown; only the box is glued, and it is the can that was meant.
    let said = command(LANGUAGE, UNGLUE, Some(CAN), None);
    let shown = command(GESTURE, PICK, Some(CAN), None);
    let with = |model| {
        decide(
            &[said.clone(), shown.clone()],
            &Profile {
                model,
                ..Profile::PAPER
            },
        )
        .unwrap()
    };
    assert_eq!(executed(&with(Model::M3)), Some((PICK, Some(CAN), None)));
    assert_eq!(executed(&with(Model::M1)), None);
}

#[test]
fn the_signature_settles_a_contradiction() {
    let said = command(LANGUAGE, STOP, Some(CAN), Some(DRAWER));
    let shown = command(GESTURE, PUT, Some(CAN), Some(DRAWER));
    let with = |model| {
        decide(
            &[said.clone(), shown.clone()],
            &Profile {
                model,
                ..Profile::PAPER
            },
        )
        .unwrap()
    };
    assert_eq!(
        executed(&with(Model::M2)),
        Some((PUT, Some(CAN), Some(DRAWER)))
    );
    assert_eq!(executed(&with(Model::M1)), None);
}

#[test]
fn an_empty_scene_moves_nothing_that_needs_a_thing() {
    let empty = deictic_core::board::Scene::new(1);
    for action in [PICK, PUSH, UNGLUE] {
        let said = command(LANGUAGE, action, Some(CAN), None);
        let (decision, _) = decide_in(&empty, &[said], &Profile::PAPER);
        assert_eq!(executed(&decision.unwrap()), None);
    }
}

#[test]
fn a_quantity_is_carried_to_the_intent() {
    let height = Word::certain(Category::DISTANCE, &[1.0])
        .unwrap()
        .with_quantity(0.05);
    let said = sentence(
        LANGUAGE,
        &[
            word(Category::ACTION, POUR),
            word(Category::OBJECT, CAN),
            word(Category::STORAGE, BOWL),
            height,
        ],
    );
    let decision = decide(&[said], &Profile::PAPER).unwrap();
    let Outcome::Execute(intent) = decision.outcome else {
        panic!("not executed: {decision:?}");
    };
    let height = intent.parameter(Category::DISTANCE).unwrap();
    assert_eq!(height.quantity, Some(0.05));
}

#[test]
fn a_users_operator_mixes() {
    struct Mean;
    impl Mix for Mean {
        fn mix(&self, merged: f32, word: f32) -> f32 {
            0.5 * (merged + word)
        }
    }
    let (vocabulary, scene) = (vocabulary(), scene());
    let mut observations = Observations::new();
    observations
        .insert(command(LANGUAGE, PICK, Some(CAN), None), &vocabulary)
        .unwrap();
    observations
        .insert(command(GESTURE, PICK, Some(CAN), None), &vocabulary)
        .unwrap();
    let situation = Situation {
        vocabulary: &vocabulary,
        scene: &scene,
        observations: &observations,
        sensors: Tables::NONE,
    };
    let profile = Profile {
        penalised: false,
        threshold: Threshold::FIXED,
        ..Profile::PAPER
    };
    let mut trace = Trace::new();
    fuse_with(situation, &profile, &Mean, &mut trace).unwrap();
    assert_eq!(trace.heard[usize::from(PICK)], 0.9);
}

#[test]
fn the_trace_says_why() {
    let said = command(LANGUAGE, PICK, Some(CAN), None);
    let (_, trace) = decide_in(&scene(), &[said], &Profile::PAPER);
    let action = trace.category(Category::ACTION).unwrap();
    assert_eq!(action.merged().len(), 9);
    assert!((action.merged().iter().sum::<f32>() - 1.0).abs() < 1e-5);
    assert!(action.judgement.is_clear(PICK) && action.h()[usize::from(PICK)] < action.threshold);
    assert_eq!(trace.alpha[usize::from(PICK)], 1.0);
    assert!((trace.alpha[usize::from(PUT)] - 0.2).abs() < 1e-6);
    assert_eq!(
        (
            trace.beta[usize::from(PICK)],
            trace.beta[usize::from(UNGLUE)]
        ),
        (1.0, 0.0)
    );
}

#[test]
fn all_merges_models_and_thresholds_decide_an_aligned_command() {
    let sentences = [
        command(LANGUAGE, PUT, Some(CAN), Some(DRAWER)),
        command(GESTURE, PUT, Some(CAN), Some(DRAWER)),
    ];
    for model in [Model::M1, Model::M2, Model::M3] {
        for merge in [Merge::Max, Merge::Mul, Merge::Add] {
            for threshold in [Threshold::Entropy, Threshold::WhiteNoise, Threshold::FIXED] {
                let base = match threshold {
                    Threshold::Fixed { .. } => Profile::FIXED,
                    _ => Profile::PAPER,
                };
                let weights = if merge == Merge::Mul {
                    [1.0; 4]
                } else {
                    base.weights
                };
                let profile = Profile {
                    model,
                    merge,
                    threshold,
                    weights,
                    ..base
                };
                let decision = decide(&sentences, &profile).unwrap();
                let expected = Some((PUT, Some(CAN), Some(DRAWER)));
                assert_eq!(executed(&decision), expected, "{profile:?}");
            }
        }
    }
}

#[test]
fn what_cannot_be_is_refused_and_leaves_no_trace() {
    let mut likelihoods = [0.2; 9];
    likelihoods[0] = f32::NAN;
    let bad = sentence(
        GESTURE,
        &[Word::certain(Category::ACTION, &likelihoods).unwrap()],
    );
    let mut observations = Observations::new();
    let error = SentenceError::BadLikelihood { word: 0 };
    assert_eq!(observations.insert(bad, &vocabulary()), Err(error));
    assert_eq!(observations, Observations::new());
    let profile = Profile {
        lead: f32::NAN,
        ..Profile::PAPER
    };
    let said = command(LANGUAGE, PICK, Some(CAN), None);
    let (decision, trace) = decide_in(&scene(), &[said], &profile);
    assert_eq!(decision, Err(ProfileError::Lead));
    assert_eq!(trace, Trace::new());
}

#[test]
fn a_trace_that_was_used_before_says_the_same_as_a_new_one() {
    let (vocabulary, scene) = (vocabulary(), scene());
    let mut used = Trace::new();
    for said in [
        command(LANGUAGE, PUT, Some(CAN), Some(DRAWER)),
        command(LANGUAGE, STOP, None, None),
    ] {
        let mut observations = Observations::new();
        observations.insert(said.clone(), &vocabulary).unwrap();
        let situation = Situation {
            vocabulary: &vocabulary,
            scene: &scene,
            observations: &observations,
            sensors: Tables::NONE,
        };
        deictic_core::fuse::fuse(situation, &Profile::PAPER, &mut used).unwrap();
        assert_eq!(used, decide_in(&scene, &[said], &Profile::PAPER).1);
    }
}
