//! The person's answer to the unit's question, from what they typed.

mod words;

use deictic_core::category::Category;
use deictic_core::decide::{Kind, Question};
use deictic_core::large::{Sentence, Word};
use deictic_core::sentence::{LANGUAGE, SentenceError};

use crate::language::{LanguageError, Listener, Why};
use crate::understanding::{self, Understood};
use crate::vocabulary::Lexicon;
use words::Words;

/// What a text that was typed while a question is open comes to.
#[derive(Clone, Debug, PartialEq)]
pub enum Reply {
    /// It answers the question.
    Answer(Box<Sentence>),
    /// It sounds like yes and like no this much, 0..=1, where that is what was asked for.
    YesOrNo([f32; 2]),
    /// It is a command of its own, and the question is forgotten.
    Command(Understood),
    /// Nothing of what was asked about is meant.
    Neither,
    /// It does not say which: "I don't know", "both", a yes to several. The question is asked again.
    Unclear,
}

/// Takes a text for an answer to `question` when it names one of the asked category's options, for a
/// yes or no where there is but one candidate, for none where it names nothing, and for a command of its own
/// otherwise.
///
/// # Errors
/// [`LanguageError`] for a text that is not understood; the question stays open.
pub fn reply(
    text: &str,
    question: &Question,
    listener: &Listener<'_>,
    lexicon: &Lexicon,
) -> Result<Reply, LanguageError> {
    let said = text.trim().trim_matches(['.', '!', ',']).to_lowercase();
    let category = question.category;
    let words = Words::of(lexicon)?;
    let plain = words.plain(text);
    if words.unsure.contains(&plain) {
        return Ok(Reply::Unclear);
    }
    if words.is_none(&plain) {
        return Ok(Reply::Neither);
    }
    if question.kind == Kind::Confirm
        && let Some([yes, no]) = words.yes_or_no(&said)
    {
        let Some(more) = words.more(&plain) else {
            return Ok(Reply::YesOrNo([yes, no]));
        };
        // What is added may be the correction: "yes, the cup". A yes that goes on otherwise is none: "yes, but not now".
        return Ok(match reply(more, question, listener, lexicon) {
            Ok(Reply::Answer(answer)) => Reply::Answer(answer),
            Ok(Reply::Command(Understood::Commands(commands))) => {
                Reply::Command(Understood::Commands(commands))
            }
            Ok(Reply::Neither) => Reply::Neither,
            // "No, yes."
            Ok(Reply::YesOrNo([y, n])) if (y > n) != (yes > no) => Reply::Unclear,
            _ if no > yes => Reply::YesOrNo([yes, no]),
            _ => Reply::Unclear,
        });
    }
    if words.no.contains(&plain) {
        return Ok(Reply::Neither);
    }
    if words.yes.contains(&plain) {
        return Ok(match question.candidates[..] {
            [only] => Reply::Answer(Box::new(certainly(category, only, lexicon)?)),
            _ => Reply::Unclear,
        });
    }
    let entries = lexicon.entries(category).iter();
    let named = entries.enumerate().find(|(_, entry)| {
        entry.name.to_lowercase() == said || entry.spoken().any(|word| word == said)
    });
    if let Some((option, _)) = named {
        let option = u8::try_from(option).unwrap_or(u8::MAX);
        return Ok(Reply::Answer(Box::new(certainly(
            category, option, lexicon,
        )?)));
    }
    let utterance = listener.understand(text)?;
    if let [command] = &utterance.commands[..] {
        let words = command.sentence.words();
        let speaks_of = |c| {
            words
                .iter()
                .any(|w| w.is_present() && w.category() == Some(c))
        };
        if speaks_of(category) && (category == Category::ACTION || !speaks_of(Category::ACTION)) {
            let mut answer = Sentence::new(LANGUAGE);
            for word in words.iter().filter(|w| w.category() == Some(category)) {
                answer.push(word.clone())?;
            }
            let others = words.iter().filter(|w| w.is_present()).count();
            if others == 1 || category != Category::ACTION {
                return Ok(Reply::Answer(Box::new(answer)));
            }
        }
    }
    let talk = utterance.aside.iter().all(|aside| aside.why == Why::Talk);
    if utterance.commands.is_empty() && talk {
        return Ok(Reply::Unclear);
    }
    Ok(Reply::Command(understanding::of(text, utterance)))
}

/// A sentence of one word that is certainly this option.
///
/// # Errors
/// [`SentenceError`] for an option that the lexicon does not have.
pub fn certainly(
    category: Category,
    option: u8,
    lexicon: &Lexicon,
) -> Result<Sentence, SentenceError> {
    let mut likelihoods = vec![0.0; lexicon.entries(category).len()];
    match likelihoods.get_mut(usize::from(option)) {
        Some(own) => *own = 1.0,
        None => return Err(SentenceError::UnknownCategory { word: 0 }),
    }
    let mut sentence = Sentence::new(LANGUAGE);
    sentence.push(Word::certain(category, &likelihoods)?)?;
    Ok(sentence)
}

#[cfg(test)]
mod tests {
    use super::*;
    use deictic_core::decide::{Kind, Reason};
    use deictic_core::math::argmax;

    fn ask(category: Category, candidates: &[u8]) -> Question {
        Question {
            kind: Kind::Which,
            action: None,
            category,
            reason: Reason::SeveralClear,
            candidates: candidates.iter().copied().collect(),
        }
    }

    fn answered(text: &str, question: &Question) -> Option<(Category, usize)> {
        let lexicon = Lexicon::tabletop().unwrap();
        let listener = Listener::new(&lexicon).unwrap();
        match reply(text, question, &listener, &lexicon).unwrap() {
            Reply::Answer(sentence) => {
                let word = &sentence.words()[0];
                Some((word.category()?, argmax(word.likelihoods())?))
            }
            _ => None,
        }
    }

    #[test]
    fn a_name_a_synonym_and_a_phrase_answer() {
        let which = ask(Category::OBJECT, &[0, 1]);
        for text in ["cup", "Mug.", "the cup", "the cup, please"] {
            assert_eq!(
                answered(text, &which),
                Some((Category::OBJECT, 1)),
                "{text}"
            );
        }
        let what = ask(Category::ACTION, &[3, 4]);
        assert_eq!(answered("pick", &what), Some((Category::ACTION, 3)));
        assert_eq!(
            answered("put it into", &ask(Category::ACTION, &[])).map(|a| a.1),
            Some(7)
        );
    }

    #[test]
    fn yes_means_the_only_candidate() {
        let bowl = ask(Category::STORAGE, &[3]);
        assert_eq!(answered("yes", &bowl), Some((Category::STORAGE, 3)));
        let lexicon = Lexicon::tabletop().unwrap();
        let listener = Listener::new(&lexicon).unwrap();
        for text in ["yep", "Yeah!", "ok", "yes, please"] {
            assert_eq!(
                answered(text, &bowl),
                Some((Category::STORAGE, 3)),
                "{text}"
            );
        }
        for text in ["no", "Nope.", "none of them"] {
            let no = reply(text, &bowl, &listener, &lexicon);
            assert_eq!(no, Ok(Reply::Neither), "{text}");
        }
        // One that names something else is no yes to it.
        assert_eq!(
            answered("yes, the drawer", &bowl),
            Some((Category::STORAGE, 0))
        );
    }

    #[test]
    fn what_does_not_say_which_is_no_answer_and_forbids_nothing() {
        let lexicon = Lexicon::tabletop().unwrap();
        let listener = Listener::new(&lexicon).unwrap();
        let which = ask(Category::OBJECT, &[0, 1]);
        let confirm = Question {
            kind: Kind::Confirm,
            ..which.clone()
        };
        for text in [
            "I don't know",
            "I don\u{2019}t know.",
            "both",
            "maybe",
            "not sure",
            "you choose",
            "hmm",
        ] {
            for question in [&which, &confirm] {
                let unclear = reply(text, question, &listener, &lexicon);
                assert_eq!(unclear, Ok(Reply::Unclear), "{text}");
            }
        }
        for text in ["yes", "yep", "ok"] {
            assert_eq!(
                reply(text, &which, &listener, &lexicon),
                Ok(Reply::Unclear),
                "{text}"
            );
        }
    }

    #[test]
    fn czech_answers_too() {
        let text = include_str!("../data/language/tabletop-cs.toml");
        let lexicon = Lexicon::parse("tabletop-cs.toml", text).unwrap();
        let listener = Listener::new(&lexicon).unwrap();
        let (one, two) = (ask(Category::OBJECT, &[0]), ask(Category::OBJECT, &[0, 1]));
        let answer = |text, question| reply(text, question, &listener, &lexicon).unwrap();
        assert!(matches!(answer("Ano, prosím", &one), Reply::Answer(_)));
        assert_eq!(answer("ne", &one), Reply::Neither);
        for text in ["nevím", "Je to jedno.", "obojí", "ano"] {
            assert_eq!(answer(text, &two), Reply::Unclear, "{text}");
        }
        assert!(matches!(answer("hrnek", &two), Reply::Answer(_)));
    }

    #[test]
    fn a_yes_or_no_is_heard_as_likelihoods() {
        let lexicon = Lexicon::tabletop().unwrap();
        let listener = Listener::new(&lexicon).unwrap();
        let confirm = Question {
            kind: Kind::Confirm,
            ..ask(Category::OBJECT, &[0, 1])
        };
        let heard = |text| reply(text, &confirm, &listener, &lexicon).unwrap();
        for (text, is_yes) in [
            ("yes", true),
            ("Yes, please.", true),
            ("yess", true),
            ("no", false),
        ] {
            let Reply::YesOrNo([yes, no]) = heard(text) else {
                panic!("{text}")
            };
            assert_eq!(yes > no, is_yes, "{text}: {yes} {no}");
        }
        assert!(matches!(heard("the cup"), Reply::Answer(_)));
        assert!(matches!(heard("push the box"), Reply::Command(_)));
    }

    #[test]
    fn a_command_of_its_own_is_no_answer() {
        let lexicon = Lexicon::tabletop().unwrap();
        let listener = Listener::new(&lexicon).unwrap();
        let which = ask(Category::OBJECT, &[0, 1]);
        let new = reply("push the box", &which, &listener, &lexicon).unwrap();
        assert!(matches!(new, Reply::Command(Understood::Commands(c)) if c.len() == 1));
        let never = reply("do not pick the cup", &which, &listener, &lexicon).unwrap();
        assert!(matches!(never, Reply::Command(Understood::Nothing(_))));
        assert!(reply("xyzzy", &which, &listener, &lexicon).is_err());
    }
}
