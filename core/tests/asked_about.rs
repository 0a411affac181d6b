//! What a person is asked about, by the words that were said and shown.

mod common;

use common::*;
use deictic_core::board::{Observations, Trace, Word};
use deictic_core::category::Category;
use deictic_core::decide::{Outcome, Question, Reason};
use deictic_core::fuse::Situation;
use deictic_core::joint::Tables;
use deictic_core::profile::Profile;
use deictic_core::sentence::LANGUAGE;

fn asked(sentences: &[deictic_core::board::Sentence]) -> Question {
    match decide(sentences, &Profile::PAPER).unwrap().outcome {
        Outcome::Ask(question) => question,
        other => panic!("not a question: {other:?}"),
    }
}

#[test]
fn what_is_missing_is_asked_for_with_what_would_fit() {
    let question = asked(&[command(LANGUAGE, PICK, None, None)]);
    assert_eq!(
        (question.category, question.reason),
        (Category::OBJECT, Reason::Missing)
    );
    assert_eq!(question.candidates, [CAN]);
    let question = asked(&[sentence(LANGUAGE, &[word(Category::OBJECT, CAN)])]);
    assert_eq!(
        (question.category, question.reason),
        (Category::ACTION, Reason::Missing)
    );
}

#[test]
fn what_is_not_there_or_not_possible_is_asked_about() {
    let question = asked(&[command(LANGUAGE, PICK, Some(CUP), None)]);
    assert_eq!(
        (question.category, question.reason),
        (Category::OBJECT, Reason::NotInScene)
    );
    assert_eq!(question.candidates, [CAN]);
    let question = asked(&[command(LANGUAGE, PICK, Some(BOX), None)]);
    assert_eq!(
        (question.category, question.reason),
        (Category::OBJECT, Reason::Infeasible)
    );
    assert_eq!(question.candidates, [CAN]);
}

#[test]
fn two_things_at_once_are_asked_about() {
    let mut likelihoods = [0.2; 9];
    likelihoods[usize::from(MOVE_UP)] = 0.9;
    likelihoods[usize::from(RELEASE)] = 0.9;
    let torn = Word::certain(Category::ACTION, &likelihoods).unwrap();
    let question = asked(&[sentence(LANGUAGE, &[torn])]);
    assert_eq!(question.category, Category::ACTION);
    assert_eq!(question.candidates, [MOVE_UP, RELEASE]);
}

#[test]
fn nothing_said_is_asked_to_be_repeated() {
    for sentences in [&[][..], &[sentence(LANGUAGE, &[Word::ABSENT])][..]] {
        let decision = decide(sentences, &Profile::PAPER).unwrap();
        assert_eq!((decision.outcome, decision.best), (Outcome::Repeat, None));
    }
}

#[test]
fn a_voluntary_parameter_that_is_not_clear_is_asked_about() {
    let mut vocabulary = vocabulary().actions().to_vec();
    vocabulary[usize::from(MOVE_UP)].signature.voluntary =
        [Category::DIRECTION].into_iter().collect();
    let vocabulary =
        deictic_core::board::Vocabulary::new(&vocabulary, &[5, 4, 1, 3], 10, Some(STOP), 0)
            .unwrap();
    let outcome = |direction: &[f32]| {
        let direction = Word::certain(Category::DIRECTION, direction).unwrap();
        let said = sentence(LANGUAGE, &[word(Category::ACTION, MOVE_UP), direction]);
        let mut observations = Observations::new();
        observations.insert(said, &vocabulary).unwrap();
        let situation = Situation {
            vocabulary: &vocabulary,
            scene: &scene(),
            observations: &observations,
            sensors: Tables::NONE,
        };
        deictic_core::fuse::fuse(situation, &Profile::PAPER, &mut Trace::new())
            .unwrap()
            .outcome
    };
    assert!(matches!(outcome(&[0.9, 0.1, 0.1]), Outcome::Execute(_)));
    let Outcome::Ask(question) = outcome(&[0.5, 0.5, 0.1]) else {
        panic!("not asked")
    };
    assert_eq!(
        (question.category, question.reason),
        (Category::DIRECTION, Reason::TooClose)
    );
}
