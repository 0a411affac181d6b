//! Fusion of time-stamped hypotheses.

use deictic::language::pack::Pack;
use deictic::language::stream::{Class, Fused, Grammar, Hypothesis, Open, Outcome, Streams};
use deictic::vocabulary::Lexicon;
use proptest::prelude::*;

fn grammar() -> Grammar {
    Grammar::of(
        &Lexicon::tabletop().unwrap(),
        &Pack::built_in("en").unwrap(),
    )
    .unwrap()
}

fn at(time: f64, words: &[(&str, f64)]) -> Hypothesis {
    let words = words.iter().map(|(w, p)| ((*w).to_owned(), *p)).collect();
    Hypothesis { time, words }
}

/// The words of a sentence a tenth of a second apart.
fn said(text: &str) -> Vec<Hypothesis> {
    let words = text.split(' ').enumerate();
    words
        .map(|(i, w)| at(0.1 * i as f64, &[(w, 1.0)]))
        .collect()
}

fn names(grammar: &Grammar, fused: &Fused) -> Vec<Option<String>> {
    let name = |class, option: usize| grammar.names(class)[option].clone();
    fused
        .parts
        .iter()
        .map(|p| p.option.map(|o| name(p.class, o)))
        .collect()
}

fn check(voice: Vec<Hypothesis>, gesture: Vec<Hypothesis>, wanted: &[&str]) {
    let grammar = grammar();
    let fused = grammar.fuse(&Streams { voice, gesture });
    let wanted: Vec<_> = wanted.iter().map(|w| Some((*w).to_owned())).collect();
    assert_eq!(names(&grammar, &fused), wanted);
    assert_eq!(fused.outcome, Outcome::Sentence);
}

#[test]
fn the_parts_come_in_any_order() {
    check(
        said("stack cup to crackers"),
        vec![],
        &["stack", "cup", "crackers"],
    );
    check(
        said("into drawer stack cup"),
        vec![],
        &["stack", "cup", "drawer"],
    );
    check(
        said("please stack the cup to the bowl"),
        vec![],
        &["stack", "cup", "bowl"],
    );
}

#[test]
fn each_place_gets_its_own_pointing() {
    let cup = at(0.2, &[("cup", 0.7), ("can", 0.2), ("box", 0.1)]);
    let bowl = at(0.6, &[("bowl", 0.6), ("drawer", 0.3), ("foam", 0.1)]);
    for gesture in [vec![cup.clone(), bowl.clone()], vec![bowl, cup]] {
        check(
            said("pour this to there"),
            gesture,
            &["pour", "cup", "bowl"],
        );
    }
}

#[test]
fn a_pointing_far_off_in_time_still_belongs_to_what_it_shows() {
    let late = at(
        3.5,
        &[("can", 0.7), ("cup", 0.1), ("cube", 0.1), ("box", 0.1)],
    );
    check(
        said("pour can to foam"),
        vec![late],
        &["pour", "can", "foam"],
    );
}

#[test]
fn a_covered_word_is_taken_from_the_hand() {
    let pick = at(0.0, &[("pick", 0.8), ("push", 0.1)]);
    let cup = at(0.2, &[("cup", 0.8), ("can", 0.05)]);
    check(said("brr cup"), vec![pick, cup.clone()], &["pick", "cup"]);
    check(said("pick brr"), vec![cup], &["pick", "cup"]);
}

#[test]
fn of_two_alternatives_the_one_that_fits_is_taken() {
    let voice = vec![
        at(0.1, &[("pick", 0.3)]),
        at(0.3, &[("stack", 0.7), ("cup", 0.3)]),
    ];
    check(voice, vec![], &["pick", "cup"]);
}

#[test]
fn what_nobody_said_or_showed_is_asked_for() {
    let grammar = grammar();
    let asked = |voice: Vec<Hypothesis>, gesture: Vec<Hypothesis>| match grammar
        .fuse(&Streams { voice, gesture })
        .outcome
    {
        Outcome::Ask(Open { class, candidates }) => {
            assert!((2..=Open::CANDIDATES).contains(&candidates.len()));
            class
        }
        other => panic!("{other:?}"),
    };
    assert_eq!(asked(said("stack cup"), vec![]), Class::Storage);
    assert_eq!(asked(said("pick"), vec![]), Class::Object);
    assert_eq!(asked(said("brr"), vec![]), Class::Action);
    let torn = at(0.2, &[("cup", 0.45), ("can", 0.45)]);
    assert_eq!(asked(said("pick brr"), vec![torn]), Class::Object);
    assert_eq!(grammar.fuse(&Streams::default()).outcome, Outcome::Repeat);
}

#[test]
fn figures_that_are_none_are_passed_over() {
    for p in [f64::NAN, f64::INFINITY, -1.0, 7.0] {
        let mut voice = said("pick cup");
        voice[1].words.push(("can".to_owned(), p));
        voice.push(at(f64::NAN, &[("stop", 1.0)]));
        check(voice, vec![at(p, &[("box", p)])], &["pick", "cup"]);
    }
}

proptest! {
    #[test]
    fn any_streams_have_an_outcome(
        voice in prop::collection::vec((any::<f64>(), "[a-z]{0,6}|cup|pick|to|bowl", any::<f64>()), 0..9),
        gesture in prop::collection::vec((any::<f64>(), "cup|can|bowl|pick|stop", 0.0..1.0), 0..6),
    ) {
        let stream = |list: Vec<(f64, String, f64)>| list
            .into_iter()
            .map(|(time, word, p)| Hypothesis { time, words: vec![(word, p)] })
            .collect();
        let grammar = grammar();
        let fused = grammar.fuse(&Streams { voice: stream(voice), gesture: stream(gesture) });
        if fused.outcome == Outcome::Sentence {
            prop_assert!(fused.parts.iter().all(|p| p.option.is_some()));
            prop_assert!(fused.parts.iter().any(|p| p.class == Class::Action));
        }
    }
}
