//! The person's answer to the unit's question, from what they typed.

use deictic_core::category::Category;
use deictic_core::decide::{Kind, Question};
use deictic_core::large::{Sentence, Word};
use deictic_core::sentence::{LANGUAGE, SentenceError};

use crate::language::likeness::Ear;
use crate::language::pack::Pack;
use crate::language::token::fold;
use crate::language::{LanguageError, Listener};
use crate::understanding::{self, Understood};
use crate::vocabulary::Lexicon;

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
}

/// Takes a text for an answer to `question` when it names one of the asked category's options, for a
/// yes or no where there is but one candidate, and for a command of its own otherwise.
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
    if question.kind == Kind::Confirm
        && let Some(likelihoods) = yes_or_no(&said, lexicon)
    {
        return Ok(Reply::YesOrNo(likelihoods));
    }
    if said == "no" || said == "none" || said == "neither" {
        return Ok(Reply::Neither);
    }
    if let ["yes" | "yeah" | "ok", ..] = said.split_whitespace().collect::<Vec<_>>()[..]
        && let [only] = question.candidates[..]
    {
        return Ok(Reply::Answer(Box::new(certainly(category, only, lexicon)?)));
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
    Ok(Reply::Command(understanding::of(text, utterance)))
}

/// How alike something has to be to a yes or a no to be one.
const ALIKE: f64 = 0.6;

/// How much a text sounds like a yes and like a no in the vocabulary's language; `None` when like
/// neither. Of several words the first says it: "yes, please".
#[must_use]
pub fn yes_or_no(said: &str, lexicon: &Lexicon) -> Option<[f32; 2]> {
    let pack = Pack::of(lexicon.language()).ok()?;
    let speech = pack.speech.as_ref()?;
    let ear = Ear::new(pack.phonetic);
    let first = said
        .split(|c: char| !c.is_alphanumeric())
        .find(|w| !w.is_empty())?;
    let heard = [ear.listen(&fold(said)), ear.listen(&fold(first))];
    let likeness = |words: &[String]| {
        let sounds = words.iter().map(|word| ear.listen(&fold(word)));
        sounds
            .flat_map(|sound| heard.each_ref().map(|heard| ear.likeness(heard, &sound)))
            .fold(0.0, f64::max)
    };
    let [yes, no] = [likeness(&speech.yes), likeness(&speech.no)];
    (yes.max(no) >= ALIKE).then_some([yes as f32, no as f32])
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
        let no = reply("no", &bowl, &listener, &lexicon);
        assert_eq!(no, Ok(Reply::Neither));
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
