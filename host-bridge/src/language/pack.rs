//! A language pack: the grammar words of one language, from a TOML file.
//!
//! English (`en`) and Czech (`cs`) are built in; [`Pack::read`] takes any other.

mod check;
mod clash;
mod parts;

use std::collections::BTreeMap;

use serde::Deserialize;

use super::error::LanguageError;
use crate::vocabulary::Lexicon;
pub use check::PackProblem;
pub use parts::{Answer, Endings, Joints, OptionWords, Quantity, Speech, Tags, Unit, Verb};

/// What a grammar word does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// Says nothing.
    Filler,
    /// Makes a request of a question.
    Polite,
    /// What follows is the storage.
    Storage,
    /// What follows only tells which thing is meant.
    Aside,
    /// A thing the hand shows.
    Pointed,
    /// A place the hand shows.
    Place,
    /// The thing spoken of last.
    Again,
    /// Belongs to a verb and says nothing alone.
    Particle,
    /// The next command follows.
    Then,
    /// More of the same, or the next command.
    And,
    /// One or the other.
    Or,
    /// The contrary follows.
    But,
    /// What follows comes later.
    Before,
    /// What follows comes earlier.
    After,
    /// What was said before is replaced.
    Correct,
    /// What was said before is withdrawn.
    Retract,
    /// Nothing of the clause is done.
    Not,
    /// A question.
    Question,
    /// A question that is a request when said politely.
    RequestQuestion,
    /// A request, whatever the form of the verb that follows.
    Request,
    /// Somebody of whom something is told.
    Subject,
    /// Something is told about a thing.
    Copula,
    /// What follows may or may not be.
    Condition,
    /// Talk.
    Chatter,
    /// "No": a correction, or a prohibition right before a verb.
    Refuse,
    /// Stands before a noun: an action's word behind it is none.
    Article,
    /// Tells more of the thing before it.
    Relative,
    /// The one spoken to, who may do what comes before or after.
    You,
    /// A verb's form that is no command.
    Mention,
    /// Tells what somebody said or thought: no command of who speaks now.
    Report,
    /// What follows is what who speaks means to do.
    Own,
    /// Another time than now.
    Time,
    /// Of several things at once.
    Several,
    /// A bound of a quantity rather than the quantity.
    Bound,
    /// Before two things between which something is.
    Pair,
    /// An action's word that is another verb with a thing behind it: "open" and "open the box".
    Alone,
}

/// The grammar words of a language.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pack {
    /// Its code, as in a vocabulary's `language`.
    pub language: String,
    /// Whether double Metaphone applies.
    #[serde(default)]
    pub phonetic: bool,
    /// Words that say nothing.
    pub fillers: Vec<String>,
    /// Words that make a request of a question.
    #[serde(default)]
    pub polite: Vec<String>,
    /// What has a moving arm stand still, whatever the vocabulary calls its stop.
    #[serde(default)]
    pub halt: Vec<String>,
    /// Ordinary words that are like words of a vocabulary and none of them: never taken for misheard ones.
    #[serde(default)]
    pub ordinary: Vec<String>,
    /// All other grammar words.
    pub role: BTreeMap<Role, Vec<String>>,
    /// Ends of sentences that say nothing.
    #[serde(default)]
    pub tags: Tags,
    /// Forms of words.
    #[serde(default)]
    pub endings: Endings,
    /// Forms of verbs that are no commands, where one list of endings for all verbs is not enough.
    #[serde(default)]
    pub verb: Vec<Verb>,
    /// Words for numbers.
    #[serde(default)]
    pub numbers: BTreeMap<String, f32>,
    /// Words inside numbers.
    #[serde(default)]
    pub joints: Joints,
    /// Words after numbers.
    #[serde(default)]
    pub unit: Vec<Unit>,
    /// Quantities without number.
    #[serde(default)]
    pub quantity: Vec<Quantity>,
    /// Words for options.
    #[serde(default)]
    pub option: Vec<OptionWords>,
    /// Answers that name nothing.
    #[serde(default)]
    pub answer: Answer,
    /// For recognisers; without it the language can be typed only.
    pub speech: Option<Speech>,
}

impl Pack {
    /// The built-in pack of a language.
    ///
    /// # Errors
    /// [`LanguageError::NoPack`] for a language that is not built in.
    pub fn built_in(language: &str) -> Result<Self, LanguageError> {
        match language {
            "en" => Self::read("en.toml", include_str!("../../data/language/en.toml")),
            "cs" => Self::read("cs.toml", include_str!("../../data/language/cs.toml")),
            _ => Err(LanguageError::NoPack {
                language: language.to_owned(),
            }),
        }
    }

    /// The pack of a vocabulary's language: a built-in one, or a file that ends in `.toml`.
    ///
    /// # Errors
    /// [`LanguageError::NoPack`], [`LanguageError::BadPack`].
    pub fn of(lexicon: &Lexicon) -> Result<Self, LanguageError> {
        let language = lexicon.language();
        if !language.ends_with(".toml") {
            return Self::built_in(language);
        }
        let text = std::fs::read_to_string(language).map_err(|e| match e.kind() {
            std::io::ErrorKind::NotFound => LanguageError::NoPack {
                language: language.to_owned(),
            },
            _ => bad(language, "", (None, PackProblem::Unreadable(e.to_string()))),
        })?;
        let pack = Self::read(language, &text)?;
        pack.suits(lexicon)
            .map_err(|wrong| bad(language, &text, wrong))?;
        Ok(pack)
    }

    /// A pack from the TOML text of a file.
    ///
    /// # Errors
    /// [`LanguageError::BadPack`] with the line.
    pub fn read(file: &str, toml: &str) -> Result<Self, LanguageError> {
        let shape = |e: toml::de::Error| (e.span(), PackProblem::Syntax(e.message().to_owned()));
        let pack: Self = toml::from_str(toml).map_err(|e| bad(file, toml, shape(e)))?;
        pack.check().map_err(|wrong| bad(file, toml, wrong))?;
        Ok(pack)
    }
}

fn bad(file: &str, text: &str, (place, problem): check::Wrong) -> LanguageError {
    let before = place.as_ref().and_then(|place| text.get(..place.start));
    LanguageError::BadPack {
        file: file.to_owned(),
        line: before.map(|before| before.matches('\n').count() + 1),
        place,
        problem,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_built_in_packs_are_sound() {
        for language in ["en", "cs"] {
            assert_eq!(Pack::built_in(language).unwrap().language, language);
        }
    }

    #[test]
    fn a_bad_pack_is_refused_with_its_line() {
        let error = Pack::read("x.toml", "language = \"x\"\nfillers = 3").unwrap_err();
        let shown = error.to_string();
        assert!(
            shown.contains("x.toml") && shown.contains("line 2"),
            "{shown}"
        );
        assert_eq!(
            Pack::built_in("tlh"),
            Err(LanguageError::NoPack {
                language: "tlh".into()
            })
        );
    }
}
