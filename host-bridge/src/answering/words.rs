//! Answers that name nothing: yes, no, and "I don't know".

use crate::language::LanguageError;
use crate::language::likeness::Ear;
use crate::language::pack::Pack;
use crate::language::token::fold;
use crate::vocabulary::Lexicon;

/// How alike something has to be to a yes or a no to be one.
const ALIKE: f64 = 0.6;

/// The words of a language that answer without a name, folded.
pub(super) struct Words {
    ear: Ear,
    pub yes: Vec<String>,
    pub no: Vec<String>,
    pub unsure: Vec<String>,
    none: Vec<String>,
    polite: Vec<String>,
}

/// So many words of a list are compared by sound, the usual ones first.
const SHORT: usize = 3;

impl Words {
    /// Of a vocabulary's language.
    pub fn of(lexicon: &Lexicon) -> Result<Self, LanguageError> {
        let Pack {
            phonetic,
            answer,
            speech,
            polite,
            ..
        } = Pack::of(lexicon)?;
        let speech = speech.unwrap_or_default();
        let folded = |words: &[String]| words.iter().map(|word| fold(word)).collect::<Vec<_>>();
        Ok(Self {
            ear: Ear::new(phonetic),
            yes: folded(&[speech.yes, answer.yes].concat()),
            no: folded(&[speech.no, answer.no].concat()),
            unsure: folded(&answer.unsure),
            none: folded(&answer.none),
            polite: folded(&polite),
        })
    }

    /// The words of a text without punctuation, and without those that are only polite.
    pub fn plain(&self, text: &str) -> String {
        let text = fold(text);
        let words = text.split(|c: char| !c.is_alphanumeric() && c != '\'');
        let words = words.filter(|word| !word.is_empty() && !self.polite.iter().any(|p| p == word));
        words.collect::<Vec<_>>().join(" ")
    }

    /// Whether a text says that none of what was asked about is meant, whatever it adds.
    pub fn is_none(&self, plain: &str) -> bool {
        self.none.iter().any(|none| after(plain, none).is_some())
    }

    /// What a plain text says after the yes or the no that it begins with; `None` of one that says no more.
    pub fn more<'a>(&self, plain: &'a str) -> Option<&'a str> {
        let mut rest = plain;
        let mut lists = [&self.yes, &self.no].into_iter();
        let words = lists.find(|words| words.iter().any(|word| after(plain, word).is_some()));
        while let Some(words) = words {
            let known = words.iter().filter_map(|word| after(rest, word));
            // The longest of them: "yes, that is right".
            let Some(shorter) = known.min_by_key(|rest| rest.len()) else {
                break;
            };
            rest = shorter;
            if rest.is_empty() {
                return None;
            }
        }
        if rest.len() < plain.len() {
            return Some(rest);
        }
        // A first word that only sounds like one.
        let (_, rest) = plain.split_once(' ')?;
        Some(rest)
    }

    /// How much a text sounds like a yes and like a no; `None` when like neither. Of several words the first
    /// says it: "yes, please".
    pub fn yes_or_no(&self, said: &str) -> Option<[f32; 2]> {
        let first = said
            .split(|c: char| !c.is_alphanumeric())
            .find(|w| !w.is_empty())?;
        let plain = self.plain(said);
        let heard = self.ear.listen(&fold(first));
        // Against the short lists: each further word is one more to be mistaken for.
        let [yes, no] = [&self.yes, &self.no].map(|words| {
            let sounds = words.iter().take(SHORT).map(|word| self.ear.listen(word));
            let alike = sounds.map(|sound| self.ear.likeness(&heard, &sound));
            if words.contains(&plain) {
                1.0
            } else {
                alike.fold(0.0, f64::max)
            }
        });
        // As with other words: what is hardly alike is not to count as heard.
        let likelihood = |likeness: f64| likeness.powi(4) as f32;
        (yes.max(no) >= ALIKE).then_some([likelihood(yes), likelihood(no)])
    }
}

/// What a text says after the words that it begins with.
fn after<'a>(text: &'a str, words: &str) -> Option<&'a str> {
    let rest = text.strip_prefix(words)?;
    (rest.is_empty() || rest.starts_with(' ')).then(|| rest.trim_start())
}
