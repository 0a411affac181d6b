//! The tables of a language pack, apart from the roles of grammar words.

use serde::Deserialize;
use toml::Spanned;

/// A word for a number with a unit.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Unit {
    /// Name of the category of its quantities.
    pub category: Spanned<String>,
    /// How much one is: metres, radians or pieces.
    pub factor: Spanned<f64>,
    /// What people call it.
    pub words: Vec<String>,
}

/// A quantity that needs no number.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantity {
    /// Name of its category.
    pub category: Spanned<String>,
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
    pub category: Spanned<String>,
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
    /// Of verbs that are no commands though they are one but for their accents: "umístí" and "umísti".
    #[serde(default)]
    pub told: Vec<String>,
    /// Letters of a word that are never taken for an ending.
    #[serde(default)]
    pub keep: usize,
}

/// Forms of verbs that are no commands, by how the verb ends as a vocabulary has it.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Verb {
    /// What is taken off the end: "i" of "vezmi"; an empty one takes nothing off.
    pub ends: Vec<String>,
    /// What is put there for the forms that are no commands: "u" of "vezmu".
    pub mentions: Vec<String>,
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
    /// What groups the digits of a number by three: "," in English, where "1,000" is a thousand. Without
    /// it "1,000" is one, and "1.000" is refused, as it may be either.
    #[serde(default)]
    pub thousands: Option<char>,
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
    /// Before a quantity.
    #[serde(default)]
    pub by: Vec<String>,
    /// Numbers, of those in the pack's table of numbers.
    #[serde(default)]
    pub number: Vec<String>,
    /// Units, of those in the pack's tables of units.
    #[serde(default)]
    pub unit: Vec<String>,
    /// Quantities without number, of those in the pack's tables of quantities.
    #[serde(default)]
    pub quantity: Vec<String>,
    /// What is told the robot itself: to hold, to go on, to go home, that a fault was seen to.
    #[serde(default)]
    pub order: Vec<String>,
}

/// Answers to a question that name nothing.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// It is so.
    pub yes: Vec<String>,
    /// It is not so, or none of them.
    pub no: Vec<String>,
    /// None of what was asked about is meant, of whatever was asked.
    #[serde(default)]
    pub none: Vec<String>,
    /// The person does not know either, or does not care.
    #[serde(default)]
    pub unsure: Vec<String>,
}
