//! A JSGF grammar of all commands of a vocabulary, for recognisers that need one.

use std::fmt::Write;

use deictic_core::category::Category;

use crate::language::pack::{Pack, Speech};
use crate::language::token::{Kind, tokens};
use crate::vocabulary::Lexicon;

/// A grammar, and the phrases that are not in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Jsgf {
    /// The text of the grammar.
    pub text: String,
    /// Phrases with a word that the recogniser cannot pronounce.
    pub left_out: Vec<String>,
}

/// The grammar of a vocabulary; `pronounced` tells whether the recogniser knows a word. `None` when
/// the language has no words for speech, or when no action can be pronounced.
pub fn grammar(lexicon: &Lexicon, pack: &Pack, pronounced: impl Fn(&str) -> bool) -> Option<Jsgf> {
    let speech = pack.speech.as_ref()?;
    let mut left_out = Vec::new();
    let mut phrases = |category: Category, wanted: &dyn Fn(usize) -> bool| {
        let entries = lexicon.entries(category).iter().enumerate();
        let entries = entries.filter(|(option, _)| wanted(*option));
        let spoken = entries.flat_map(|(_, entry)| entry.spoken());
        let mut known: Vec<String> = Vec::new();
        for phrase in spoken.map(|p| plain(&p)) {
            if phrase.split(' ').all(&pronounced) {
                known.push(phrase);
            } else {
                left_out.push(phrase);
            }
        }
        known.sort();
        known.dedup();
        known
    };
    let actions = lexicon.vocabulary().actions();
    let needs = |option: usize, category: Category| {
        let action = actions.get(option);
        action.is_some_and(|a| a.signature.compulsory.contains(category.index()))
    };
    let object = |o: usize| needs(o, Category::OBJECT);
    let storage = |o: usize| needs(o, Category::STORAGE);
    let alone = phrases(Category::ACTION, &|o| !object(o) && !storage(o));
    let with_object = phrases(Category::ACTION, &|o| object(o) && !storage(o));
    let with_both = phrases(Category::ACTION, &|o| object(o) && storage(o));
    let objects = phrases(Category::OBJECT, &|_| true);
    let storages = phrases(Category::STORAGE, &|_| true);
    let directions = phrases(Category::DIRECTION, &|_| true);
    let mut text = "#JSGF V1.0;\ngrammar commands;\n".to_owned();
    let mut commands = Vec::new();
    let mut rule = |name: &str, list: &[String]| {
        if !list.is_empty() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "<{name}> = {};", list.join(" | "));
        }
        !list.is_empty()
    };
    words(speech, &mut rule);
    let has_objects = rule("object", &objects);
    let has_storages = rule("storage", &storages);
    let aside = if rule("direction", &directions) {
        " [[to the] <direction>]"
    } else {
        ""
    };
    let target = "([<determiner>] <object> | <pointed>)";
    if rule("alone", &alone) {
        commands.push("<alone>".to_owned());
    }
    if rule("one", &with_object) && has_objects {
        commands.push(format!("<one> {target}{aside}"));
    }
    if rule("two", &with_both) && has_objects && has_storages {
        let goal = "(<preposition> [<determiner>] <storage> | [<preposition>] <place>)";
        commands.push(format!("<two> {target} {goal}"));
    }
    if commands.is_empty() {
        return None;
    }
    let _ = writeln!(text, "<command> = {};", commands.join(" | "));
    text.push_str("public <utterance> = [<polite>] [<not>] <command> [<polite>];\n");
    Some(Jsgf { text, left_out })
}

fn words(speech: &Speech, rule: &mut impl FnMut(&str, &[String]) -> bool) {
    rule("polite", &speech.polite);
    rule("not", &speech.not);
    rule("determiner", &speech.determiner);
    rule("pointed", &speech.pointed);
    rule("preposition", &speech.preposition);
    rule("place", &speech.place);
}

/// The words of a phrase alone, as a dictionary has them.
fn plain(phrase: &str) -> String {
    let words = tokens(phrase).unwrap_or_default().into_iter();
    let words: Vec<_> = words
        .filter(|t| t.kind == Kind::Word)
        .map(|t| t.text)
        .collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_that_can_be_pronounced_is_in_it() {
        let lexicon = Lexicon::tabletop().unwrap();
        let pack = Pack::built_in("en").unwrap();
        let jsgf = grammar(&lexicon, &pack, |word| word != "unstick").unwrap();
        assert_eq!(jsgf.left_out, ["unstick"]);
        for phrase in ["put into", "move up", "crackers", "foam block", "<not>"] {
            assert!(jsgf.text.contains(phrase), "{phrase}");
        }
        assert!(!jsgf.text.contains("unstick"));
        let czech = Pack::built_in("cs").unwrap();
        assert_eq!(grammar(&lexicon, &czech, |_| true), None);
    }
}
