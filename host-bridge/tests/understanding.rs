//! Whatever comes in is answered, and never crashes.

use deictic::language::{LONGEST, LanguageError, Listener, Spoken, Uncertainty};
use deictic::vocabulary::Lexicon;
use deictic_core::category::Category;
use deictic_core::fuse::says_clearly;
use deictic_core::profile::Profile;
use proptest::prelude::*;

fn lexicon() -> Lexicon {
    Lexicon::tabletop().unwrap()
}

#[test]
fn bytes_that_are_no_sentence_are_refused_by_name() {
    let lexicon = lexicon();
    let listener = Listener::new(&lexicon).unwrap();
    let refused = |bytes: &[u8]| listener.understand_bytes(bytes).unwrap_err();
    assert_eq!(refused(b""), LanguageError::Empty);
    assert_eq!(refused(b"\0\x01\x1b\r\n"), LanguageError::Empty);
    assert_eq!(refused(b"pick \xff cup"), LanguageError::NotText { at: 5 });
    let long = "pick the cup ".repeat(8_000);
    assert_eq!(
        refused(long.as_bytes()),
        LanguageError::TooLong { bytes: long.len() }
    );
    let most = &long[..LONGEST - LONGEST % 13];
    assert!(matches!(
        listener.understand(most),
        Ok(_) | Err(LanguageError::TooManyCommands { .. })
    ));
    assert!(matches!(
        refused(b"push the cup 99999999999999999999 km m"),
        LanguageError::BadQuantity { .. } | LanguageError::UnknownWord { .. }
    ));
    assert!(matches!(
        refused(b"push the cup 9999999 m"),
        LanguageError::BadQuantity { .. }
    ));
    assert_eq!(
        refused(b"push the cup 5"),
        LanguageError::NoUnit {
            word: "5".to_owned()
        }
    );
}

#[test]
fn an_unknown_word_is_named_with_its_place_and_nothing_unlike_it_is_suggested() {
    let lexicon = lexicon();
    let error = deictic::language::understand("pick the Krackar", &lexicon);
    assert!(
        error.is_ok(),
        "a misheard word is taken for what it sounds like: {error:?}"
    );
    match deictic::language::understand("pick the stapler", &lexicon).unwrap_err() {
        LanguageError::UnknownWord { word, at, nearest } => {
            assert_eq!((word.as_str(), at), ("stapler", 9));
            assert!(nearest.is_empty(), "{nearest:?}");
        }
        other => panic!("{other}"),
    }
}

#[test]
fn what_is_said_plainly_is_clear_to_the_core_and_what_is_misheard_is_less_so() {
    let lexicon = lexicon();
    let listener = Listener::new(&lexicon).unwrap();
    let object = |text: &str| {
        let utterance = listener.understand(text).unwrap();
        let words = utterance.commands[0].sentence.words().to_vec();
        let word = words
            .iter()
            .find(|w| w.category() == Some(Category::OBJECT))
            .unwrap();
        word.likelihoods().to_vec()
    };
    let of = |name| usize::from(lexicon.option(Category::OBJECT, name).unwrap());
    let (cup, cube) = (of("cup"), of("cube"));
    let (plain, misheard) = (object("pick the cup"), object("pick the kup"));
    assert_eq!(plain[cup], 1.0);
    assert!(plain[cube] > 0.2 && plain[cube] < 0.5);
    assert!(misheard[cup] < plain[cup] && misheard[cup] > misheard[cube]);
    assert!(misheard[cube] / misheard[cup] >= plain[cube] / plain[cup] * 0.9);
}

#[test]
fn what_is_said_plainly_needs_no_question() {
    let lexicon = lexicon();
    let listener = Listener::new(&lexicon).unwrap();
    let profile = Profile::default();
    for category in [Category::ACTION, Category::OBJECT, Category::STORAGE] {
        for (option, entry) in (0..).zip(lexicon.entries(category)) {
            for text in entry.spoken() {
                let utterance = listener.understand(&text).unwrap();
                let [command] = &utterance.commands[..] else {
                    panic!("{text}: {utterance:?}")
                };
                let word = &command.sentence.words()[0];
                assert!(
                    says_clearly(word, category, option, &profile),
                    "{text}: {word:?}"
                );
            }
        }
    }
}

#[test]
fn one_hot_words_have_one_constant_besides() {
    let lexicon = lexicon();
    let mut listener = Listener::new(&lexicon).unwrap();
    listener.uncertainty = Uncertainty::OneHot { others: 0.2 };
    let utterance = listener.understand("pick the cup").unwrap();
    for word in utterance.commands[0].sentence.words() {
        let ones = word.likelihoods().iter().filter(|&&l| l == 1.0).count();
        let others = word.likelihoods().iter().filter(|&&l| l == 0.2).count();
        assert_eq!((ones, ones + others), (1, word.likelihoods().len()));
    }
}

#[test]
fn a_recogniser_is_plugged_in_by_its_lines() {
    let lexicon = lexicon();
    let listener = Listener::new(&lexicon).unwrap();
    let object = |line: &str| {
        let utterance = listener.hear(&Spoken::read(line).unwrap()).unwrap();
        let words = utterance.commands[0].sentence.words().to_vec();
        let word = words
            .iter()
            .find(|w| w.category() == Some(Category::OBJECT))
            .unwrap();
        word.likelihoods().to_vec()
    };
    let of = |name| usize::from(lexicon.option(Category::OBJECT, name).unwrap());
    let (cup, can) = (of("cup"), of("can"));
    let plain = object("pick the cup");
    assert_eq!(object(r#"{"text": "pick the cup"}"#), plain);
    let torn = object(
        r#"{"alternatives": [{"text": "pick the cup", "confidence": 0.6}, {"text": "pick the can", "confidence": 0.4}]}"#,
    );
    assert!(torn[cup] == 1.0 && torn[can] == 1.0 && plain[can] < 0.1);
    let scores = object(
        r#"{"alternatives": [{"text": "pick the cup", "confidence": 200.5}, {"text": "pick the can", "confidence": 190.0}]}"#,
    );
    assert!(scores[can] < 0.1);
    assert_eq!(Spoken::read("").unwrap_err(), LanguageError::Empty);
    assert_eq!(
        Spoken::read(r#"{"alternatives": []}"#).unwrap_err(),
        LanguageError::Empty
    );
}

#[test]
fn what_may_have_been_forbidden_is_not_done() {
    let lexicon = lexicon();
    let listener = Listener::new(&lexicon).unwrap();
    let heard = |not: f64| {
        let alternatives = vec![
            ("pick the cup".to_owned(), 1.0 - not),
            ("don't pick the cup".to_owned(), not),
        ];
        listener.hear(&Spoken { alternatives })
    };
    assert_eq!(heard(0.005).unwrap().commands.len(), 1);
    assert!(matches!(heard(0.1), Err(LanguageError::Unclear { .. })));
    assert!(matches!(heard(0.4), Err(LanguageError::Unclear { .. })));
    assert!(heard(0.7).unwrap().commands.is_empty());
}

proptest! {
    #[test]
    fn any_line_of_a_recogniser_is_answered(line in "\\PC{0,80}") {
        let lexicon = lexicon();
        if let Ok(spoken) = Spoken::read(&line) {
            let _ = Listener::new(&lexicon).unwrap().hear(&spoken);
        }
    }

    #[test]
    fn any_text_is_answered(text in "\\PC{0,80}") {
        let lexicon = lexicon();
        let _ = Listener::new(&lexicon).unwrap().understand(&text);
    }

    #[test]
    fn any_bytes_are_answered(bytes in prop::collection::vec(any::<u8>(), 0..120)) {
        let lexicon = lexicon();
        let _ = Listener::new(&lexicon).unwrap().understand_bytes(&bytes);
    }

    #[test]
    fn any_words_make_sentences_that_the_core_takes(
        words in prop::collection::vec(prop::sample::select(WORDS), 1..14)
    ) {
        let lexicon = lexicon();
        let text = words.join(" ");
        if let Ok(utterance) = Listener::new(&lexicon).unwrap().understand(&text) {
            for command in &utterance.commands {
                prop_assert!(command.sentence.check(lexicon.vocabulary()).is_ok(), "{}", text);
                prop_assert!(text.get(command.span.clone()).is_some());
            }
        }
    }

    #[test]
    fn a_prohibition_in_front_forbids_whatever_follows_without_a_pause(
        action in prop::sample::select(&["pick", "push", "unglue", "take", "grab"][..]),
        object in prop::sample::select(&["cup", "can", "box", "cube", "mug"][..]),
        not in prop::sample::select(&["don't", "do not", "never", "please don't", "you must not"][..]),
        tail in prop::sample::select(&["", " please", " now", " and the can", " up"][..]),
    ) {
        let lexicon = lexicon();
        let text = format!("{not} {action} the {object}{tail}");
        let utterance = Listener::new(&lexicon).unwrap().understand(&text).unwrap();
        prop_assert!(utterance.commands.is_empty(), "{}", text);
    }
}

const WORDS: &[&str] = &[
    "pick",
    "put",
    "into",
    "the",
    "cup",
    "can",
    "bowl",
    "drawer",
    "and",
    "then",
    "not",
    "don't",
    "no",
    ",",
    ".",
    "?",
    "this",
    "there",
    "it",
    "left",
    "5",
    "cm",
    "half",
    "a",
    "metre",
    "or",
    "but",
    "before",
    "after",
    "if",
    "please",
    "stop",
    "up",
    "let",
    "go",
    "zzz",
    "kup",
    "sorry",
    "minus",
    "one",
    "hundred",
    "point",
    "is",
    "you",
    "can you",
    "never mind",
    "pushing",
    "to",
    "of",
    "degrees",
];
