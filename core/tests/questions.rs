//! A whole unit that asks: answers as likelihoods, what ends a question, and what cannot be answered.

#[path = "common/bench.rs"]
mod bench;
mod common;

use bench::*;
use common::*;
use deictic_core::board::{Sentence, ToHost, ToUnit, Word};
use deictic_core::category::Category;
use deictic_core::decide::{Kind, Outcome, Question, Reason};
use deictic_core::profile::{Profile, Threshold};
use deictic_core::protocol::message::*;
use deictic_core::sentence::{GESTURE, LANGUAGE};
use proptest::prelude::*;

/// "Pick" or "push", hardly more the one than the other, and the can clearly.
fn unsure(modality: u8) -> Sentence {
    let mut actions = [0.3; 9];
    actions[usize::from(PICK)] = 0.95;
    actions[usize::from(PUSH)] = 0.85;
    let mut objects = [0.3; 5];
    objects[usize::from(CAN)] = 1.0;
    let word = |category, likelihoods: &[f32]| Word::certain(category, likelihoods).unwrap();
    sentence(
        modality,
        &[
            word(Category::ACTION, &actions),
            word(Category::OBJECT, &objects),
        ],
    )
}

fn joint() -> Bench {
    let mut bench = Bench::ready();
    bench.say(&ToUnit::Configure(Configuration {
        profile: Profile::JOINT,
        ..Configuration::DEFAULT
    }));
    bench
}

/// A question that is open, with its number and how many more there may be.
fn asked(bench: &mut Bench) -> (u32, u8, Question) {
    bench.decision(unsure(LANGUAGE));
    question(&bench.decision(unsure(GESTURE)).unwrap())
}

fn question(decided: &Decided<8>) -> (u32, u8, Question) {
    match &decided.decision.outcome {
        Outcome::Ask(question) => (decided.number, decided.questions_left, question.clone()),
        other => panic!("{other:?}"),
    }
}

fn answer(bench: &mut Bench, question: u32, likelihoods: &[f32]) -> Vec<ToHost> {
    bench.say(&ToUnit::Answer(Answer {
        question,
        likelihoods: likelihoods.iter().copied().collect(),
    }))
}

fn decided(heard: &[ToHost]) -> Decided<8> {
    let decided = heard.iter().find_map(|m| match m {
        ToHost::Decision(decided) => Some(decided.clone()),
        _ => None,
    });
    decided.unwrap_or_else(|| panic!("{heard:?}"))
}

#[test]
fn a_yes_is_done_and_after_a_no_the_other_is_likeliest() {
    for yes in [true, false] {
        let mut bench = joint();
        let (number, left, question) = asked(&mut bench);
        assert_eq!((question.kind, left), (Kind::Confirm, 1));
        let mut both = question.candidates.clone();
        both.sort_unstable();
        assert_eq!(both[..], [PICK, PUSH]);
        let likelihoods = if yes { [1.0, 0.3] } else { [0.3, 1.0] };
        let heard = decided(&answer(&mut bench, number, &likelihoods)).decision;
        let [asked, other] = [question.candidates[0], question.candidates[1]];
        let likeliest = heard.best.as_ref().map(|best| best.action);
        assert_eq!(likeliest, Some(if yes { asked } else { other }));
        if yes {
            assert_eq!(executed(&heard), Some((asked, Some(CAN), None)));
        }
    }
}

#[test]
fn a_name_answers_a_yes_or_no_as_well() {
    let mut bench = joint();
    let (number, ..) = asked(&mut bench);
    let push = sentence(LANGUAGE, &[word(Category::ACTION, PUSH)]);
    let heard = bench.all(sentence_parts(&push, Some(number)));
    assert_eq!(
        executed(&decided(&heard).decision),
        Some((PUSH, Some(CAN), None))
    );
}

#[test]
fn after_two_answers_that_say_nothing_it_gives_up() {
    let mut bench = joint();
    let (first, ..) = asked(&mut bench);
    let heard = answer(&mut bench, first, &[0.6, 0.6]);
    let (second, left, _) = question(&decided(&heard));
    assert_eq!((second, left), (first + 1, 0));
    // The question before is closed.
    let heard = answer(&mut bench, first, &[1.0, 0.0]);
    assert_eq!(faults(&heard), [Fault::NoQuestion { decision: first }]);
    let heard = decided(&answer(&mut bench, second, &[0.6, 0.6]));
    assert_eq!(heard.decision.outcome, Outcome::GiveUp);
    let heard = answer(&mut bench, second, &[1.0, 0.0]);
    assert_eq!(faults(&heard), [Fault::NoQuestion { decision: second }]);
}

#[test]
fn what_cannot_be_an_answer_leaves_the_question_open() {
    let mut bench = joint();
    let (number, _, question) = asked(&mut bench);
    for bad in [
        &[][..],
        &[1.0],
        &[1.0, 0.0, 0.0],
        &[f32::NAN, 0.0],
        &[1.5, 0.0],
    ] {
        let heard = answer(&mut bench, number, bad);
        assert_eq!(faults(&heard), [Fault::Answer { expected: 2 }], "{bad:?}");
    }
    let heard = decided(&answer(&mut bench, number, &[1.0, 0.0]));
    let meant = question.candidates[0];
    assert_eq!(executed(&heard.decision), Some((meant, Some(CAN), None)));
}

#[test]
fn a_stop_and_a_new_command_end_the_question() {
    let stop = sentence(LANGUAGE, &[word(Category::ACTION, STOP)]);
    for other in [stop, unsure(LANGUAGE)] {
        let mut bench = joint();
        let (number, ..) = asked(&mut bench);
        bench.tell(&other);
        let heard = answer(&mut bench, number, &[1.0, 0.0]);
        assert_eq!(faults(&heard), [Fault::NoQuestion { decision: number }]);
    }
}

#[test]
fn a_yes_to_what_has_gone_moves_nothing() {
    let mut bench = joint();
    let (number, ..) = asked(&mut bench);
    let things = things();
    let without: Vec<_> = things
        .iter()
        .filter(|t| (t.category, t.option) != (Category::OBJECT, CAN))
        .collect();
    for (i, part) in without.chunks(ENTITIES_PART).enumerate() {
        bench.say(&ToUnit::Scene(ScenePart {
            version: 2,
            total: without.len() as u8,
            first: (i * ENTITIES_PART) as u8,
            entities: part.iter().map(|&t| t.clone()).collect(),
        }));
    }
    let heard = decided(&answer(&mut bench, number, &[1.0, 0.0]));
    assert_eq!(heard.scene, 2);
    assert_eq!(executed(&heard.decision), None);
}

/// Words that are hardly more one thing than another, by how much.
fn torn(modality: u8, lead: f32) -> Sentence {
    let (mut actions, mut objects) = ([0.4; 9], [0.4; 5]);
    for option in [PICK, PUSH] {
        actions[usize::from(option)] = 0.8;
    }
    for option in [CAN, CUP] {
        objects[usize::from(option)] = 0.8;
    }
    actions[usize::from(PICK)] += lead;
    objects[usize::from(CAN)] += lead;
    let word = |category, likelihoods: &[f32]| Word::certain(category, likelihoods).unwrap();
    let words = [
        word(Category::ACTION, &actions),
        word(Category::OBJECT, &objects),
    ];
    sentence(modality, &words)
}

proptest! {
    /// Whoever answers clearly is not asked the same again, however unsure the unit was, and it comes to an end.
    #[test]
    fn what_was_clearly_answered_is_not_asked_again(
        questions in 1_u8..=4,
        rate in 0.003_f32..0.5,
        leads in proptest::array::uniform2(-0.3_f32..0.2),
        answers in proptest::collection::vec((0_usize..9, 0.0_f32..0.05), 5),
    ) {
        let mut bench = Bench::ready();
        let threshold = Threshold::Risk { rate };
        bench.say(&ToUnit::Configure(Configuration {
            profile: Profile { questions, threshold, ..Profile::JOINT },
            ..Configuration::DEFAULT
        }));
        bench.tell(&torn(LANGUAGE, leads[0]));
        let mut heard = bench.tell(&torn(GESTURE, leads[1]));
        let (mut confirmed, mut named) = (Vec::new(), Vec::new());
        for (option, others) in answers {
            let now = decided(&heard);
            let Outcome::Ask(question) = &now.decision.outcome else {
                return Ok(());
            };
            let options = match question.kind {
                Kind::Confirm => {
                    let intent = now.decision.best.clone();
                    prop_assert!(!confirmed.contains(&intent), "{:?}", intent);
                    confirmed.push(intent);
                    2
                }
                Kind::Which => {
                    let about = question.category;
                    let clear = question.reason == Reason::TooClose;
                    prop_assert!(!(clear && named.contains(&about)), "{:?}", about);
                    named.push(about);
                    vocabulary().options_of(about)
                }
            };
            let mut likelihoods = vec![others; options];
            likelihoods[option % options] = 1.0;
            heard = answer(&mut bench, now.number, &likelihoods);
        }
        prop_assert!(!matches!(decided(&heard).decision.outcome, Outcome::Ask(_)));
    }
}
