//! What a made-up person is to do with the hand, as it is written: `thumbsup cup drawer`.

use deictic_core::category::Category;
use deictic_core::gesture::shape::Shape;
use thiserror::Error;

use super::movement::GESTURES;
use super::session::Act;
use crate::diagnose::{did_you_mean, quoted};
use crate::scene::Tabletop;
use crate::vocabulary::Lexicon;

/// A word that nobody can show.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("\"{word}\" is no shape, no movement and nothing on the table")]
pub struct ActingError {
    word: String,
    known: Vec<String>,
}

impl ActingError {
    /// What the person can do about it.
    #[must_use]
    pub fn remedy(&self) -> String {
        let known = || self.known.iter().map(String::as_str);
        format!(
            "{}there are {}",
            did_you_mean(&self.word, known()),
            quoted(known())
        )
    }
}

/// The acts that these words stand for: shapes, movements, and things to point at, in their order,
/// with a closed hand between every two.
///
/// # Errors
/// [`ActingError`] for the first word that is none of them.
pub fn acts(text: &str, table: &Tabletop, lexicon: &Lexicon) -> Result<Vec<Act>, ActingError> {
    let mut acts = Vec::new();
    for word in text.split_whitespace() {
        if !acts.is_empty() {
            acts.push(Act::Show(Shape::Grab));
        }
        acts.push(act(word, table, lexicon)?);
    }
    Ok(acts)
}

fn act(word: &str, table: &Tabletop, lexicon: &Lexicon) -> Result<Act, ActingError> {
    if let Some(shape) = Shape::ALL.into_iter().find(|s| s.name() == word) {
        return Ok(Act::Show(shape));
    }
    if GESTURES.contains(&word) {
        return Ok(Act::Move(word.to_owned()));
    }
    let thing = [Category::OBJECT, Category::STORAGE]
        .into_iter()
        .find_map(|category| table.find(category, lexicon.option(category, word)?));
    let known = || {
        let things = table.scene().entities().iter();
        let shapes = Shape::ALL.iter().map(|s| s.name().to_owned());
        things
            .map(|t| lexicon.option_name(t.category, t.option))
            .chain(shapes)
            .chain(GESTURES.map(str::to_owned))
            .collect()
    };
    match thing {
        Some(thing) => Ok(Act::Point(thing.position)),
        None => Err(ActingError {
            word: word.to_owned(),
            known: known(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SceneFile;

    #[test]
    fn words_become_acts_with_a_fist_between_them() {
        let lexicon = Lexicon::tabletop().unwrap();
        let table = SceneFile::table().unwrap().tabletop(&lexicon).unwrap();
        let got = acts("thumbsup cup swipe-up", &table, &lexicon).unwrap();
        let fist = Act::Show(Shape::Grab);
        let cup = Act::Point([0.40, -0.12, 0.05]);
        let expected = [
            Act::Show(Shape::ThumbsUp),
            fist.clone(),
            cup,
            fist,
            Act::Move("swipe-up".into()),
        ];
        assert_eq!(got, expected);
        let error = acts("thumbsup cap", &table, &lexicon).unwrap_err();
        assert!(error.remedy().contains("can"), "{}", error.remedy());
    }
}
