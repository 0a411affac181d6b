//! How quantities are said aloud: "five centimetres", "by a quarter turn", "a bit".

use deictic_core::category::Category;

use super::rule::Rule;
use crate::language::pack::{Pack, Role, Speech};
use crate::vocabulary::Lexicon;

/// What a vocabulary's categories are measured in.
#[derive(Clone, Debug, Default)]
pub struct Measures {
    by: Vec<String>,
    /// Round numbers that others may follow ("twenty"), those others ("five"), and the rest.
    tens: Vec<String>,
    ones: Vec<String>,
    numbers: Vec<String>,
    kinds: Vec<Kind>,
}

/// One category's words.
#[derive(Clone, Debug)]
struct Kind {
    category: Category,
    units: Vec<String>,
    /// Quantities without number.
    quantities: Vec<String>,
}

impl Measures {
    /// Those that the pack's table for speech lists and the recogniser can pronounce.
    pub fn new(
        lexicon: &Lexicon,
        pack: &Pack,
        speech: &Speech,
        mut pronounced: impl FnMut(&str) -> bool,
    ) -> Self {
        let mut known = |list: &[String]| -> Vec<String> {
            let known = list.iter().filter(|p| p.split(' ').all(&mut pronounced));
            known.cloned().collect()
        };
        let (by, said) = (known(&speech.by), known(&speech.number));
        let (units, quantities) = (known(&speech.unit), known(&speech.quantity));
        let mut measures = Self {
            by,
            ..Self::default()
        };
        // "A metre" is counted, "twenty a metres" is not.
        let articles = pack.role.get(&Role::Article);
        let article = |word: &String| articles.is_some_and(|a| a.contains(word));
        for word in said {
            let value = pack.numbers.get(&word).copied().unwrap_or_default();
            let whole = value > 0.0 && value.fract() == 0.0 && !article(&word);
            if whole && value < 10.0 {
                measures.ones.push(word);
            } else if whole && (20.0..100.0).contains(&value) && value % 10.0 == 0.0 {
                measures.tens.push(word);
            } else {
                measures.numbers.push(word);
            }
        }
        let mut names: Vec<_> = pack
            .unit
            .iter()
            .map(|u| u.category.as_ref().as_str())
            .collect();
        names.extend(pack.quantity.iter().map(|q| q.category.as_ref().as_str()));
        names.sort_unstable();
        names.dedup();
        for name in names {
            let Some(category) = lexicon.category(name) else {
                continue;
            };
            let of_units = pack.unit.iter().filter(|u| u.category.as_ref() == name);
            let of_units: Vec<_> = of_units.flat_map(|u| &u.words).collect();
            let of_words = pack.quantity.iter().filter(|q| q.category.as_ref() == name);
            let of_words: Vec<_> = of_words.flat_map(|q| &q.words).collect();
            let those = |list: &[String], of: &[&String]| -> Vec<String> {
                list.iter().filter(|w| of.contains(w)).cloned().collect()
            };
            measures.kinds.push(Kind {
                category,
                units: those(&units, &of_units),
                quantities: those(&quantities, &of_words),
            });
        }
        measures
    }

    /// A quantity of a category; `None` when nobody could say one.
    #[must_use]
    pub fn rule(&self, category: Category) -> Option<Rule> {
        let kind = self.kinds.iter().find(|k| k.category == category)?;
        let many = match (Rule::any_of(&self.tens), Rule::maybe_of(&self.ones)) {
            (Some(tens), Some(ones)) => Some(Rule::All(vec![tens, ones])),
            (tens, _) => tens,
        };
        let numbers = [Rule::any_of(&self.ones), many, Rule::any_of(&self.numbers)];
        let numbers: Vec<_> = numbers.into_iter().flatten().collect();
        let counted = Rule::any_of(&kind.units).filter(|_| !numbers.is_empty());
        let counted = counted.map(|units| {
            let by = Rule::maybe_of(&self.by).into_iter();
            Rule::All(by.chain([Rule::Any(numbers), units]).collect())
        });
        let quantities = Rule::any_of(&kind.quantities);
        let all: Vec<_> = counted.into_iter().chain(quantities).collect();
        (!all.is_empty()).then_some(Rule::Any(all))
    }

    /// All phrases.
    pub fn phrases(&self) -> impl Iterator<Item = &String> {
        let lists = [&self.by, &self.tens, &self.ones, &self.numbers];
        let kinds = self.kinds.iter();
        let kinds = kinds.flat_map(|k| k.units.iter().chain(&k.quantities));
        lists.into_iter().flatten().chain(kinds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measures(pronounced: impl FnMut(&str) -> bool) -> (Lexicon, Measures) {
        let lexicon = Lexicon::tabletop().unwrap();
        let pack = Pack::built_in("en").unwrap();
        let speech = pack.speech.clone().unwrap();
        let measures = Measures::new(&lexicon, &pack, &speech, pronounced);
        (lexicon, measures)
    }

    #[test]
    fn every_category_has_its_own_units() {
        let (lexicon, measures) = measures(|_| true);
        let of = |name: &str| {
            let category = lexicon.category(name).unwrap();
            measures.rule(category).map(|rule| rule.to_string())
        };
        let distance = of("distance").unwrap();
        assert!(distance.contains("[(by)] (") && distance.contains("centimetres"));
        assert!(distance.contains("a bit") && !distance.contains("degrees"));
        let angle = of("angle").unwrap();
        assert!(angle.contains("degrees") && !angle.contains("centimetres"));
        assert_eq!(of("object"), None);
    }

    #[test]
    fn only_tens_are_followed_by_ones() {
        let (_, measures) = measures(|_| true);
        assert!(measures.tens.contains(&"twenty".to_owned()));
        assert!(measures.ones.contains(&"five".to_owned()));
        for lone in ["a", "ten", "half a"] {
            assert!(measures.numbers.contains(&lone.to_owned()), "{lone}");
        }
    }

    #[test]
    fn what_cannot_be_pronounced_is_left_out() {
        let (lexicon, measures) = measures(|word| !word.starts_with("cent"));
        let distance = measures.rule(lexicon.category("distance").unwrap());
        let distance = distance.unwrap().to_string();
        assert!(distance.contains("metres") && !distance.contains("centi"));
    }
}
