//! The grammar of sentences: what follows from the signatures of the actions, in every order in which
//! people may say it.

use std::collections::HashMap;

use deictic_core::category::Category;

use super::orders::permutations;
use crate::language::pack::{Pack, Role};
use crate::vocabulary::Lexicon;

/// A class of words: one slot of a sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// The action.
    Action,
    /// What it is done to.
    Object,
    /// The word before the storage.
    Preposition,
    /// Where it goes.
    Storage,
    /// A further parameter, by its place in [`Words::further`].
    Further(usize),
}

/// Which slots an action takes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Signature {
    /// Whether it needs an object.
    pub object: bool,
    /// Whether it needs a storage.
    pub storage: bool,
    /// Which further parameters it may take.
    pub further: Vec<usize>,
}

/// Why a grammar was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GrammarError {
    /// Not one signature per action.
    #[error("{actions} actions have {signatures} signatures")]
    Signatures {
        /// How many actions there are.
        actions: usize,
        /// How many signatures.
        signatures: usize,
    },
    /// A signature with a further parameter that there is not.
    #[error("action {action} takes a parameter that does not exist")]
    Further {
        /// Whose signature.
        action: usize,
    },
}

/// The words of a sentence and what the actions take.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Words {
    /// Names of the actions.
    pub actions: Vec<String>,
    /// What each action takes.
    pub signatures: Vec<Signature>,
    /// Names of the objects.
    pub objects: Vec<String>,
    /// Names of the storages.
    pub storages: Vec<String>,
    /// Options of each further parameter.
    pub further: Vec<Vec<String>>,
    /// Words before a storage.
    pub prepositions: Vec<String>,
    /// Words that say nothing. Every other word that is none of the above may have covered one that
    /// is, as "um" does.
    pub fillers: Vec<String>,
}

/// The words of a sentence and how they go together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grammar {
    words: Words,
    index: HashMap<String, Vec<(Class, usize)>>,
}

impl Grammar {
    /// Checks the parts against each other.
    ///
    /// # Errors
    /// [`GrammarError`].
    pub fn new(words: Words) -> Result<Self, GrammarError> {
        let (actions, signatures) = (words.actions.len(), words.signatures.len());
        if actions != signatures {
            return Err(GrammarError::Signatures {
                actions,
                signatures,
            });
        }
        let takes = |s: &Signature| s.further.iter().all(|&f| f < words.further.len());
        if let Some(action) = words.signatures.iter().position(|s| !takes(s)) {
            return Err(GrammarError::Further { action });
        }
        let mut index: HashMap<String, Vec<(Class, usize)>> = HashMap::new();
        let mut add = |class: Class, names: &[String]| {
            for (option, name) in names.iter().enumerate() {
                index
                    .entry(name.to_lowercase())
                    .or_default()
                    .push((class, option));
            }
        };
        add(Class::Action, &words.actions);
        add(Class::Object, &words.objects);
        add(Class::Storage, &words.storages);
        add(Class::Preposition, &words.prepositions);
        for (place, options) in words.further.iter().enumerate() {
            add(Class::Further(place), options);
        }
        Ok(Self { words, index })
    }

    /// Its words.
    #[must_use]
    pub fn words(&self) -> &Words {
        &self.words
    }

    /// The grammar of a vocabulary. Further parameters are those with options; quantities are not
    /// part of it.
    ///
    /// # Errors
    /// [`GrammarError`].
    pub fn of(lexicon: &Lexicon, pack: &Pack) -> Result<Self, GrammarError> {
        let names = |category| {
            let entries = lexicon.entries(category).iter();
            entries.map(|e| e.name.clone()).collect::<Vec<_>>()
        };
        let categories = lexicon.categories().iter().map(|c| c.category);
        let further: Vec<_> = categories
            .filter(|c| *c != Category::ACTION && !c.is_entity())
            .filter(|c| !lexicon.is_quantity_only(*c) && !lexicon.entries(*c).is_empty())
            .collect();
        let signatures = lexicon.vocabulary().actions().iter().map(|action| {
            let all = action
                .signature
                .compulsory
                .union(action.signature.voluntary);
            let takes = |c: &Category| all.contains(c.index());
            Signature {
                object: action
                    .signature
                    .compulsory
                    .contains(Category::OBJECT.index()),
                storage: action
                    .signature
                    .compulsory
                    .contains(Category::STORAGE.index()),
                further: (0..further.len())
                    .filter(|&i| further.get(i).is_some_and(takes))
                    .collect(),
            }
        });
        Self::new(Words {
            actions: names(Category::ACTION),
            signatures: signatures.collect(),
            objects: names(Category::OBJECT),
            storages: names(Category::STORAGE),
            further: further.iter().map(|c| names(*c)).collect(),
            prepositions: pack.role.get(&Role::Storage).cloned().unwrap_or_default(),
            fillers: pack.fillers.clone(),
        })
    }

    /// What a word names.
    pub(super) fn named(&self, word: &str) -> &[(Class, usize)] {
        self.index
            .get(&word.to_lowercase())
            .map_or(&[], Vec::as_slice)
    }

    /// How many options a class has.
    #[must_use]
    pub fn options(&self, class: Class) -> usize {
        self.names(class).len()
    }

    /// The names of the options of a class.
    #[must_use]
    pub fn names(&self, class: Class) -> &[String] {
        match class {
            Class::Action => &self.words.actions,
            Class::Object => &self.words.objects,
            Class::Storage => &self.words.storages,
            Class::Preposition => &self.words.prepositions,
            Class::Further(place) => self.words.further.get(place).map_or(&[], Vec::as_slice),
        }
    }

    /// The sentences of a signature, each a sequence of slots with how unusual its order is: 0 for
    /// further parameters, action, object, storage.
    #[must_use]
    pub fn shapes(&self, signature: &Signature) -> Vec<(Vec<Class>, usize)> {
        let mut shapes = Vec::new();
        let subsets = 1_usize << signature.further.len().min(4);
        for subset in 0..subsets {
            let mut units: Vec<Vec<Class>> = Vec::new();
            for (i, &f) in signature.further.iter().enumerate() {
                if subset >> i & 1 == 1 {
                    units.push(vec![Class::Further(f)]);
                }
            }
            units.push(vec![Class::Action]);
            if signature.object {
                units.push(vec![Class::Object]);
            }
            if signature.storage {
                units.push(vec![Class::Preposition, Class::Storage]);
            }
            for (order, swaps) in permutations(units.len()) {
                let slots = order
                    .iter()
                    .filter_map(|&i| units.get(i))
                    .flatten()
                    .copied();
                shapes.push((slots.collect(), swaps));
            }
        }
        shapes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_follow_from_the_signature() {
        let words = Words {
            further: vec![vec!["fast".into()]],
            ..Words::default()
        };
        let grammar = Grammar::new(words).unwrap();
        let signature = Signature {
            object: true,
            storage: true,
            further: vec![0],
        };
        let shapes = grammar.shapes(&signature);
        assert_eq!(shapes.len(), 6 + 24);
        let usual = shapes
            .iter()
            .filter(|(_, swaps)| *swaps == 0)
            .map(|(slots, _)| slots.len());
        assert_eq!(usual.collect::<Vec<_>>(), [4, 5]);
    }

    #[test]
    fn parts_that_do_not_fit_are_refused() {
        let words = Words {
            actions: vec!["go".into()],
            ..Words::default()
        };
        assert_eq!(
            Grammar::new(words.clone()),
            Err(GrammarError::Signatures {
                actions: 1,
                signatures: 0
            })
        );
        let signature = Signature {
            further: vec![3],
            ..Signature::default()
        };
        let words = Words {
            signatures: vec![signature],
            ..words
        };
        assert_eq!(
            Grammar::new(words),
            Err(GrammarError::Further { action: 0 })
        );
    }
}
