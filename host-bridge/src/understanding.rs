//! What a typed or spoken text asks for: sentences for the unit, or nothing and why.

use deictic_core::category::Category;
use deictic_core::fuse::says_clearly;
use deictic_core::large::Sentence;
use deictic_core::profile::Profile;

use crate::language::pack::Pack;
use crate::language::token::fold;
use crate::language::{LanguageError, Listener, Utterance, Why};
use crate::vocabulary::Lexicon;

/// What a text asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Understood {
    /// These, one after the other; never empty.
    Commands(Vec<Sentence>),
    /// Nothing, for this reason: it forbade, asked or told something. A gesture shown with it is
    /// not to be acted upon either.
    Nothing(String),
}

/// What an utterance has to do with what is shown and what is being done when it comes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bearing {
    /// Nothing: it is a command of its own.
    Apart,
    /// It forbids it or takes it back: "don't", "no", "never mind".
    Refuses,
    /// It puts something else in the place of a part of it: "no, the cube".
    Corrects,
    /// It asks or tells something, depends on something, or is talk: what is shown with it is no command either.
    Aside,
}

/// What an utterance that was made of `text` has to do with what is shown and what is being done.
#[must_use]
pub fn bearing(text: &str, utterance: &Utterance, lexicon: &Lexicon) -> Bearing {
    let forbids = |why| matches!(why, Why::Negated | Why::Corrected);
    let mut aside = utterance.aside.iter().map(|aside| aside.why);
    match utterance.commands.first() {
        Some(command) if command.corrects => Bearing::Corrects,
        Some(_) if aside.any(|why| why == Why::Negated) => Bearing::Refuses,
        Some(_) => Bearing::Apart,
        // "No" and "never mind" leave nothing behind.
        None if utterance.aside.is_empty() || aside.clone().any(forbids) => Bearing::Refuses,
        None if aside.all(|why| why == Why::Talk) => match begins_with_no(text, lexicon) {
            true => Bearing::Refuses,
            false => Bearing::Aside,
        },
        None => Bearing::Aside,
    }
}

/// "No, thanks".
fn begins_with_no(text: &str, lexicon: &Lexicon) -> bool {
    let pack = Pack::of(lexicon).ok();
    let speech = pack.and_then(|pack| pack.speech);
    let first = text
        .split(|c: char| !c.is_alphanumeric())
        .find(|w| !w.is_empty());
    let (Some(speech), Some(first)) = (speech, first) else {
        return false;
    };
    let first = fold(first);
    speech.no.iter().any(|no| fold(no) == first)
}

/// What a text asks for, over a vocabulary.
///
/// # Errors
/// [`LanguageError`] for a text that is not understood; nothing of it is to be done.
pub fn understand(text: &str, lexicon: &Lexicon) -> Result<Understood, LanguageError> {
    Ok(of(text, Listener::new(lexicon)?.understand(text)?))
}

/// What an utterance that was made of `text` asks for.
#[must_use]
pub fn of(text: &str, utterance: Utterance) -> Understood {
    if !utterance.commands.is_empty() {
        let commands = utterance.commands.into_iter();
        return Understood::Commands(commands.map(|c| c.sentence).collect());
    }
    let parts = utterance.aside.iter().map(|aside| {
        let part = text.get(aside.span.clone()).unwrap_or(text).trim();
        let why = match aside.why {
            Why::Negated => "is forbidden, so it is not done",
            Why::Question => "is a question, not a command",
            Why::Conditional => "depends on something nobody checks",
            Why::Told => "tells something, and commands nothing",
            Why::Own => "is what you mean to do: to have it done, say \"I want you to\" and what",
            Why::Timed => {
                "is for another time, and nothing is kept for later: say it when it is to be done"
            }
            Why::Talk => "commands nothing",
            Why::Corrected => "was taken back",
        };
        let request = aside.request.clone().and_then(|span| text.get(span));
        match request {
            None => format!("\"{part}\" {why}"),
            Some(request) => format!("\"{part}\" {why}: to have it done, say \"{request}\""),
        }
    });
    let all: Vec<_> = parts.collect();
    Understood::Nothing(if all.is_empty() {
        format!("\"{}\" commands nothing", text.trim())
    } else {
        all.join("; ")
    })
}

/// Whether a sentence says nothing but the vocabulary's stop, and says it clearly: that is carried
/// out before anyone is asked.
#[must_use]
pub fn is_stop(sentence: &Sentence, lexicon: &Lexicon, profile: &Profile) -> bool {
    let Some(stop) = lexicon.vocabulary().stop() else {
        return false;
    };
    let mut present = sentence.words().iter().filter(|word| word.is_present());
    match (present.next(), present.next()) {
        (Some(word), None) => says_clearly(word, Category::ACTION, stop, profile),
        _ => false,
    }
}

/// Whether a text has a word of the vocabulary's stop in it, whatever else it says. Standing still is
/// always safe, so a moving robot does not wait for the rest to be understood.
#[must_use]
pub fn mentions_stop(text: &str, lexicon: &Lexicon) -> bool {
    let stop = lexicon.vocabulary().stop().map(usize::from);
    let Some(entry) = stop.and_then(|s| lexicon.entries(Category::ACTION).get(s)) else {
        return false;
    };
    let text = text.to_lowercase();
    let words: Vec<_> = text
        .split(|c: char| !c.is_alphanumeric())
        .filter(|w| !w.is_empty())
        .collect();
    entry.spoken().any(|spoken| {
        let spoken: Vec<_> = spoken.split_whitespace().collect();
        !spoken.is_empty() && words.windows(spoken.len()).any(|w| w == spoken)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_is_heard_in_any_company() {
        let lexicon = Lexicon::tabletop().unwrap();
        for text in [
            "stop",
            "STOP!!",
            "please stop it xyzzy",
            "no, halt",
            "don't stop",
        ] {
            assert!(mentions_stop(text, &lexicon), "{text}");
        }
        for text in ["", "pick the can", "stopper", "non-stick"] {
            assert!(!mentions_stop(text, &lexicon), "{text}");
        }
    }

    #[test]
    fn what_refuses_and_corrects_is_told_from_what_does_not() {
        let lexicon = Lexicon::tabletop().unwrap();
        let listener = Listener::new(&lexicon).unwrap();
        let of = |text| bearing(text, &listener.understand(text).unwrap(), &lexicon);
        for text in [
            "no",
            "No!",
            "don't",
            "don't pick the cup",
            "never mind",
            "no, thanks",
            "don't pick the cup, pick the can",
            "not the cup",
        ] {
            assert_eq!(of(text), Bearing::Refuses, "{text}");
        }
        for text in ["no, the cube", "actually, the cube", "no, push the box"] {
            assert_eq!(of(text), Bearing::Corrects, "{text}");
        }
        for text in [
            "could you pick the cup?",
            "what is that?",
            "I picked the cup",
            "thanks",
            "lunch break at noon",
            "yes",
            "ok",
            "um",
        ] {
            assert_eq!(of(text), Bearing::Aside, "{text}");
        }
        for text in ["pick the cup", "pick the cup, no, the can"] {
            assert_eq!(of(text), Bearing::Apart, "{text}");
        }
    }

    #[test]
    fn only_a_stop_alone_is_one_without_asking() {
        let lexicon = Lexicon::tabletop().unwrap();
        let sentence = |text| match understand(text, &lexicon).unwrap() {
            Understood::Commands(mut s) => s.remove(0),
            Understood::Nothing(why) => panic!("{why}"),
        };
        let profile = Profile::PAPER;
        assert!(is_stop(&sentence("stop"), &lexicon, &profile));
        assert!(!is_stop(&sentence("pick the cup"), &lexicon, &profile));
    }

    #[test]
    fn what_is_forbidden_or_asked_is_nothing() {
        let lexicon = Lexicon::tabletop().unwrap();
        for text in ["do not pick the cup", "did you pick the cup?"] {
            let understood = understand(text, &lexicon).unwrap();
            assert!(matches!(understood, Understood::Nothing(_)), "{text}");
        }
    }
}
