//! Every phrase that is known, from the vocabulary and from the language pack, with all that it can
//! mean; found by longest match.

use std::collections::HashMap;

use deictic_core::category::Category;

use super::forms::keys;
use super::pack::{Pack, Role};
use super::token::{Kind, Token, tokens};
use crate::vocabulary::Lexicon;

/// One thing that a phrase can mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meaning {
    /// An option of a category.
    Name(Category, u8),
    /// A form of an action's verb that is no command.
    Form(u8),
    /// The verb of an action whose particle comes later, as in "let the cup go".
    Head,
    /// An option that the language knows and the vocabulary's category does not have.
    Lacking(Category),
    /// A grammar word.
    Role(Role),
    /// A unit: the place of its category's name in [`Table::kinds`], and how much one is.
    Unit(usize, f64),
    /// A quantity without number, likewise.
    Quantity(usize, f32),
    /// A number.
    Number(f32),
    /// The joint between two parts of a number.
    NumberAnd,
    /// The joint before decimals.
    Point,
    /// The sign of a negative number.
    Minus,
}

/// A phrase.
#[derive(Clone, Debug)]
pub(super) struct Phrase {
    tokens: Vec<String>,
    meanings: Vec<Meaning>,
}

impl Phrase {
    pub(super) fn means(&self, wanted: impl Fn(&Meaning) -> bool) -> bool {
        self.meanings.iter().any(wanted)
    }

    pub(super) fn is_form(&self) -> bool {
        self.meanings.iter().any(|m| matches!(m, Meaning::Form(_)))
    }
}

/// A known phrase that begins a text, in that form or another.
#[derive(Clone, Debug, PartialEq)]
pub struct Longest {
    /// Its words as the vocabulary or the pack has them.
    pub words: Vec<String>,
    /// All that it can mean.
    pub meanings: Vec<Meaning>,
}

/// All known phrases of one vocabulary in one language.
#[derive(Clone, Debug)]
pub struct Table {
    phrases: Vec<Phrase>,
    exact: HashMap<String, Vec<usize>>,
    alike: HashMap<String, Vec<usize>>,
    /// Categories of quantities: their names, and which they are if the vocabulary has them.
    pub kinds: Vec<(String, Option<Category>)>,
    /// The action that beats everything.
    pub stop: Option<u8>,
    pack: Pack,
}

impl Table {
    /// The table of this vocabulary and pack.
    #[must_use]
    pub fn new(lexicon: &Lexicon, pack: Pack) -> Self {
        let mut table = Self {
            phrases: Vec::new(),
            exact: HashMap::new(),
            alike: HashMap::new(),
            kinds: Vec::new(),
            stop: lexicon.vocabulary().stop(),
            pack: pack.clone(),
        };
        table.names(lexicon, &pack);
        for (&role, words) in &pack.role {
            words.iter().for_each(|w| table.add(w, Meaning::Role(role)));
        }
        pack.polite
            .iter()
            .for_each(|w| table.add(w, Meaning::Role(Role::Polite)));
        table.numbers(lexicon, &pack);
        for filler in &pack.fillers {
            table.add(filler, Meaning::Role(Role::Filler));
        }
        // Those of a vocabulary say nothing only where the language has no use for them: "then".
        for filler in lexicon.fillers() {
            if table.find_exact(&words_of(filler)).is_none() {
                table.add(filler, Meaning::Role(Role::Filler));
            }
        }
        table.index();
        table
    }

    pub(super) fn add(&mut self, words: &str, meaning: Meaning) {
        self.add_tokens(words_of(words), meaning);
    }

    pub(super) fn add_tokens(&mut self, words: Vec<String>, meaning: Meaning) {
        let Some(first) = words.first() else { return };
        let list = self.exact.entry(first.clone()).or_default();
        let there = list.iter().find(|&&p| self.phrases[p].tokens == words);
        match there {
            Some(&p) => {
                if !self.phrases[p].meanings.contains(&meaning) {
                    self.phrases[p].meanings.push(meaning);
                }
            }
            None => {
                list.push(self.phrases.len());
                self.phrases.push(Phrase {
                    tokens: words,
                    meanings: vec![meaning],
                });
            }
        }
    }

    fn index(&mut self) {
        for (p, phrase) in self.phrases.iter().enumerate() {
            let is_thing = |m: &Meaning| matches!(m, Meaning::Name(c, _) if *c != Category::ACTION);
            if phrase.meanings.iter().any(is_thing)
                && let Some(first) = phrase.tokens.first()
            {
                for key in keys(first, &self.pack.endings) {
                    self.alike.entry(key).or_default().push(p);
                }
            }
        }
    }

    pub(super) fn find_exact(&self, words: &[String]) -> Option<&Phrase> {
        let list = self.exact.get(words.first()?)?;
        list.iter()
            .map(|&p| &self.phrases[p])
            .find(|p| p.tokens == words)
    }

    /// Whether an action's phrase starts with the first of these tokens and ends later among them.
    #[must_use]
    pub fn is_head(&self, tokens: &[Token]) -> bool {
        let Some((first, rest)) = tokens.split_first() else {
            return false;
        };
        let rest: Vec<_> = rest.iter().take_while(|t| t.kind == Kind::Word).collect();
        let list = self.exact.get(&first.text).into_iter().flatten();
        let mut actions = list.map(|&p| &self.phrases[p]).filter(|p| {
            let action = |m: &Meaning| matches!(m, Meaning::Name(Category::ACTION, _));
            p.tokens.len() > 1 && p.meanings.iter().any(action)
        });
        actions.any(|p| {
            let tail = p.tokens.get(1..).unwrap_or_default();
            rest.windows(tail.len())
                .any(|w| w.iter().zip(tail).all(|(a, b)| a.text == *b))
        })
    }

    /// What these words mean as one phrase.
    #[must_use]
    pub fn meanings(&self, words: &[&str]) -> &[Meaning] {
        let words: Vec<_> = words.iter().map(|&w| w.to_owned()).collect();
        self.find_exact(&words).map_or(&[], |p| &p.meanings)
    }

    /// The longest known phrase at the start of `tokens`. Forms of names count when no phrase of that
    /// length is there as it stands.
    #[must_use]
    pub fn longest(&self, tokens: &[Token]) -> Option<Longest> {
        let first = &tokens.first()?.text;
        let run = tokens.iter().take_while(|t| t.kind == Kind::Word).count();
        let fits = |p: &&Phrase| p.tokens.len() <= run;
        let exact = self
            .exact
            .get(first)
            .into_iter()
            .flatten()
            .map(|&p| &self.phrases[p]);
        let exact = exact
            .filter(fits)
            .filter(|p| p.tokens.iter().zip(tokens).all(|(a, b)| *a == b.text))
            .max_by_key(|p| p.tokens.len());
        let endings = &self.pack.endings;
        let alike = keys(first, endings).into_iter();
        let alike = alike
            .filter_map(|k| self.alike.get(&k))
            .flatten()
            .map(|&p| &self.phrases[p]);
        let alike = alike
            .filter(fits)
            .filter(|p| {
                p.tokens
                    .iter()
                    .zip(tokens)
                    .all(|(a, b)| is_form(a, &b.text, &self.pack))
            })
            .max_by_key(|p| p.tokens.len());
        match (exact, alike) {
            (Some(a), Some(b)) if b.tokens.len() > a.tokens.len() => Some(things(b)),
            (Some(a), _) => Some(Longest {
                words: a.tokens.clone(),
                meanings: a.meanings.clone(),
            }),
            (None, Some(b)) => Some(things(b)),
            (None, None) => None,
        }
    }

    /// Every phrase of the vocabulary: its words and the option it names.
    pub fn names_of(&self) -> impl Iterator<Item = (String, Category, u8)> + '_ {
        self.phrases.iter().flat_map(|phrase| {
            phrase.meanings.iter().filter_map(|m| match m {
                Meaning::Name(category, option) => {
                    Some((phrase.tokens.join(" "), *category, *option))
                }
                _ => None,
            })
        })
    }

    /// The words of the phrases that name actions.
    pub fn words_of_actions(&self) -> impl Iterator<Item = String> + '_ {
        let action = |m: &Meaning| matches!(m, Meaning::Name(Category::ACTION, _));
        let phrases = self.phrases.iter().filter(move |p| p.means(action));
        phrases.flat_map(|p| p.tokens.iter().cloned())
    }

    /// Every form of an action's verb that is no command.
    pub fn forms_of(&self) -> impl Iterator<Item = String> + '_ {
        let forms = self.phrases.iter().filter(|phrase| phrase.is_form());
        forms.map(|phrase| phrase.tokens.join(" "))
    }

    /// Single words of the pack with this role.
    pub fn words_of_role(&self, role: Role) -> impl Iterator<Item = &str> + '_ {
        let of_role = move |p: &&Phrase| p.meanings.contains(&Meaning::Role(role));
        let single = self
            .phrases
            .iter()
            .filter(of_role)
            .filter(|p| p.tokens.len() == 1);
        single.filter_map(|p| p.tokens.first().map(String::as_str))
    }

    /// Whether quantities of a kind add up, as "10 cm and 5 mm" do; "twice" and "50 percent" do not.
    #[must_use]
    pub fn sums(&self, kind: usize) -> bool {
        let kind = self.kinds.get(kind);
        kind.is_some_and(|(name, category)| name != "amount" && *category != Some(Category::AMOUNT))
    }

    /// The language pack.
    #[must_use]
    pub fn pack(&self) -> &Pack {
        &self.pack
    }
}

fn things(phrase: &Phrase) -> Longest {
    let things = phrase.meanings.iter();
    let things = things.filter(|m| matches!(m, Meaning::Name(c, _) if *c != Category::ACTION));
    Longest {
        words: phrase.tokens.clone(),
        meanings: things.copied().collect(),
    }
}

fn is_form(word: &str, said: &str, pack: &Pack) -> bool {
    word == said || {
        let known = keys(word, &pack.endings);
        keys(said, &pack.endings).iter().any(|k| known.contains(k))
    }
}

pub(super) fn words_of(text: &str) -> Vec<String> {
    let words = tokens(text).unwrap_or_default().into_iter();
    words
        .filter(|t| t.kind == Kind::Word)
        .map(|t| t.text)
        .collect()
}
