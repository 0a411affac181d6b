//! Fills the table of phrases from a vocabulary and a language pack.

use deictic_core::category::Category;

use super::forms::{inflected, mentions};
use super::pack::Pack;
use super::table::{Meaning, Table, words_of};
use crate::vocabulary::{CategoryEntries, Lexicon};

impl Table {
    pub(super) fn names(&mut self, lexicon: &Lexicon, pack: &Pack) {
        for category in lexicon.categories() {
            for (option, entry) in (0..=u8::MAX).zip(&category.entries) {
                let name = Meaning::Name(category.category, option);
                entry.spoken().for_each(|words| self.add(&words, name));
                let known = pack.option.iter();
                known
                    .filter(|o| *o.category.as_ref() == category.name && o.name == entry.name)
                    .flat_map(|o| &o.words)
                    .for_each(|words| self.add(words, name));
            }
        }
        for option in &pack.option {
            let named = |c: &&CategoryEntries| c.name == *option.category.as_ref();
            let Some(category) = lexicon.categories().iter().find(named) else {
                continue;
            };
            if category.entries.iter().any(|e| e.name == option.name) || category.entries.is_empty()
            {
                continue;
            }
            for words in &option.words {
                let has = |m: &Meaning| matches!(m, Meaning::Name(c, _) if *c == category.category);
                let known = self.find_exact(&words_of(words));
                if !known.is_some_and(|p| p.means(has)) {
                    self.add(words, Meaning::Lacking(category.category));
                }
            }
        }
        for (option, entry) in (0..=u8::MAX).zip(lexicon.entries(Category::ACTION)) {
            for words in entry.spoken() {
                let words = words_of(&words);
                let Some((verb, rest)) = words.split_first() else {
                    continue;
                };
                let forms = inflected(verb, &pack.endings.verb);
                for form in forms.chain(mentions(verb, &pack.verb)) {
                    let form = [std::slice::from_ref(&form), rest].concat();
                    if self.find_exact(&form).is_none() {
                        self.add_tokens(form, Meaning::Form(option));
                    }
                }
                for form in inflected(verb, &pack.endings.command) {
                    let form = [std::slice::from_ref(&form), rest].concat();
                    if self.find_exact(&form).is_none_or(|known| !known.is_form()) {
                        self.add_tokens(form, Meaning::Name(Category::ACTION, option));
                    }
                }
            }
        }
    }

    pub(super) fn numbers(&mut self, lexicon: &Lexicon, pack: &Pack) {
        for (word, &value) in &pack.numbers {
            self.add(word, Meaning::Number(value));
        }
        for unit in &pack.unit {
            let kind = self.kind(lexicon, unit.category.as_ref());
            unit.words
                .iter()
                .for_each(|w| self.add(w, Meaning::Unit(kind, *unit.factor.as_ref())));
        }
        for quantity in &pack.quantity {
            let kind = self.kind(lexicon, quantity.category.as_ref());
            let meaning = Meaning::Quantity(kind, quantity.value);
            quantity.words.iter().for_each(|w| self.add(w, meaning));
        }
        let joints = &pack.joints;
        joints
            .and
            .iter()
            .for_each(|w| self.add(w, Meaning::NumberAnd));
        joints
            .point
            .iter()
            .for_each(|w| self.add(w, Meaning::Point));
        self.add("minus", Meaning::Minus);
        joints
            .minus
            .iter()
            .for_each(|w| self.add(w, Meaning::Minus));
    }

    fn kind(&mut self, lexicon: &Lexicon, name: &str) -> usize {
        match self.kinds.iter().position(|(n, _)| n == name) {
            Some(at) => at,
            None => {
                self.kinds.push((name.to_owned(), lexicon.category(name)));
                self.kinds.len() - 1
            }
        }
    }
}
