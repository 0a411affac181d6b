//! Commands as a rule: what is done, to which thing, where, which way and how much.

use deictic_core::category::Category;

use super::phrases::{Only, Phrases, Takes};
use super::rule::{Rule, all, either};

impl Phrases {
    /// Commands under a restriction; `None` when none are left.
    pub(super) fn of_commands(&self, only: Only) -> Option<Rule> {
        let fits = |category: Category, option: usize| match only {
            Only::Option(c, o) => c != category || o == option,
            _ => true,
        };
        let fixed = |category| matches!(only, Only::Option(c, _) if c == category);
        let (object, storage) = (fixed(Category::OBJECT), fixed(Category::STORAGE));
        let names = |category: Category, all: &[Vec<String>]| {
            let fitting = all.iter().enumerate().filter(|(o, _)| fits(category, *o));
            Rule::any_of(&fitting.flat_map(|(_, p)| p.clone()).collect::<Vec<_>>())
        };
        let verbs = |takes: Takes| {
            let fitting = self.actions.iter().enumerate();
            let fitting = fitting.filter(|(a, v)| fits(Category::ACTION, *a) && v.takes == takes);
            let phrases = fitting.flat_map(|(_, v)| v.phrases.clone());
            Rule::any_of(&phrases.collect::<Vec<_>>())
        };
        let speech = &self.speech;
        let determiner = || Rule::maybe_of(&speech.determiner);
        let shown = |list: &[String], fixed: bool| Rule::any_of(list).filter(|_| !fixed);
        let targets = names(Category::OBJECT, &self.objects);
        let targets = targets.map(|names| all([determiner(), Some(names)]));
        let target = either(
            [targets, shown(&speech.pointed, object)]
                .into_iter()
                .flatten(),
        );
        let goals = names(Category::STORAGE, &self.storages);
        let preposition = Rule::any_of(&speech.preposition);
        let goals = goals.map(|names| all([preposition, determiner(), Some(names)]));
        let goal = either([goals, shown(&speech.place, storage)].into_iter().flatten());
        let mut kinds: Vec<Takes> = Vec::new();
        for verbs in &self.actions {
            if !kinds.contains(&verbs.takes) {
                kinds.push(verbs.takes);
            }
        }
        let commands = kinds.into_iter().filter_map(|takes| {
            let verb = verbs(takes)?;
            let target = if takes.object {
                Some(target.clone()?)
            } else {
                None
            };
            let goal = if takes.storage {
                Some(goal.clone()?)
            } else {
                None
            };
            // A restriction to an option leaves out what cannot have it.
            let fixed = (object && !takes.object) || (storage && !takes.storage);
            (!fixed).then(|| all([Some(verb), target, goal, self.more(takes)]))
        });
        let commands = either(commands)?;
        let not = match only {
            Only::Forbidden => Some(Rule::any_of(&speech.not)?),
            _ => None,
        };
        let polite = || Rule::maybe_of(&speech.polite);
        Some(all([polite(), not, Some(commands), polite()]))
    }

    /// Which way and how much, in either order, or neither.
    fn more(&self, takes: Takes) -> Option<Rule> {
        let directions = Rule::any_of(&self.directions).filter(|_| takes.direction);
        let categories = (0..Category::LIMIT).filter_map(Category::from_index);
        let categories = categories.filter(|c| takes.measures.contains(c.index()));
        let amount = either(categories.filter_map(|c| self.measures.rule(c)));
        match (directions, amount) {
            (Some(way), Some(far)) => Some(Rule::Maybe(Box::new(Rule::Any(vec![
                Rule::All(vec![way.clone(), Rule::Maybe(Box::new(far.clone()))]),
                Rule::All(vec![far, Rule::Maybe(Box::new(way))]),
            ])))),
            (one, other) => one.or(other).map(|one| Rule::Maybe(Box::new(one))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::pack::Pack;
    use crate::language::speech::paths::Paths;
    use crate::vocabulary::Lexicon;

    #[test]
    fn quantities_and_directions_are_said_of_what_takes_them() {
        let pack = Pack::built_in("en").unwrap();
        let phrases = Phrases::new(&Lexicon::tabletop().unwrap(), &pack, |_| true).unwrap();
        let mut paths = Paths::new(&[phrases.rule(Only::Command).unwrap()]);
        let mut may_be_said = |text: &str| {
            let mut letters = text.bytes();
            let end = letters.try_fold(Paths::START, |state, letter| paths.follow(state, letter));
            end.is_some_and(|end| paths.is_whole(end))
        };
        for said in [
            "move up",
            "please move up by twenty five centimetres",
            "go up a bit",
            "push the cup left",
            "push the cup left half a metre",
            "push this ten centimeters left please",
            "pour the cup into the bowl ninety degrees",
        ] {
            assert!(may_be_said(said), "{said}");
        }
        for not in [
            "move up five",
            "move up ninety degrees",
            "pick the cup left",
            "stop five centimetres",
            "put the cup into the bowl a bit",
        ] {
            assert!(!may_be_said(not), "{not}");
        }
    }
}
