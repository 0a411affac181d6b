//! What a typed or spoken text asks for: sentences for the unit, or nothing and why.

use deictic_core::large::Sentence;

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
        format!("\"{part}\" {why}")
    });
    let all: Vec<_> = parts.collect();
    Understood::Nothing(if all.is_empty() {
        "there is no command in it".to_owned()
    } else {
        all.join("; ")
    })
}
