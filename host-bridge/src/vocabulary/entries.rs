//! The categories of a vocabulary file with the names in them.

use std::ops::Range;

use deictic_core::category::Category;
use deictic_core::vocabulary::VocabularyError;

use super::CategoryEntries;
use super::error::{Found, VocabularyProblem as Problem};
use super::file::File;
use super::written::Written;

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
        let (name, place) = (action.name.as_ref(), action.name.span());
        let written = Written {
            name,
            place,
            words: &action.words,
            gestures: &action.gestures,
        };
        add(&mut lists[0], &written)?;
    }
    for (list, choices) in [(1, &file.object), (2, &file.storage)] {
        for choice in choices {
            add(&mut lists[list], &Written::of(choice))?;
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
            add(&mut lists[at], &Written::of(choice))?;
        }
        if parameter.options.is_empty() {
            lists[at].quantity_only = true;
            let own = Written {
                name,
                place,
                words: &[],
                gestures: &[],
            };
            add(&mut lists[at], &own)?;
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

fn add(list: &mut CategoryEntries, written: &Written<'_>) -> Found<()> {
    check_name(written.name, &written.place)?;
    if list.entries.iter().any(|e| e.name == *written.name) {
        let twice = Problem::Twice {
            category: list.name.clone(),
            name: written.name.to_owned(),
        };
        return Err((Some(written.place.clone()), twice));
    }
    list.entries.push(written.entry(list)?);
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

/// A count as a byte, 255 when it is larger.
pub(super) fn saturate(count: usize) -> u8 {
    u8::try_from(count).unwrap_or(u8::MAX)
}
