//! Any text, and texts made of the vocabulary's own words in any order: understood or refused, never anything else,
//! and what is understood the unit can take.

use std::cell::OnceCell;

use deictic::language::Listener;
use deictic::understanding;
use deictic::vocabulary::Lexicon;

use super::source::Source;

/// Words that texts are made of, so that more of them mean something.
const WORDS: &str = "put pick push pour stack unglue release move up stop the a this that it there here into in on onto \
    from to with and then , . ? ! no not don't do never if when unless please can cup cube box cleaner drawer foam \
    crackers bowl left right down 5 10 0.5 -3 cm mm m degrees twice one two all everything left's kan kup pich cann \
    actually instead wait who what where is are was said tell me you 1e9 999999999999 nan ½ Ž";

/// How long a text of such words is at most: a dozen of them are as many as a clause has, and every one is compared with
/// all that the vocabulary knows.
const LONGEST: usize = 100;

thread_local! {
    static LISTENER: OnceCell<Listener<'static>> = const { OnceCell::new() };
}

/// Understands one text.
pub fn run(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let text = if source.flag() {
        let words: Vec<&str> = WORDS.split_whitespace().collect();
        let mut text = String::new();
        while !source.is_over() && text.len() < LONGEST {
            text.push_str(words[source.below(words.len())]);
            if source.byte() < 250 {
                text.push(' ');
            }
        }
        text
    } else {
        String::from_utf8_lossy(source.bytes(usize::MAX)).into_owned()
    };
    LISTENER.with(|cell| {
        let listener = cell.get_or_init(|| {
            let lexicon = Lexicon::tabletop().expect("the built-in vocabulary is sound");
            Listener::new(Box::leak(Box::new(lexicon))).expect("its language has a pack")
        });
        check(listener, &text);
    });
}

fn check(listener: &Listener<'_>, text: &str) {
    let understood = listener.understand(text);
    // That it is understood alike every time is asked of some texts only, as it takes as long again.
    if text.len().is_multiple_of(8) {
        assert_eq!(understood, listener.understand(text));
    }
    match understood {
        Ok(utterance) => {
            for command in &utterance.commands {
                assert!(text.get(command.span.clone()).is_some(), "{text:?}");
                let vocabulary = listener_vocabulary();
                vocabulary
                    .with(|v| command.sentence.check(v))
                    .expect("the unit can take it");
                let says = !command.sentence.words().is_empty() || !command.pointed.is_empty();
                assert!(says, "{text:?}");
            }
            let _ = understanding::of(text, utterance);
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

fn listener_vocabulary() -> &'static std::thread::LocalKey<deictic_core::large::Vocabulary> {
    thread_local! {
        static VOCABULARY: deictic_core::large::Vocabulary = Lexicon::tabletop()
            .expect("the built-in vocabulary is sound")
            .vocabulary()
            .clone();
    }
    &VOCABULARY
}
