//! How alike a sensor finds the options of a category: what a recogniser says when one option was
//! really shown or said.

use deictic_core::category::Category;
use deictic_core::sentence::{GESTURE, LANGUAGE};

use super::CategoryEntries;
use super::entries::known;
use super::error::{Found, VocabularyProblem as Problem};
use super::file::{Similarity, Table};

/// The similarity tables of the two modalities a vocabulary file can describe.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SimilarityTables {
    tables: Vec<(u8, Category, Rows)>,
}

#[derive(Clone, Debug, PartialEq)]
enum Rows {
    Others(f32),
    Square(Vec<Vec<f32>>),
}

impl SimilarityTables {
    fn insert(&mut self, modality: u8, category: Category, rows: Rows) {
        self.tables.push((modality, category, rows));
    }

    /// What a perfect sensor of this modality ([`GESTURE`] or [`LANGUAGE`]) says of the `options`
    /// options of `category` when `option` is the true one: likelihoods in 0..=1.
    ///
    /// Without a table, and for any other modality, that is 1 for the true option and 0 for all
    /// others.
    #[must_use]
    pub fn row(&self, modality: u8, category: Category, option: u8, options: usize) -> Vec<f32> {
        let table = self
            .tables
            .iter()
            .find(|(m, c, _)| *m == modality && *c == category)
            .map(|(_, _, rows)| rows);
        let flat = |others: f32| {
            let mut row = vec![others; options];
            if let Some(own) = row.get_mut(usize::from(option)) {
                *own = 1.0;
            }
            row
        };
        match table {
            None => flat(0.0),
            Some(Rows::Others(others)) => flat(*others),
            Some(Rows::Square(rows)) => rows
                .get(usize::from(option))
                .cloned()
                .unwrap_or_else(|| flat(0.0)),
        }
    }

    /// Whether the file describes how this modality observes this category.
    #[must_use]
    pub fn describes(&self, modality: u8, category: Category) -> bool {
        self.tables
            .iter()
            .any(|(m, c, _)| *m == modality && *c == category)
    }
}

/// Checks the tables of a file against the options they speak of.
pub(super) fn load(
    written: &Similarity,
    categories: &[CategoryEntries],
) -> Found<SimilarityTables> {
    let mut tables = SimilarityTables::default();
    for (modality, by_category) in [(GESTURE, &written.gesture), (LANGUAGE, &written.language)] {
        for (name, table) in by_category {
            let found = categories
                .iter()
                .find(|c| c.name == *name && !c.entries.is_empty());
            let Some(list) = found else {
                let problem = Problem::UnknownCategory {
                    name: name.clone(),
                    known: known(categories),
                };
                return Err((Some(table.span()), problem));
            };
            let rows = checked(table.as_ref(), name, list.entries.len());
            let rows = rows.map_err(|problem| (Some(table.span()), problem))?;
            tables.insert(modality, list.category, rows);
        }
    }
    Ok(tables)
}

/// A table of a category of this many options.
fn checked(table: &Table, category: &str, size: usize) -> Result<Rows, Problem> {
    let (rows, figures) = match table {
        Table::Others(others) => (Rows::Others(*others), vec![*others]),
        Table::Rows(rows) => {
            let lengths = || rows.iter().map(Vec::len);
            let odd = lengths().find(|length| *length != size);
            if rows.len() != size || odd.is_some() {
                return Err(Problem::TableSize {
                    category: category.to_owned(),
                    rows: rows.len(),
                    columns: odd.unwrap_or(size),
                    size,
                });
            }
            (Rows::Square(rows.clone()), rows.concat())
        }
    };
    match figures.into_iter().find(|x| !(0.0..=1.0).contains(x)) {
        None => Ok(rows),
        Some(value) => {
            let category = category.to_owned();
            Err(Problem::NoLikelihood { category, value })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_has_one_place_per_option_whatever_the_table() {
        let mut tables = SimilarityTables::default();
        tables.insert(GESTURE, Category::OBJECT, Rows::Others(0.2));
        let square = vec![vec![1.0, 0.5], vec![0.4, 1.0]];
        tables.insert(LANGUAGE, Category::OBJECT, Rows::Square(square));
        let row = |modality, category, option| tables.row(modality, category, option, 2);
        assert_eq!(row(GESTURE, Category::OBJECT, 1), [0.2, 1.0]);
        assert_eq!(row(LANGUAGE, Category::OBJECT, 1), [0.4, 1.0]);
        assert_eq!(row(LANGUAGE, Category::STORAGE, 0), [1.0, 0.0]);
        assert_eq!(row(LANGUAGE, Category::OBJECT, 9), [0.0, 0.0]);
        assert!(tables.describes(GESTURE, Category::OBJECT));
        assert!(!tables.describes(GESTURE, Category::STORAGE));
    }
}
