//! A language pack: the grammar words of one language, from a TOML file.
//!
//! English (`en`) and Czech (`cs`) are built in; [`Pack::read`] takes any other.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::error::LanguageError;

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
}

/// A word for a number with a unit.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Unit {
    /// Name of the category of its quantities.
    pub category: String,
    /// How much one is: metres, radians or pieces.
    pub factor: f32,
    /// What people call it.
    pub words: Vec<String>,
}

/// A quantity that needs no number.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantity {
    /// Name of its category.
    pub category: String,
    /// How much it is: metres, radians or pieces.
    pub value: f32,
    /// What people call it.
    pub words: Vec<String>,
}

/// Words for an option that the vocabulary gives no words for.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OptionWords {
    /// Name of its category.
    pub category: String,
    /// The option's name in the vocabulary.
    pub name: String,
    /// What people call it.
    pub words: Vec<String>,
}

/// Endings that tell forms of a word.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Endings {
    /// Of names of things: "cups" is "cup".
    #[serde(default)]
    pub name: Vec<String>,
    /// Of verbs that are no commands: "picking", "picked".
    #[serde(default)]
    pub verb: Vec<String>,
    /// Of verbs that are commands: the polite plural of Czech.
    #[serde(default)]
    pub command: Vec<String>,
    /// Ends of stems that take each other's place: "hrnek", "hrnku".
    #[serde(default)]
    pub alternate: Vec<[String; 2]>,
    /// What negates a verb in front of it.
    #[serde(default)]
    pub negative: Vec<String>,
    /// Letters of a word that are never taken for an ending.
    #[serde(default)]
    pub keep: usize,
}

/// Words inside numbers.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Joints {
    /// Between a whole number and a fraction, between hundreds and ones.
    #[serde(default)]
    pub and: Vec<String>,
    /// Before decimals.
    #[serde(default)]
    pub point: Vec<String>,
    /// Before a negative number.
    #[serde(default)]
    pub minus: Vec<String>,
}

/// Ends of a sentence that say nothing.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tags {
    /// As they are.
    #[serde(default)]
    pub plain: Vec<String>,
}

/// What a recogniser that needs a grammar listens for, besides the vocabulary's words.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Speech {
    /// Around a sentence.
    pub polite: Vec<String>,
    /// In front of what is not to be done.
    pub not: Vec<String>,
    /// Before names.
    pub determiner: Vec<String>,
    /// In place of an object's name.
    pub pointed: Vec<String>,
    /// Before a storage.
    pub preposition: Vec<String>,
    /// In place of a preposition and a storage.
    pub place: Vec<String>,
    /// The answer that it is so.
    pub yes: Vec<String>,
    /// The answer that it is not so.
    pub no: Vec<String>,
    /// What is told the robot itself: to hold, to go on, to go home, that a fault was seen to.
    #[serde(default)]
    pub order: Vec<String>,
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
    /// All other grammar words.
    pub role: BTreeMap<Role, Vec<String>>,
    /// Ends of sentences that say nothing.
    #[serde(default)]
    pub tags: Tags,
    /// Forms of words.
    #[serde(default)]
    pub endings: Endings,
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
            "en" => Self::read(include_str!("../../data/language/en.toml")),
            "cs" => Self::read(include_str!("../../data/language/cs.toml")),
            _ => Err(LanguageError::NoPack {
                language: language.to_owned(),
            }),
        }
    }

    /// The pack of a vocabulary's `language`: a built-in one, or a file that ends in `.toml`.
    ///
    /// # Errors
    /// [`LanguageError::NoPack`], [`LanguageError::BadPack`].
    pub fn of(language: &str) -> Result<Self, LanguageError> {
        if !language.ends_with(".toml") {
            return Self::built_in(language);
        }
        let text = std::fs::read_to_string(language).map_err(|e| LanguageError::BadPack {
            why: format!("{language}: {e}"),
        })?;
        Self::read(&text)
    }

    /// A pack from its TOML text.
    ///
    /// # Errors
    /// [`LanguageError::BadPack`] with the line.
    pub fn read(toml: &str) -> Result<Self, LanguageError> {
        let bad = |why: String| LanguageError::BadPack { why };
        let pack: Self = toml::from_str(toml).map_err(|e| bad(e.to_string()))?;
        let values = pack.unit.iter().map(|u| u.factor);
        let values = values.chain(pack.quantity.iter().map(|q| q.value));
        if !values
            .chain(pack.numbers.values().copied())
            .all(f32::is_finite)
        {
            return Err(bad("a number that is not finite".to_owned()));
        }
        Ok(pack)
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
        let Err(LanguageError::BadPack { why }) = Pack::read("language = \"x\"\nfillers = 3")
        else {
            panic!("it was taken");
        };
        assert!(why.contains("line 2"), "{why}");
        assert_eq!(
            Pack::built_in("tlh"),
            Err(LanguageError::NoPack {
                language: "tlh".into()
            })
        );
    }
}
