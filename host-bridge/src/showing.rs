//! Gesture sentences that are typed instead of shown, for use without a hand sensor.
//!
//! Words are separated by spaces: an option's name or one of its gestures (`pick`, `pinch`, `can`),
//! with its category in front where the name alone could be two things (`storage:bowl`), with
//! alternatives and their likelihoods where the recogniser is in two minds (`pick|push can`,
//! `pick=0.7|push=0.6 can=0.8`), or a measure (`5cm`, `30deg`).

use deictic_core::category::Category;
use deictic_core::large::{Sentence, Word};
use deictic_core::sentence::{GESTURE, SentenceError};
use thiserror::Error;

use crate::diagnose::{did_you_mean, quoted};
use crate::explain;
use crate::vocabulary::Lexicon;

/// Why a typed gesture sentence is none.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ShowingError {
    /// Nothing was typed.
    #[error("nothing is shown")]
    Empty,
    /// Neither an option nor a gesture.
    #[error("\"{word}\" is no gesture and no thing to point at")]
    Unknown {
        /// What was typed.
        word: String,
        /// What can be shown.
        known: Vec<String>,
    },
    /// Alternatives of one word that are of different categories.
    #[error("\"{0}\" mixes categories")]
    Mixed(String),
    /// A likelihood that is not a number in 0..=1.
    #[error("\"{0}\" is not a likelihood in 0..=1")]
    BadLikelihood(String),
    /// A measure that the vocabulary has no category for.
    #[error("\"{word}\" is {category}, which this vocabulary does not have")]
    NoCategory {
        /// What was typed.
        word: String,
        /// What it would be.
        category: &'static str,
    },
    /// The core refused it.
    #[error("{}", explain::sentence_error(.0).what)]
    Refused(SentenceError),
}

impl From<SentenceError> for ShowingError {
    fn from(error: SentenceError) -> Self {
        Self::Refused(error)
    }
}

impl ShowingError {
    /// What the person can do about it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Empty => "type an action and what to point at, for example \"pick can\"".into(),
            Self::Unknown { word, known } => format!(
                "{}one can show {}",
                did_you_mean(word, known.iter().map(String::as_str)),
                quoted(known.iter().map(String::as_str))
            ),
            Self::Mixed(_) => {
                "the alternatives of one word are of one category: \"pick|push can|cup\"".into()
            }
            Self::BadLikelihood(_) => "write a number from 0 to 1: \"pick=0.7|push=0.6\"".into(),
            Self::NoCategory { category, .. } => {
                format!("add a [[parameter]] with category = \"{category}\" to the vocabulary")
            }
            Self::Refused(error) => explain::sentence_error(error).remedy,
        }
    }
}

/// The gesture sentence that was typed.
///
/// # Errors
/// [`ShowingError`] for the first word that is none.
pub fn showing(text: &str, lexicon: &Lexicon) -> Result<Sentence, ShowingError> {
    let mut sentence = Sentence::new(GESTURE);
    let mut taken = Vec::new();
    for typed in text.split_whitespace() {
        let word = match measure(typed, lexicon)? {
            Some(word) => word,
            None => alternatives(typed, lexicon, &taken)?,
        };
        taken.extend(word.category());
        sentence.push(word)?;
    }
    if sentence.words().is_empty() {
        return Err(ShowingError::Empty);
    }
    Ok(sentence)
}

/// A word of one or several alternatives; categories that were `taken` by earlier words come last
/// when a name stands in several.
fn alternatives(typed: &str, lexicon: &Lexicon, taken: &[Category]) -> Result<Word, ShowingError> {
    let mut found: Option<(Category, Vec<f32>)> = None;
    for alternative in typed.split('|') {
        let (name, likelihood) = match alternative.split_once('=') {
            None => (alternative, 1.0),
            Some((name, number)) => {
                let likelihood = number.parse().ok().filter(|x| (0.0..=1.0).contains(x));
                let bad = || ShowingError::BadLikelihood(number.to_owned());
                (name, likelihood.ok_or_else(bad)?)
            }
        };
        let meant = matches(name, lexicon);
        let category = match &found {
            Some((category, _)) => *category,
            None => {
                let free = meant.iter().find(|(c, _)| !taken.contains(c));
                free.or(meant.first())
                    .map(|(c, _)| *c)
                    .ok_or_else(|| unknown(name, lexicon))?
            }
        };
        if meant.is_empty() {
            return Err(unknown(name, lexicon));
        }
        let options = lexicon.entries(category).len();
        let (_, word) = found.get_or_insert_with(|| (category, vec![0.0; options]));
        let mut any = false;
        for (_, option) in meant.iter().filter(|(c, _)| *c == category) {
            if let Some(w) = word.get_mut(*option) {
                *w = likelihood;
                any = true;
            }
        }
        if !any {
            return Err(ShowingError::Mixed(typed.to_owned()));
        }
    }
    let (category, likelihoods) = found.ok_or(ShowingError::Empty)?;
    Ok(Word::certain(category, &likelihoods)?)
}

/// All options that a name or gesture can mean, in the order of the categories.
fn matches(name: &str, lexicon: &Lexicon) -> Vec<(Category, usize)> {
    let (only, name) = match name.split_once(':') {
        Some((category, name)) => (Some(category), name),
        None => (None, name),
    };
    let mut found = Vec::new();
    for list in lexicon.categories() {
        if list.quantity_only || only.is_some_and(|only| only != list.name) {
            continue;
        }
        for (i, entry) in list.entries.iter().enumerate() {
            if entry.name == name || entry.gestures.iter().any(|g| g == name) {
                found.push((list.category, i));
            }
        }
    }
    found
}

fn unknown(word: &str, lexicon: &Lexicon) -> ShowingError {
    let lists = lexicon.categories().iter().filter(|c| !c.quantity_only);
    ShowingError::Unknown {
        word: word.to_owned(),
        known: lists
            .flat_map(|c| c.entries.iter().map(|e| e.name.clone()))
            .collect(),
    }
}

/// Units of a typed measure: what it ends with, which category it is of, how much one is in metres
/// or radians.
const UNITS: [(&str, Category, &str, f32); 5] = [
    ("mm", Category::DISTANCE, "distance", 0.001),
    ("cm", Category::DISTANCE, "distance", 0.01),
    ("m", Category::DISTANCE, "distance", 1.0),
    (
        "deg",
        Category::ANGLE,
        "angle",
        std::f32::consts::PI / 180.0,
    ),
    ("rad", Category::ANGLE, "angle", 1.0),
];

fn measure(typed: &str, lexicon: &Lexicon) -> Result<Option<Word>, ShowingError> {
    let read = |unit: &str| typed.strip_suffix(unit)?.parse::<f32>().ok();
    let found = UNITS
        .iter()
        .find_map(|(unit, category, called, scale)| Some((category, called, read(unit)? * scale)));
    let Some((&category, &called, quantity)) = found else {
        return Ok(None);
    };
    if !lexicon.is_quantity_only(category) {
        return Err(ShowingError::NoCategory {
            word: typed.to_owned(),
            category: called,
        });
    }
    Ok(Some(
        Word::certain(category, &[1.0])?.with_quantity(quantity),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Result<Vec<(Category, Vec<f32>)>, ShowingError> {
        let lexicon = Lexicon::tabletop().unwrap();
        let sentence = showing(text, &lexicon)?;
        let words = sentence.words().iter();
        Ok(words
            .map(|w| (w.category().unwrap(), w.likelihoods().to_vec()))
            .collect())
    }

    #[test]
    fn names_and_gestures_are_options() {
        let pick_can = words("pick can").unwrap();
        assert_eq!(pick_can[0].1, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(
            pick_can[1],
            (Category::OBJECT, vec![1.0, 0.0, 0.0, 0.0, 0.0])
        );
        assert_eq!(words("pinch can").unwrap(), pick_can);
        assert_eq!(words(" can  pinch").unwrap()[0], pick_can[1]);
    }

    #[test]
    fn a_recogniser_in_two_minds_can_be_typed() {
        let word = &words("pick=0.7|push can|cup").unwrap()[0].1;
        assert_eq!((word[3], word[4]), (0.7, 1.0));
        let both = &words("can|cup").unwrap()[0].1;
        assert_eq!(both[..2], [1.0, 1.0]);
    }

    #[test]
    fn measures_carry_their_quantity() {
        let lexicon = Lexicon::tabletop().unwrap();
        let up = showing("move-up 5cm", &lexicon).unwrap();
        let distance = &up.words()[1];
        assert_eq!(distance.category(), Some(Category::DISTANCE));
        assert!((distance.quantity().unwrap() - 0.05).abs() < 1e-6);
        let angle = showing("90deg", &lexicon).unwrap().words()[0].quantity();
        assert!((angle.unwrap() - core::f32::consts::FRAC_PI_2).abs() < 1e-6);
        assert_eq!(
            showing("infm", &lexicon)
                .unwrap()
                .check(lexicon.vocabulary()),
            Err(SentenceError::BadQuantity { word: 0 })
        );
    }

    #[test]
    fn what_is_none_is_named() {
        assert_eq!(words(" "), Err(ShowingError::Empty));
        assert!(
            matches!(words("pick cann"), Err(ShowingError::Unknown { word, .. }) if word == "cann")
        );
        assert_eq!(
            words("pick|can"),
            Err(ShowingError::Mixed("pick|can".into()))
        );
        assert_eq!(
            words("pick=2"),
            Err(ShowingError::BadLikelihood("2".into()))
        );
        assert_eq!(
            words("pick=NaN"),
            Err(ShowingError::BadLikelihood("NaN".into()))
        );
        assert!(matches!(
            words("action:can"),
            Err(ShowingError::Unknown { .. })
        ));
        assert!(words("object:can").is_ok());
        let long = "can ".repeat(9);
        assert!(matches!(words(&long), Err(ShowingError::Refused(_))));
        assert!(words("pick=3").unwrap_err().remedy().contains("0 to 1"));
    }

    #[test]
    fn a_name_in_two_categories_takes_the_free_one() {
        let text = "name = \"x\"\n[[action]]\nname = \"stack\"\n[[object]]\nname = \"box\"\n[[storage]]\nname = \"box\"";
        let lexicon = Lexicon::parse("x", text).unwrap();
        let sentence = showing("stack box box", &lexicon).unwrap();
        let categories: Vec<_> = sentence.words().iter().filter_map(Word::category).collect();
        assert_eq!(
            categories,
            [Category::ACTION, Category::OBJECT, Category::STORAGE]
        );
    }
}
