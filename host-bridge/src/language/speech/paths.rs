//! Rules as letters: what may come next after so much of an utterance was written.
//!
//! A network of rules is an automaton over bytes in which several places are possible at once (Thompson
//! 1968); sets of places become states when they are first reached.

use std::collections::{BTreeSet, HashMap};

use super::rule::Rule;

/// A set of places, by its number.
pub type State = usize;

/// All that may be said, letter by letter. Every word has a space in front; that of the first may be
/// left out.
#[derive(Clone, Debug, Default)]
pub struct Paths {
    /// Per place: the letters that lead on, and where to.
    letters: Vec<Vec<(u8, usize)>>,
    /// Per place: where it leads without a letter.
    silent: Vec<Vec<usize>>,
    /// Where whole utterances end.
    ends: BTreeSet<usize>,
    sets: Vec<Vec<usize>>,
    numbers: HashMap<Vec<usize>, State>,
}

impl Paths {
    /// The utterances of all these rules.
    #[must_use]
    pub fn new(rules: &[Rule]) -> Self {
        let mut paths = Self::default();
        let begin = paths.place();
        for rule in rules {
            let end = paths.lay(rule, begin);
            paths.ends.insert(end);
        }
        let first = paths.reach([begin]);
        let after_space = paths.after(&first, b' ');
        let start = first
            .into_iter()
            .chain(after_space)
            .collect::<BTreeSet<_>>();
        paths.number(start.into_iter().collect());
        paths
    }

    /// Where nothing has been written yet.
    pub const START: State = 0;

    /// Where a letter leads from a state; `None` where nothing that may be said has it there.
    pub fn follow(&mut self, state: State, letter: u8) -> Option<State> {
        let set = self.sets.get(state)?.clone();
        let next = self.after(&set, letter);
        (!next.is_empty()).then(|| self.number(next))
    }

    /// The letters that lead on from a state.
    #[must_use]
    pub fn letters(&self, state: State) -> BTreeSet<u8> {
        let places = self.sets.get(state).into_iter().flatten();
        let letters = places.filter_map(|&place| self.letters.get(place));
        letters.flatten().map(|(letter, _)| *letter).collect()
    }

    /// Whether what was written is a whole utterance.
    #[must_use]
    pub fn is_whole(&self, state: State) -> bool {
        let mut places = self.sets.get(state).into_iter().flatten();
        places.any(|place| self.ends.contains(place))
    }

    fn place(&mut self) -> usize {
        self.letters.push(Vec::new());
        self.silent.push(Vec::new());
        self.letters.len() - 1
    }

    fn join(&mut self, from: usize, to: usize) {
        if let Some(silent) = self.silent.get_mut(from) {
            silent.push(to);
        }
    }

    /// Lays a rule from a place on; gives the place behind it.
    fn lay(&mut self, rule: &Rule, from: usize) -> usize {
        match rule {
            Rule::Phrase(words) => {
                let mut at = from;
                for letter in words.split_whitespace().flat_map(|word| [" ", word]) {
                    for letter in letter.to_lowercase().bytes() {
                        let next = self.place();
                        if let Some(letters) = self.letters.get_mut(at) {
                            letters.push((letter, next));
                        }
                        at = next;
                    }
                }
                at
            }
            Rule::All(rules) => rules.iter().fold(from, |at, rule| self.lay(rule, at)),
            Rule::Any(rules) => {
                let end = self.place();
                for rule in rules {
                    let behind = self.lay(rule, from);
                    self.join(behind, end);
                }
                end
            }
            Rule::Maybe(rule) => {
                let end = self.lay(rule, from);
                self.join(from, end);
                end
            }
        }
    }

    /// All places that are reached from these without a letter.
    fn reach(&self, from: impl IntoIterator<Item = usize>) -> Vec<usize> {
        let mut reached = BTreeSet::new();
        let mut open: Vec<_> = from.into_iter().collect();
        while let Some(place) = open.pop() {
            if reached.insert(place) {
                open.extend(self.silent.get(place).into_iter().flatten());
            }
        }
        reached.into_iter().collect()
    }

    fn after(&self, set: &[usize], letter: u8) -> Vec<usize> {
        let places = set.iter().filter_map(|&place| self.letters.get(place));
        let fitting = places.flatten().filter(|(l, _)| *l == letter);
        self.reach(fitting.map(|(_, next)| *next).collect::<Vec<_>>())
    }

    fn number(&mut self, set: Vec<usize>) -> State {
        if let Some(&known) = self.numbers.get(&set) {
            return known;
        }
        self.sets.push(set.clone());
        self.numbers.insert(set, self.sets.len() - 1);
        self.sets.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn says(paths: &mut Paths, text: &str) -> Option<bool> {
        let state = text
            .bytes()
            .try_fold(Paths::START, |s, b| paths.follow(s, b))?;
        Some(paths.is_whole(state))
    }

    #[test]
    fn what_a_rule_says_is_a_path_and_nothing_else_is() {
        let phrase = |text: &str| Rule::Phrase(text.to_owned());
        let please = Rule::Maybe(Box::new(phrase("please")));
        let names = Rule::Any(vec![phrase("cup"), phrase("cups"), phrase("foam block")]);
        let pick = Rule::All(vec![please, phrase("pick"), names]);
        let mut paths = Paths::new(&[pick, phrase("stop")]);
        for whole in [" pick cup", "pick cups", "please pick foam block", " stop"] {
            assert_eq!(says(&mut paths, whole), Some(true), "{whole}");
        }
        for part in ["", "pick", "please", "pick foam"] {
            assert_eq!(says(&mut paths, part), Some(false), "{part}");
        }
        for other in [
            "pickcup",
            "pick  cup",
            "please stop",
            "pick cupss",
            "stop pick",
        ] {
            assert_eq!(says(&mut paths, other), None, "{other}");
        }
        assert_eq!(paths.letters(Paths::START), BTreeSet::from(*b" ps"));
    }
}
