//! What has a moving arm stand still, whatever the vocabulary calls its stop and however it is written.
//!
//! Standing still harms nobody, so a slip of the fingers, a drawn-out word and the language's own words count as well as
//! the vocabulary's.

use deictic_core::category::Category;
use strsim::osa_distance;

use crate::language::Utterance;
use crate::language::pack::Pack;
use crate::language::token::fold;
use crate::vocabulary::Lexicon;

/// Letters that a word has at least when it still counts with a slip in it: of three, every third word would do.
const LETTERS: usize = 4;

/// A language's own words for standing still.
#[derive(Clone, Debug, Default)]
pub struct Halting {
    phrases: Vec<Vec<String>>,
}

impl Halting {
    /// The words of a language; none of one that lists none.
    #[must_use]
    pub fn of(pack: &Pack) -> Self {
        let phrases = pack.halt.iter().map(|phrase| words(phrase));
        Self {
            phrases: phrases.filter(|phrase| !phrase.is_empty()).collect(),
        }
    }

    /// Whether one of them is in a text, whatever else it says.
    #[must_use]
    pub fn is_in(&self, text: &str) -> bool {
        let said = words(text);
        let mut phrases = self.phrases.iter();
        phrases.any(|phrase| said.windows(phrase.len()).any(|w| w == phrase))
    }

    /// Whether a text of one word is one of them but for one slip of the fingers.
    #[must_use]
    pub fn is_like(&self, text: &str) -> bool {
        let long = |word: &str| word.chars().count() >= LETTERS;
        let said = words(text);
        let [said] = &said[..] else {
            return false;
        };
        let alike = |phrase: &[String]| match phrase {
            [word] => long(word) && osa_distance(word, said) <= 1,
            _ => false,
        };
        long(said) && self.phrases.iter().any(|phrase| alike(phrase))
    }
}

/// Whether one of an utterance's actions is likeliest the vocabulary's stop, however likely that is.
#[must_use]
pub fn is_likely_stop(utterance: &Utterance, lexicon: &Lexicon) -> bool {
    let stop = lexicon.vocabulary().stop();
    let mut commands = utterance.commands.iter();
    stop.is_some() && commands.any(|command| command.best(Category::ACTION) == stop)
}

/// The words of a text, each letter that is drawn out written once: "nooo".
fn words(text: &str) -> Vec<String> {
    let text = fold(text);
    let words = text.split(|c: char| !c.is_alphanumeric());
    let short = |word: &str| {
        let mut letters: Vec<char> = word.chars().collect();
        letters.dedup();
        letters.into_iter().collect::<String>()
    };
    words.filter(|w| !w.is_empty()).map(short).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::Listener;

    #[test]
    fn the_language_has_words_of_its_own() {
        let halting = Halting::of(&Pack::built_in("en").unwrap());
        for text in ["Stop!", "nooo", "Whoooa", "oh, watch out", "that's wrong"] {
            assert!(halting.is_in(text), "{text}");
        }
        for text in ["", "pick the can", "nothing", "carefully", "stopper"] {
            assert!(!halting.is_in(text), "{text}");
        }
        for text in ["stpo", "abrot", "freez", "hlat"] {
            assert!(halting.is_like(text), "{text}");
        }
        for text in ["", "on", "pick", "stpo it"] {
            assert!(!halting.is_like(text), "{text}");
        }
    }

    #[test]
    fn a_misspelt_stop_is_likeliest_a_stop() {
        let lexicon = Lexicon::tabletop().unwrap();
        let listener = Listener::new(&lexicon).unwrap();
        let likely = |text| is_likely_stop(&listener.understand(text).unwrap(), &lexicon);
        for text in ["stop", "stpo", "stopp", "sotp", "stap", "haltt", "freez"] {
            assert!(likely(text), "{text}");
        }
        for text in ["pick the can", "stack the cup on the foam", "thanks"] {
            assert!(!likely(text), "{text}");
        }
    }
}
