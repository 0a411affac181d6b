//! Words that are not known but sound or look like known ones, and how alike the options of a
//! category are to what was heard.

use std::collections::HashSet;

use deictic_core::category::Category;

use super::likeness::{Ear, Sound};
use super::pack::Role;
use super::read::{Piece, What};
use super::table::{Meaning, Table};
use super::token::fold;

/// From this likeness on an unknown word is taken for a misheard one: "kup" and "cup" have 0.83,
/// "drawr" and "drawer" 0.92, "spoon" and "stop" 0.4.
const MISHEARD: f64 = 0.7;

/// Below this a known word is not worth proposing.
const NEAR: f64 = 0.55;

/// Roles that a misheard word may have: those that keep a command from being done, or that tell what
/// goes where.
const ROLES: [Role; 3] = [Role::Not, Role::Storage, Role::Polite];

/// Unknown words up to this length are not taken for grammar words, most of which are as short.
const LONG: usize = 3;

/// All phrases with their sounds.
#[derive(Clone, Debug)]
pub struct Guesser {
    ear: Ear,
    names: Vec<(String, Sound, Category, u8)>,
    roles: Vec<(Sound, Role)>,
    /// Forms of verbs that are no commands.
    forms: Vec<Sound>,
    /// Words that are what they are, though they mean nothing alone: "let" of "let go".
    ordinary: HashSet<String>,
}

impl Guesser {
    /// Listens to every phrase of the table.
    #[must_use]
    pub fn new(table: &Table) -> Self {
        let ear = Ear::new(table.pack().phonetic);
        let names = table.names_of();
        let names = names
            .map(|(words, c, o)| (words.clone(), ear.listen(&words), c, o))
            .collect();
        let role = |&role: &Role| {
            let words = table.words_of_role(role).filter(|w| w.len() > 3);
            words.map(|w| (ear.listen(w), role)).collect::<Vec<_>>()
        };
        let roles = ROLES.iter().flat_map(role).collect();
        let forms = table.forms_of();
        let forms = forms.map(|words| ear.listen(&words)).collect();
        let ordinary = table.pack().ordinary.iter().map(|word| fold(word));
        let ordinary = ordinary.chain(table.words_of_actions()).collect();
        Self {
            ear,
            names,
            roles,
            forms,
            ordinary,
        }
    }

    /// Takes unknown words that are like known ones for these; what was heard stays as it is.
    pub fn mend(&self, pieces: &mut [Piece]) {
        for at in 0..pieces.len() {
            let (before, rest) = pieces.split_at_mut(at.saturating_add(1));
            let Some(piece) = before.last_mut().filter(|p| p.what == What::Unknown) else {
                continue;
            };
            if piece.words.chars().count() < 3 || self.ordinary.contains(&piece.words) {
                continue;
            }
            let heard = self.ear.listen(&piece.words);
            let role = self
                .roles
                .iter()
                .map(|(s, r)| (self.ear.likeness(&heard, s), *r));
            let long = piece.words.chars().count() > LONG;
            let leads = rest
                .iter()
                .find(|p| !p.is(Role::Filler))
                .is_some_and(stored);
            let role = role
                .filter(|(_, role)| long && (*role != Role::Storage || leads))
                .max_by(|a, b| a.0.total_cmp(&b.0))
                .unwrap_or((0.0, Role::Filler));
            let names = self
                .names
                .iter()
                .map(|n| (self.ear.likeness(&heard, &n.1), n.2, n.3));
            let names: Vec<_> = names.filter(|(l, ..)| *l >= MISHEARD).collect();
            let best = names.iter().map(|n| n.0).fold(0.0, f64::max);
            if role.0 >= MISHEARD && role.0 > best {
                piece.what = What::Known(vec![Meaning::Role(role.1)]);
            } else if best > 0.0 {
                // One word has one category; which of its options is left to the likelihoods.
                let top = names.iter().filter(|n| n.0 == best);
                let top = top.map(|&(_, category, option)| Meaning::Name(category, option));
                // "Vezmne" is "vezme" rather than "vezmi": what may be no command is said again.
                if self.form(&heard) <= best {
                    piece.what = What::Known(top.collect());
                }
            }
        }
    }

    /// How alike the most alike form of a verb is that is no command.
    fn form(&self, heard: &Sound) -> f64 {
        let alike = self.forms.iter();
        let alike = alike.map(|form| self.ear.likeness(heard, form));
        alike.fold(0.0, f64::max)
    }

    /// The known words that are most like this one, the nearest first.
    #[must_use]
    pub fn nearest(&self, word: &str) -> Vec<String> {
        let heard = self.ear.listen(word);
        let mut near: Vec<_> = self
            .names
            .iter()
            .map(|(words, sound, ..)| (self.ear.likeness(&heard, sound), words))
            .filter(|(likeness, _)| *likeness >= NEAR)
            .collect();
        near.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
        near.dedup_by(|a, b| a.1 == b.1);
        near.into_iter()
            .take(3)
            .map(|(_, words)| words.clone())
            .collect()
    }

    /// How alike each of `options` options of a category is to what was heard, 0..=1.
    #[must_use]
    pub fn likenesses(&self, heard: &str, category: Category, options: usize) -> Vec<f64> {
        let sound = self.ear.listen(heard);
        let mut out = vec![0.0; options];
        for (words, known, c, option) in &self.names {
            let place = out.get_mut(usize::from(*option));
            if let Some(best) = place.filter(|_| *c == category) {
                // "place in" and "place on" differ in the words in which they differ.
                let likeness = match apart(heard, words) {
                    Some((a, b)) => self.ear.likeness(&self.ear.listen(a), &self.ear.listen(b)),
                    None => self.ear.likeness(&sound, known),
                };
                *best = f64::max(*best, likeness);
            }
        }
        out
    }
}

/// Whether a preposition may stand before it.
fn stored(piece: &Piece) -> bool {
    let shown = [Role::Pointed, Role::Place, Role::Again];
    piece.is_thing() || shown.iter().any(|&role| piece.is(role)) || piece.what == What::Unknown
}

/// What is left of two phrases behind the words that they have in common at their start; `None` when
/// there are none, or when one phrase is the start of the other.
fn apart<'a>(a: &'a str, b: &'a str) -> Option<(&'a str, &'a str)> {
    let mut rest = (a, b);
    while let (Some((x, a)), Some((y, b))) = (rest.0.split_once(' '), rest.1.split_once(' ')) {
        if x != y {
            break;
        }
        rest = (a, b);
    }
    (rest != (a, b) && rest.0 != rest.1).then_some(rest)
}
