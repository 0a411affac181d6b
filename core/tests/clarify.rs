//! Questions and answers of the joint model.

#[path = "common/any.rs"]
mod any;
mod common;

use any::any_word;
use common::*;
use deictic_core::board::{Entity, Observations, Scene, Sentence, Trace, Word};
use deictic_core::category::Category;
use deictic_core::clarify::{Confirmation, QUESTIONS, gain};
use deictic_core::decide::{Decision, Kind, Outcome, Question, Reason};
use deictic_core::fuse::{Situation, fuse};
use deictic_core::joint::Tables;
use deictic_core::joint::posterior::Triple;
use deictic_core::profile::{Profile, ProfileError};
use deictic_core::sentence::{GESTURE, LANGUAGE};
use proptest::prelude::*;

const BOARD: usize = deictic_core::board::CATEGORIES;
const OBJECTS: usize = 5;

/// A command and the answers to questions about it.
#[derive(Clone, Default)]
struct Talk {
    observations: Observations,
    questions: u8,
}

impl Talk {
    fn new(sentences: &[Sentence], questions: u8) -> Self {
        let mut observations = Observations::new();
        for sentence in sentences {
            observations
                .insert(sentence.clone(), &vocabulary())
                .unwrap();
        }
        Self {
            observations,
            questions,
        }
    }

    fn confirm(mut self, asked: Triple, likelihoods: [f32; 2]) -> Self {
        self.observations
            .confirm(Confirmation { asked, likelihoods });
        self
    }

    fn answer(mut self, word: Word) -> Self {
        let answer = sentence(LANGUAGE, &[word]);
        self.observations.answer(&answer, &vocabulary()).unwrap();
        self
    }

    fn decide(&self, scene: &Scene) -> (Decision<BOARD>, Trace) {
        let vocabulary = vocabulary();
        let situation = Situation {
            vocabulary: &vocabulary,
            scene,
            observations: &self.observations,
            sensors: Tables::NONE,
        };
        let profile = Profile {
            questions: self.questions,
            ..Profile::JOINT
        };
        let mut trace = Trace::new();
        let decision = fuse(situation, &profile, &mut trace).unwrap();
        (decision, trace)
    }
}

fn word(category: Category, likelihoods: &[f32]) -> Word {
    Word::certain(category, likelihoods).unwrap()
}

/// A word as a plain sensor reports it.
fn clear(category: Category, option: u8, options: usize) -> Word {
    let mut likelihoods = vec![0.3; options];
    likelihoods[usize::from(option)] = 1.0;
    word(category, &likelihoods)
}

/// "Pick", clearly, and the can or the box alike, both of which can be pushed and one picked.
fn push_something() -> [Sentence; 2] {
    let vague = word(Category::OBJECT, &[0.9, 0.3, 0.3, 0.85, 0.3]);
    [GESTURE, LANGUAGE].map(|m| sentence(m, &[clear(Category::ACTION, PUSH, 9), vague.clone()]))
}

/// The can and a cube that can be pushed.
fn two_things() -> Scene {
    let mut scene = Scene::new(1);
    for thing in things() {
        let mut thing = thing;
        if thing.category == Category::OBJECT {
            thing.features[0] = 0.0;
        }
        scene.push(thing, &vocabulary()).unwrap();
    }
    scene
}

/// The same without one of them.
fn two_things_but(gone: u8) -> Scene {
    let mut scene = Scene::new(2);
    let there = two_things();
    let is_gone = |t: &&Entity| (t.category, t.option) == (Category::OBJECT, gone);
    for thing in there.entities().iter().filter(|t| !is_gone(t)) {
        scene.push(thing.clone(), &vocabulary()).unwrap();
    }
    scene
}

fn question(decision: Decision<BOARD>) -> Question {
    match decision.outcome {
        Outcome::Ask(question) => question,
        other => panic!("not a question: {other:?}"),
    }
}

prop_compose! {
    fn any_command()(
        a in any_word(Category::ACTION, 9), b in any_word(Category::ACTION, 9),
        c in any_word(Category::OBJECT, OBJECTS), d in any_word(Category::OBJECT, OBJECTS),
        e in any_word(Category::STORAGE, 4), things in 1_usize..=3,
    ) -> [Sentence; 2] {
        let keep = |words: [Word; 3]| words.into_iter().take(things).collect::<Vec<_>>();
        [
            sentence(GESTURE, &keep([a, c, e.clone()])),
            sentence(LANGUAGE, &keep([b, d, e])),
        ]
    }
}

fn close(a: f32, b: f32) -> bool {
    (a - b).abs() < 1e-3
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_yes_makes_the_asked_intent_likelier_and_a_no_less_likely(command in any_command()) {
        let scene = two_things();
        let talk = Talk::new(&command, 2);
        let (before, was) = talk.decide(&scene);
        let asked = Triple::of(&before.best.unwrap());
        let (after, yes) = talk.clone().confirm(asked, [1.0, 0.3]).decide(&scene);
        prop_assert_eq!(Triple::of(&after.best.unwrap()), asked);
        prop_assert!(yes.belief.posterior >= was.belief.posterior - 0.02, "{:?} {:?}", was.belief, yes.belief);
        let (after, no) = talk.confirm(asked, [0.3, 1.0]).decide(&scene);
        if after.best.map(|best| Triple::of(&best)) == Some(asked) {
            prop_assert!(no.belief.posterior <= was.belief.posterior + 0.02, "{:?} {:?}", was.belief, no.belief);
        }
    }

    #[test]
    fn the_order_of_answers_does_not_matter(
        command in any_command(),
        a in any_word(Category::OBJECT, OBJECTS), b in any_word(Category::OBJECT, OBJECTS),
        p in 0.0_f32..=1.0, q in 0.0_f32..=1.0, other in 0_u8..9,
    ) {
        let scene = two_things();
        let talk = Talk::new(&command, 4);
        let (decision, _) = talk.decide(&scene);
        let asked = Triple::of(&decision.best.unwrap());
        let another = Triple { action: other, ..asked };
        let one = talk.clone().answer(a.clone()).confirm(asked, [p, q]).confirm(another, [q, q]).answer(b.clone());
        let two = talk.confirm(another, [q, q]).answer(b).answer(a).confirm(asked, [p, q]);
        let ((one, x), (two, y)) = (one.decide(&scene), two.decide(&scene));
        prop_assert!(close(x.belief.posterior, y.belief.posterior) && close(x.belief.noise, y.belief.noise));
        prop_assert_eq!(one.outcome, two.outcome);
    }

    #[test]
    fn as_many_questions_are_asked_as_may_be(
        command in any_command(), questions in 0_u8..=4,
        answers in proptest::collection::vec((any::<bool>(), 0.0_f32..=1.0, any_word(Category::OBJECT, OBJECTS)), 5),
    ) {
        let scene = two_things();
        let mut talk = Talk::new(&command, questions);
        for asked in 0..=questions {
            let (decision, trace) = talk.decide(&scene);
            prop_assert!(trace.belief.posterior.is_finite() && (0.0..=1.0).contains(&trace.belief.posterior));
            let sum: f32 = trace.categories()[0].merged().iter().sum();
            prop_assert!(close(sum, 1.0), "{}", sum);
            let Outcome::Ask(_) = decision.outcome else { return Ok(()) };
            prop_assert!(asked < questions, "{:?}", decision.outcome);
            let (yes_or_no, p, word) = &answers[usize::from(asked)];
            talk = match yes_or_no {
                true => talk.confirm(Triple::of(&decision.best.unwrap()), [*p, 1.0 - p]),
                false => talk.answer(word.clone()),
            };
        }
    }

    #[test]
    fn no_question_is_expected_to_confuse(
        p in proptest::collection::vec(0.0_f32..=1.0, 0..20), noise in 0.0_f32..=3.0,
    ) {
        let sum: f32 = p.iter().sum::<f32>() + 1e-3;
        let marginal: Vec<f32> = p.iter().map(|p| p / sum).collect();
        let which = gain::which(&marginal, noise);
        prop_assert!(which >= 0.0 && which <= deictic_core::math::ln(marginal.len().max(1) as f32) + 1e-3, "{}", which);
        let confirm = gain::confirm(sum.fract(), noise);
        prop_assert!((0.0..=std::f32::consts::LN_2 + 1e-3).contains(&confirm), "{}", confirm);
    }
}

#[test]
fn the_answer_is_added_to_what_was_said_and_done() {
    let scene = two_things();
    let talk = Talk::new(&push_something(), 2);
    let (decision, _) = talk.decide(&scene);
    let Outcome::Ask(question) = &decision.outcome else {
        panic!("{decision:?}")
    };
    assert_eq!(
        (question.action, question.category),
        (Some(PUSH), Category::OBJECT)
    );
    assert_eq!(question.candidates[..2], [CAN, BOX]);
    let executed = |talk: &Talk| match talk.decide(&scene).0.outcome {
        Outcome::Execute(intent) => Some((intent.action, intent.option(Category::OBJECT))),
        _ => None,
    };
    let named = talk.clone().answer(clear(Category::OBJECT, BOX, OBJECTS));
    assert_eq!(executed(&named), Some((PUSH, Some(BOX))));
    let asked = Triple::of(decision.best.as_ref().unwrap());
    let yes = talk.confirm(asked, [1.0, 0.3]);
    assert_eq!(executed(&yes), Some((PUSH, Some(CAN))));
}

#[test]
fn an_answer_is_held_against_the_scene_as_it_is_now() {
    let talk = Talk::new(&push_something(), 2).answer(clear(Category::OBJECT, BOX, OBJECTS));
    let (decision, _) = talk.decide(&two_things_but(BOX));
    assert_eq!(question(decision).reason, Reason::NotInScene);
}

#[test]
fn a_yes_to_what_is_gone_is_no_yes_to_something_else() {
    let can = Triple {
        action: PUSH,
        things: [Some(CAN), None],
    };
    let talk = Talk::new(&push_something(), 2).confirm(can, [1.0, 0.3]);
    let (decision, _) = talk.decide(&two_things_but(CAN));
    assert_eq!(question(decision).reason, Reason::NotInScene);
}

#[test]
fn a_no_to_one_of_two_means_the_other() {
    let scene = two_things();
    let talk = Talk::new(&push_something(), 2);
    let asked = Triple::of(&talk.decide(&scene).0.best.unwrap());
    assert_eq!(asked.things[0], Some(CAN));
    let (decision, _) = talk.confirm(asked, [0.3, 1.0]).decide(&scene);
    let Outcome::Execute(intent) = decision.outcome else {
        panic!("{decision:?}")
    };
    assert_eq!(intent.option(Category::OBJECT), Some(BOX));
}

#[test]
fn answers_that_say_nothing_end_in_giving_up() {
    let scene = two_things();
    let mut talk = Talk::new(&push_something(), 2);
    for _ in 0..2 {
        let (decision, _) = talk.decide(&scene);
        assert!(matches!(&decision.outcome, Outcome::Ask(_)), "{decision:?}");
        talk = talk.confirm(Triple::of(&decision.best.unwrap()), [0.7, 0.7]);
    }
    assert_eq!(talk.decide(&scene).0.outcome, Outcome::GiveUp);
}

#[test]
fn a_question_is_a_yes_or_no_where_that_helps_most() {
    // All is as good as sure but one thing, so that a word says as much as a name.
    let (decision, _) = Talk::new(&push_something(), 2).decide(&two_things());
    assert_eq!(question(decision).kind, Kind::Confirm);
}

#[test]
fn more_questions_than_there_is_room_for_are_refused() {
    let profile = Profile {
        questions: QUESTIONS as u8 + 1,
        ..Profile::JOINT
    };
    assert_eq!(profile.check(), Err(ProfileError::Questions));
}
