//! Utterances over twelve phenomena, each labelled by hand: half for development, half kept for
//! testing.

use std::collections::BTreeMap;

use deictic::language::{Command, LanguageError, Listener};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;

fn workbench() -> Lexicon {
    Lexicon::parse("workbench.toml", include_str!("data/workbench.toml")).unwrap()
}

fn czech() -> Lexicon {
    let toml = include_str!("../data/language/tabletop-cs.toml");
    Lexicon::parse("tabletop-cs.toml", toml).unwrap()
}

/// A command in the notation of the files.
fn written(command: &Command, lexicon: &Lexicon) -> String {
    let mut parts = Vec::new();
    let shown = |c: Category| command.pointed.contains(&c);
    parts.push(match command.best(Category::ACTION) {
        Some(action) => lexicon.option_name(Category::ACTION, action),
        None => "~".to_owned(),
    });
    for (category, sign) in [(Category::OBJECT, "_"), (Category::STORAGE, "_s")] {
        match command.best(category) {
            Some(option) => parts.push(lexicon.option_name(category, option)),
            None if shown(category) => parts.push(sign.to_owned()),
            None => {}
        }
    }
    let mut rest = Vec::new();
    for list in lexicon.categories().iter().skip(3) {
        let category = list.category;
        match (command.quantity(category), command.best(category)) {
            (Some(quantity), _) => {
                let figure = format!("{quantity:.4}");
                let figure = figure.trim_end_matches('0').trim_end_matches('.');
                rest.push(format!("{}={figure}", list.name));
            }
            (None, Some(option)) => parts.push(lexicon.option_name(category, option)),
            _ => {}
        }
    }
    parts.extend(rest);
    parts.join(" ")
}

fn answer(listener: &Listener<'_>, lexicon: &Lexicon, text: &str) -> String {
    match listener.understand(text) {
        Ok(utterance) if utterance.commands.is_empty() => "-".to_owned(),
        Ok(utterance) => {
            let commands = utterance.commands.iter().map(|c| written(c, lexicon));
            commands.collect::<Vec<_>>().join(" ; ")
        }
        Err(LanguageError::UnknownWord { word, .. }) => format!("? {word}"),
        Err(error) => format!("! {error}"),
    }
}

/// Right and all utterances per phenomenon, and what went wrong.
fn score(lexicon: &Lexicon, file: &str) -> (BTreeMap<String, (usize, usize)>, Vec<String>) {
    let listener = Listener::new(lexicon).unwrap();
    let (mut counts, mut wrong) = (BTreeMap::new(), Vec::new());
    for line in file
        .lines()
        .filter(|l| !l.starts_with('#') && !l.trim().is_empty())
    {
        let [phenomenon, text, label] = line.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("not three parts: {line}");
        };
        let got = answer(&listener, lexicon, text);
        let count = counts.entry(phenomenon.to_owned()).or_insert((0, 0));
        count.1 += 1;
        if got == label {
            count.0 += 1;
        } else {
            wrong.push(format!(
                "{phenomenon}: {text}\n    wanted {label}\n    got    {got}"
            ));
        }
        let idle = matches!(
            phenomenon,
            "negation" | "questions" | "reported" | "other-time" | "own-doing"
        );
        let executed = label == "-" && !got.starts_with(['-', '?', '!', '~']);
        assert!(
            !(idle && executed),
            "executed though it must not be: {text} -> {got}"
        );
    }
    (counts, wrong)
}

fn check(name: &str, lexicon: &Lexicon, file: &str, least: f64) -> (usize, usize) {
    let (counts, wrong) = score(lexicon, file);
    let (right, all) = counts.values().fold((0, 0), |s, c| (s.0 + c.0, s.1 + c.1));
    let share = right as f64 / all as f64;
    println!(
        "{name}: {right} of {all} right ({:.1} %), {counts:?}",
        share * 100.0
    );
    wrong.iter().for_each(|w| println!("{w}"));
    assert!(share >= least, "{name}: {share}");
    (counts.len(), all)
}

#[test]
fn the_development_half_is_understood() {
    let file = include_str!("data/utterances_development.txt");
    let (phenomena, all) = check("development", &workbench(), file, 0.98);
    assert!(phenomena == 12 && all >= 150);
}

#[test]
fn the_half_kept_for_testing_is_understood() {
    let file = include_str!("data/utterances_held_back.txt");
    let (phenomena, all) = check("kept for testing", &workbench(), file, 0.98);
    assert!(phenomena == 12 && all >= 150);
}

/// 117 of 122 on its first run, 95.9 %; none was done that was not to be done.
#[test]
fn a_third_set_is_understood() {
    let file = include_str!("data/utterances_third.txt");
    let (phenomena, all) = check("third", &workbench(), file, 0.98);
    assert!(phenomena == 12 && all >= 120);
}

#[test]
fn a_fourth_set_is_understood() {
    let file = include_str!("data/utterances_fourth.txt");
    let (phenomena, all) = check("fourth", &workbench(), file, 0.95);
    assert!(phenomena == 12 && all >= 72);
}

#[test]
fn czech_is_a_matter_of_two_files() {
    let file = include_str!("data/utterances_czech.txt");
    let (_, all) = check("Czech", &czech(), file, 0.98);
    assert!(all >= 60);
}

/// 71 of 72 on its first run, 98.6 %; none was done that was not to be done, and nothing was changed
/// after it.
#[test]
fn a_fifth_set_is_understood() {
    let file = include_str!("data/utterances_fifth.txt");
    let (phenomena, all) = check("fifth", &workbench(), file, 0.98);
    assert!(phenomena == 12 && all >= 72);
}

/// 23 of 24 on its first run: "teda" is not known.
#[test]
fn a_second_czech_set_is_understood() {
    let file = include_str!("data/utterances_czech_second.txt");
    let (_, all) = check("Czech, second", &czech(), file, 0.95);
    assert!(all >= 24);
}

#[test]
fn what_is_no_command_now_and_what_would_lose_a_part_is_not_done() {
    let lexicon = Lexicon::tabletop().unwrap();
    let file = include_str!("data/utterances_not_now.txt");
    let (phenomena, all) = check("not now", &lexicon, file, 1.0);
    assert!(phenomena >= 7 && all >= 90);
}

#[test]
fn a_choice_leaves_both_in_question() {
    let lexicon = Lexicon::tabletop().unwrap();
    let listener = Listener::new(&lexicon).unwrap();
    let both = |text: &str, category: Category| {
        let commands = listener.understand(text).unwrap().commands;
        let word = commands[0].sentence.words().iter();
        let word = word
            .clone()
            .find(|w| w.category() == Some(category))
            .unwrap();
        let sure = |(option, &l): (usize, &f32)| (l >= 1.0).then_some(option);
        let likelihoods = word.likelihoods().iter().enumerate();
        likelihoods.filter_map(sure).collect::<Vec<_>>()
    };
    let (drawer, bowl) = (0, 3);
    for text in [
        "put the can in the bowl or in the drawer",
        "put the can in the drawer or in the bowl",
        "put the can in the drawer or the bowl",
    ] {
        assert_eq!(both(text, Category::STORAGE), [drawer, bowl], "{text}");
    }
    let direction = lexicon.category("direction").unwrap();
    let (left, right) = (0, 1);
    assert_eq!(both("push the can right or left", direction), [left, right]);
}

#[test]
fn a_name_in_another_case_is_as_sure_as_its_nominative() {
    let lexicon = czech();
    let listener = Listener::new(&lexicon).unwrap();
    let objects = |text: &str| {
        let commands = listener.understand(text).unwrap().commands;
        let words = commands[0].sentence.words().to_vec();
        let object = words
            .iter()
            .find(|w| w.category() == Some(Category::OBJECT))
            .unwrap();
        object.likelihoods().to_vec()
    };
    let (can, cup) = (0, 1);
    assert_eq!(objects("vezmi plechovku"), objects("vezmi plechovka"));
    for text in [
        "vezmi hrnek nebo plechovku",
        "vezmi plechovku nebo hrnek",
        "vezmi buď hrnek nebo plechovku",
        "vezmi hrníček anebo konzervu",
    ] {
        let both = objects(text);
        assert_eq!((both[can], both[cup]), (1.0, 1.0), "{text}");
    }
}
