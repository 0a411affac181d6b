//! Words of the grammar that a vocabulary takes for names.

use std::ops::Range;

use super::{Pack, Role};
use crate::language::table::words_of;
use crate::vocabulary::{Lexicon, VocabularyProblem};

/// Roles whose words can name nothing, and what they are: with such a name nobody could say both.
const TAKEN: [(Role, &str); 10] = [
    (Role::Not, "forbids"),
    (Role::Question, "asks"),
    (Role::Condition, "makes a condition"),
    (Role::And, "joins"),
    (Role::Or, "leaves a choice"),
    (Role::Then, "joins"),
    (Role::But, "joins"),
    (Role::Again, "stands for what was named before"),
    (Role::Pointed, "stands for what the hand shows"),
    (Role::Place, "stands for where the hand shows"),
];

impl Pack {
    /// Whether actions and things have names that are no words of the language's grammar.
    ///
    /// # Errors
    /// The place of the first that is one, and what it is in the language.
    pub fn names(&self, lexicon: &Lexicon) -> Result<(), (Range<usize>, VocabularyProblem)> {
        for said in lexicon.said() {
            if let Some(does) = self.taken(&words_of(&said.word)) {
                let problem = VocabularyProblem::GrammarWord {
                    word: said.word.clone(),
                    does,
                };
                return Err((said.place.clone(), problem));
            }
        }
        Ok(())
    }

    /// What these words do in a sentence, if they can be no name.
    fn taken(&self, words: &[String]) -> Option<&'static str> {
        let mut numbers = self.numbers.keys().map(|number| words_of(number));
        if !words.is_empty() && words.iter().all(|word| word.parse::<f32>().is_ok())
            || numbers.any(|number| number == words)
        {
            return Some("is a number");
        }
        let is = |list: &Vec<String>| list.iter().any(|word| words_of(word) == words);
        if is(&self.polite) {
            return Some("is polite");
        }
        let mut taken = TAKEN.into_iter();
        let (_, does) = taken.find(|(role, _)| self.role.get(role).is_some_and(is))?;
        Some(does)
    }
}
