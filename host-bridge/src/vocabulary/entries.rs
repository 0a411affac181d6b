//! The categories of a vocabulary file with the names in them.

use std::ops::Range;

use deictic_core::category::Category;
use deictic_core::vocabulary::VocabularyError;
use toml::Spanned;

use super::error::VocabularyProblem as Problem;
use super::file::{self, File};
use super::load::{Found, saturate};
use super::{CategoryEntries, Entry};

/// The names of the categories that every vocabulary can have, in the core's order.
const FIXED: [&str; 7] = [
    "action",
    "object",
    "storage",
    "distance",
    "direction",
    "angle",
    "amount",
];

/// The options of every category, in the core's order, gaps included.
pub(super) fn categories(file: &File) -> Found<Vec<CategoryEntries>> {
    let mut lists: Vec<CategoryEntries> = Vec::new();
    for (q, name) in FIXED.into_iter().enumerate() {
        lists.extend(Category::from_index(q).map(|c| empty(c, name)));
    }
    for action in &file.action {
        let entry = Entry {
            name: action.name.as_ref().clone(),
            words: action.words.clone(),
            gestures: action.gestures.clone(),
        };
        add(&mut lists[0], entry, action.name.span())?;
    }
    for (list, choices) in [(1, &file.object), (2, &file.storage)] {
        for choice in choices {
            add(&mut lists[list], entry_of(choice), choice.span())?;
        }
    }
    for parameter in &file.parameter {
        let name = parameter.category.as_ref();
        let place = parameter.category.span();
        if FIXED[..3].contains(&name.as_str()) {
            return Err((Some(place), Problem::NotAParameter(name.clone())));
        }
        check_name(name, &place)?;
        let at = match lists.iter().position(|c| c.name == *name) {
            Some(at) => at,
            None => {
                let category = Category::from_index(lists.len()).ok_or_else(|| {
                    let error = VocabularyError::TooManyCategories {
                        capacity: saturate(Category::LIMIT),
                    };
                    (Some(place.clone()), Problem::Refused(error))
                })?;
                lists.push(empty(category, name));
                lists.len() - 1
            }
        };
        if !lists[at].entries.is_empty() {
            let twice = Problem::Twice {
                category: "parameter".to_owned(),
                name: name.clone(),
            };
            return Err((Some(place), twice));
        }
        for choice in &parameter.options {
            add(&mut lists[at], entry_of(choice), choice.span())?;
        }
        if parameter.options.is_empty() {
            lists[at].quantity_only = true;
            let own = Entry {
                name: name.clone(),
                words: Vec::new(),
                gestures: Vec::new(),
            };
            add(&mut lists[at], own, place)?;
        }
    }
    while lists.len() > 1 && lists.last().is_some_and(|c| c.entries.is_empty()) {
        lists.pop();
    }
    Ok(lists)
}

fn empty(category: Category, name: &str) -> CategoryEntries {
    CategoryEntries {
        category,
        name: name.to_owned(),
        entries: Vec::new(),
        quantity_only: false,
    }
}

fn entry_of(choice: &Spanned<file::Choice>) -> Entry {
    let choice = choice.as_ref();
    Entry {
        name: choice.name.clone(),
        words: choice.words.clone(),
        gestures: choice.gestures.clone(),
    }
}

fn add(list: &mut CategoryEntries, entry: Entry, place: Range<usize>) -> Found<()> {
    check_name(&entry.name, &place)?;
    if list.entries.iter().any(|e| e.name == entry.name) {
        let twice = Problem::Twice {
            category: list.name.clone(),
            name: entry.name,
        };
        return Err((Some(place), twice));
    }
    list.entries.push(entry);
    Ok(())
}

pub(super) fn check_name(name: &str, place: &Range<usize>) -> Found<()> {
    let good = name.chars().next().is_some_and(char::is_alphanumeric)
        && name.chars().count() <= 40
        && name
            .chars()
            .all(|c| c.is_alphanumeric() || c == '-' || c == '_');
    if good {
        Ok(())
    } else {
        Err((Some(place.clone()), Problem::BadName(name.to_owned())))
    }
}

/// The names of the categories that the file has, for a remedy.
pub(super) fn known(categories: &[CategoryEntries]) -> Vec<String> {
    let there = categories.iter().filter(|c| !c.entries.is_empty());
    there.map(|c| c.name.clone()).collect()
}
