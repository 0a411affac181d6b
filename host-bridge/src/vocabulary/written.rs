//! What people say and show for an option, as written, held against what stands for others.

use std::ops::Range;

use deictic_core::category::Category;
use deictic_core::gesture::shape::Shape;
use deictic_core::gesture::stroke_table::NAMES;
use toml::Spanned;

use super::error::{Found, VocabularyProblem as Problem};
use super::file::{Choice, Name};
use super::{CategoryEntries, Entry};

/// An option as written.
pub(super) struct Written<'a> {
    pub name: &'a str,
    pub place: Range<usize>,
    pub words: &'a [Name],
    pub gestures: &'a [Name],
}

impl<'a> Written<'a> {
    /// Of an object, a storage, or an option of a parameter.
    pub fn of(choice: &'a Spanned<Choice>) -> Self {
        let Choice {
            name,
            words,
            gestures,
            place,
        } = choice.as_ref();
        let place = place.clone().unwrap_or_else(|| choice.span());
        Self {
            name,
            place,
            words,
            gestures,
        }
    }

    /// The option, with words and gestures that no other option of its category has.
    ///
    /// # Errors
    /// The first word or gesture that says nothing, or that another option has.
    pub fn entry(&self, list: &CategoryEntries) -> Found<Entry> {
        let named = (&self.place, self.name);
        let words = self.words.iter().map(|word| (word, word.as_ref().as_str()));
        let mut all = vec![(named.0.clone(), named.1)];
        all.extend(words.map(|(word, text)| (word.span(), text)));
        for (place, text) in all {
            if !text.contains(char::is_alphanumeric) {
                return Err((Some(place), Problem::EmptyWord(self.name.to_owned())));
            }
            let said = |other: &&Entry| other.spoken().any(|word| tidy(&word) == tidy(text));
            if let Some(other) = list.entries.iter().find(said) {
                return Err((Some(place), self.shared(text, other)));
            }
        }
        for gesture in self.gestures {
            self.check(gesture, list)
                .map_err(|problem| (Some(gesture.span()), problem))?;
        }
        let texts = |names: &[Name]| names.iter().map(|name| name.as_ref().clone()).collect();
        Ok(Entry {
            name: self.name.to_owned(),
            words: texts(self.words),
            gestures: texts(self.gestures),
        })
    }

    fn check(&self, gesture: &Name, list: &CategoryEntries) -> Result<(), Problem> {
        let name = gesture.as_ref();
        if name.trim().is_empty() {
            return Err(Problem::EmptyWord(self.name.to_owned()));
        }
        let reserved = [Shape::Grab, Shape::Point].map(Shape::name);
        if list.category == Category::ACTION && reserved.contains(&name.as_str()) {
            return Err(Problem::Reserved(name.clone()));
        }
        if let Some(other) = list.entries.iter().find(|e| e.gestures.contains(name)) {
            return Err(self.shared(name, other));
        }
        let known = Shape::ALL.map(Shape::name);
        let known = || known.into_iter().chain(NAMES);
        // What is like none of them may be a gesture of the user's own, or be typed only.
        let nearest = known().find(|known| is_slip(name, known));
        match nearest.filter(|_| !known().any(|known| known == name)) {
            None => Ok(()),
            Some(nearest) => Err(Problem::UnknownGesture {
                name: name.clone(),
                nearest,
            }),
        }
    }

    fn shared(&self, word: &str, other: &Entry) -> Problem {
        Problem::Shared {
            word: word.to_owned(),
            first: other.name.clone(),
            second: self.name.to_owned(),
        }
    }
}

/// Letters in one case with single spaces, as words are compared.
pub(super) fn tidy(text: &str) -> String {
    let text = text.replace(['-', '_'], " ").to_lowercase();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Whether a name is another with a slip: one letter more, less, or other, or two swapped; a figure makes
/// it a name of its own.
fn is_slip(name: &str, known: &str) -> bool {
    let letters = |text: &str| text.chars().count() >= 4 && !text.contains(char::is_numeric);
    letters(name) && letters(known) && strsim::osa_distance(name, known) == 1
}
