//! Everything that people say for actions and things, with its place in the file.

use std::ops::Range;

use deictic_core::category::Category;
use toml::Spanned;

use super::error::{Found, VocabularyProblem as Problem};
use super::file::File;
use super::written::{Written, tidy};

/// A name or word of an action, an object or a storage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Said {
    /// Of which category.
    pub category: Category,
    /// The option's name.
    pub name: String,
    /// What is said, in lower case with single spaces.
    pub word: String,
    /// Where it stands, in bytes of the file.
    pub place: Range<usize>,
}

/// All names and words of actions, objects and storages, in this order.
///
/// # Errors
/// The first of a thing that an action has too: "box the can" and "the box" would be one word.
pub(super) fn said(file: &File) -> Found<Vec<Said>> {
    let actions = file.action.iter().map(|action| {
        let (name, place) = (action.name.as_ref().as_str(), action.name.span());
        (Category::ACTION, name, place, &action.words)
    });
    let objects = file.object.iter().map(|thing| (Category::OBJECT, thing));
    let storages = file.storage.iter().map(|thing| (Category::STORAGE, thing));
    let things = objects.chain(storages).map(|(category, thing)| {
        let Written { name, place, .. } = Written::of(thing);
        (category, name, place, &thing.as_ref().words)
    });
    let mut all: Vec<Said> = Vec::new();
    for (category, name, place, words) in actions.chain(things) {
        let words = words
            .iter()
            .map(|word| (word.as_ref().as_str(), word.span()));
        for (word, place) in std::iter::once((name, place)).chain(words) {
            let said = Said {
                category,
                name: name.to_owned(),
                word: tidy(word),
                place,
            };
            let action =
                |other: &&Said| other.category == Category::ACTION && other.word == said.word;
            if category != Category::ACTION
                && let Some(action) = all.iter().find(action)
            {
                let problem = Problem::DoneAndNamed {
                    word: word.to_owned(),
                    action: action.name.clone(),
                    thing: said.name,
                };
                return Err((Some(said.place), problem));
            }
            all.push(said);
        }
    }
    Ok(all)
}

/// Where every action names its motion, if it does.
pub(super) fn motion_places(file: &File) -> Vec<Option<Range<usize>>> {
    let motions = file.action.iter().map(|action| action.motion.as_ref());
    motions.map(|motion| motion.map(Spanned::span)).collect()
}
