//! What a typed or spoken text asks for: sentences for the unit, or nothing and why.

use deictic_core::category::Category;
use deictic_core::fuse::says_clearly;
use deictic_core::large::Sentence;
use deictic_core::profile::Profile;

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
        "there is no command in it".to_owned()
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
