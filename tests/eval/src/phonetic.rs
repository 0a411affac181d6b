//! How alike words sound: the Levenshtein ratio of their double-Metaphone codes, as the paper
//! describes it (Gesture and language instructions processing).

use rapidfuzz::fuzz;
use rphonetic::{DoubleMetaphone, Encoder};

use crate::catalogue::{Catalogue, Table};

/// Long enough for names of several words; the usual four letters would cut them.
const LONGEST_CODE: usize = 64;

/// The phonetic code of a name.
#[must_use]
pub fn code(name: &str) -> String {
    let letters: String = name
        .chars()
        .map(|c| if c == '-' { ' ' } else { c })
        .collect();
    DoubleMetaphone::new(Some(LONGEST_CODE)).encode(&letters)
}

/// Similarity of every pair of names, in 0..=1, rounded to two digits as the published tables are.
#[must_use]
pub fn table(names: &[String]) -> Table {
    let codes: Vec<String> = names.iter().map(|name| code(name)).collect();
    let similarity = |a: &String, b: &String| {
        if a == b {
            return 1.0;
        }
        let ratio = fuzz::ratio(a.chars(), b.chars());
        ((100.0 * ratio).round() / 100.0) as f32
    };
    codes
        .iter()
        .map(|a| codes.iter().map(|b| similarity(a, b)).collect())
        .collect()
}

/// Replaces a catalogue's language table of actions by that of its own names, squeezed into 0.5..=1
/// as in the published sets, whose table belongs to another list of actions.
pub fn correct(catalogue: &mut Catalogue) {
    let mut table = table(&catalogue.names[0]);
    table.iter_mut().flatten().for_each(|x| *x = *x / 2.0 + 0.5);
    catalogue.similarity[1][0] = table;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(list: &[&str]) -> Vec<String> {
        list.iter().map(|&s| s.to_owned()).collect()
    }

    #[test]
    fn the_published_table_belongs_to_another_list_of_actions() {
        let list = names(&[
            "move up", "release", "stop", "pick", "place", "push", "point", "pour", "put",
        ]);
        let (published, _) = Catalogue::papers();
        for (row, theirs) in table(&list).iter().zip(&published.similarity[1][0]) {
            for (x, y) in row.iter().zip(theirs) {
                assert!((x / 2.0 + 0.5 - y).abs() < 0.006, "{row:?} {theirs:?}");
            }
        }
        let own = table(&published.names[0]);
        assert!((own[6][8] / 2.0 + 0.5 - published.similarity[1][0][6][8]).abs() > 0.1);
    }

    #[test]
    fn cube_and_cup_sound_alike() {
        assert_eq!(code("cube"), code("cup"));
        assert_ne!(code("can"), code("cup"));
    }
}
