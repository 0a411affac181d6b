//! What can be wrong with a language pack.

use std::ops::Range;

use thiserror::Error;

use super::{Pack, Role};
use crate::diagnose::{Problem, did_you_mean, misspelt, quoted};
use crate::vocabulary::Lexicon;

/// The categories of quantities that every vocabulary can have.
const COMMON: [&str; 4] = ["distance", "direction", "angle", "amount"];

/// What is looked for, and why it may not be missing.
const NEEDED: [(Role, &str, &str); 2] = [
    (Role::Not, "not", "\"don't take the cup\" would take it"),
    (
        Role::Question,
        "question",
        "\"where is the cup\" would be a command",
    ),
];

/// What is wrong with a language pack.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PackProblem {
    /// The file cannot be read.
    #[error("it cannot be read: {0}")]
    Unreadable(String),
    /// It is not TOML, or not of this shape.
    #[error("{0}")]
    Syntax(String),
    /// No words that keep what is said from being done.
    #[error("`[role]` has no words for `{role}`, so {so}")]
    NoWords {
        /// Of which role.
        role: &'static str,
        /// What that leads to.
        so: &'static str,
    },
    /// A unit that is nothing, less than nothing, or not finite.
    #[error("a unit of {0} is none")]
    Factor(f64),
    /// A number or quantity that is not finite.
    #[error("{0} is no number that can be said")]
    NotFinite(f32),
    /// The name of a category that is almost one that there is.
    #[error("there is no category \"{name}\"")]
    UnknownCategory {
        /// What was written.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
}

impl Problem for PackProblem {
    fn remedy(&self) -> String {
        match self {
            Self::Unreadable(_) => "write the pack beside the vocabulary, as UTF-8".into(),
            Self::Syntax(message) => format!(
                "{}a pack is TOML with the tables of data/language/en.toml",
                misspelt(message)
            ),
            Self::NoWords { role, .. } => {
                format!("write the language's words for it: {role} = [\"...\"]")
            }
            Self::Factor(_) => {
                "write how many metres, radians or pieces one of it is: 0.01 for a centimetre"
                    .into()
            }
            Self::NotFinite(_) => "write a finite number".into(),
            Self::UnknownCategory { name, known } => {
                let known = || known.iter().map(String::as_str);
                format!(
                    "{}categories have English names: {}",
                    did_you_mean(name, known()),
                    quoted(known())
                )
            }
        }
    }
}

/// A problem and the bytes that it is about.
pub(super) type Wrong = (Option<Range<usize>>, PackProblem);

impl Pack {
    /// Whether the pack keeps people safe and measures what it says.
    pub(super) fn check(&self) -> Result<(), Wrong> {
        for (role, name, so) in NEEDED {
            let words = self.role.get(&role).into_iter().flatten();
            if !words
                .into_iter()
                .any(|word| word.contains(char::is_alphanumeric))
            {
                return Err((None, PackProblem::NoWords { role: name, so }));
            }
        }
        for unit in &self.unit {
            let factor = *unit.factor.as_ref();
            if !(factor.is_finite() && factor > 0.0) {
                return Err((Some(unit.factor.span()), PackProblem::Factor(factor)));
            }
        }
        let values = self.quantity.iter().map(|quantity| quantity.value);
        let mut values = values.chain(self.numbers.values().copied());
        match values.find(|value| !value.is_finite()) {
            Some(value) => Err((None, PackProblem::NotFinite(value))),
            None => Ok(()),
        }
    }

    /// Whether the categories of its quantities are ones that a vocabulary can have. One that neither
    /// this vocabulary has nor the common ones are may be of another vocabulary, unless it is spelt
    /// almost as one of them.
    pub(super) fn suits(&self, lexicon: &Lexicon) -> Result<(), Wrong> {
        let own = lexicon
            .categories()
            .iter()
            .skip(1)
            .map(|list| list.name.as_str());
        let known: Vec<_> = own
            .filter(|name| !COMMON.contains(name))
            .chain(COMMON)
            .collect();
        let units = self.unit.iter().map(|unit| &unit.category);
        let quantities = self.quantity.iter().map(|quantity| &quantity.category);
        let options = self.option.iter().map(|option| &option.category);
        for category in units.chain(quantities).chain(options) {
            let name = category.as_ref();
            let is_slip = || !did_you_mean(name, known.iter().copied()).is_empty();
            if !known.contains(&name.as_str()) && is_slip() {
                let problem = PackProblem::UnknownCategory {
                    name: name.clone(),
                    known: known.iter().map(|&name| name.to_owned()).collect(),
                };
                return Err((Some(category.span()), problem));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::error::LanguageError;
    use super::*;

    const SOUND: &str =
        "language = \"x\"\nfillers = []\n[role]\nnot = [\"nicht\"]\nquestion = [\"wo\"]\n";

    fn refused(toml: &str) -> (PackProblem, String) {
        match Pack::read("x.toml", toml) {
            Err(LanguageError::BadPack {
                file,
                place,
                problem,
                ..
            }) => {
                assert_eq!(file, "x.toml");
                assert!(!problem.remedy().is_empty());
                (problem, toml[place.unwrap_or_default()].to_owned())
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_pack_that_would_do_what_is_not_to_be_done_is_refused() {
        assert!(Pack::read("x.toml", SOUND).is_ok());
        for (line, role) in [
            ("not = [\"nicht\"]\n", "not"),
            ("question = [\"wo\"]\n", "question"),
        ] {
            for instead in [
                "",
                &format!("{role} = []\n"),
                &format!("{role} = [\" \"]\n"),
            ] {
                let (problem, _) = refused(&SOUND.replace(line, instead));
                assert!(matches!(problem, PackProblem::NoWords { role: r, .. } if r == role));
            }
        }
    }

    #[test]
    fn a_unit_measures_something() {
        for factor in ["0", "0.0", "-0.01", "nan", "inf"] {
            let unit =
                format!("[[unit]]\ncategory = \"distance\"\nfactor = {factor}\nwords = [\"cm\"]\n");
            let (problem, place) = refused(&format!("{SOUND}{unit}"));
            assert!(matches!(problem, PackProblem::Factor(_)), "{factor}");
            assert_eq!(place, factor);
        }
        let (problem, _) = refused(&format!("{SOUND}[numbers]\n\"viel\" = inf\n"));
        assert_eq!(problem, PackProblem::NotFinite(f32::INFINITY));
    }

    #[test]
    fn only_what_is_almost_a_category_is_a_slip() {
        let lexicon = Lexicon::tabletop().unwrap();
        let with = |category: &str| {
            let unit =
                format!("[[unit]]\ncategory = \"{category}\"\nfactor = 1.0\nwords = [\"e\"]\n");
            Pack::read("x.toml", &format!("{SOUND}{unit}"))
                .unwrap()
                .suits(&lexicon)
        };
        for sound in ["distance", "angle", "amount", "temperature"] {
            assert_eq!(with(sound), Ok(()), "{sound}");
        }
        let (place, problem) = with("distanz").unwrap_err();
        assert!(
            place.is_some() && problem.remedy().contains("did you mean \"distance\""),
            "{problem}"
        );
    }
}
