//! JSGF grammars over a vocabulary, one per meaning that is held against the others.
//!
//! A recogniser's own list of alternatives is mostly one sentence in many wordings. So each option of
//! a category gets a grammar of all commands that have it: how well the sound fits the best of them
//! tells how probable the option is.

use std::collections::BTreeSet;

use deictic_core::category::Category;

use crate::language::pack::{Pack, Speech};
use crate::language::token::{Kind, tokens};
use crate::vocabulary::Lexicon;

/// All phrases of a vocabulary that can be said aloud.
#[derive(Clone, Debug)]
pub struct Phrases {
    speech: Speech,
    /// Per option: its phrases, and whether an action needs an object and a storage.
    actions: Vec<(Vec<String>, bool, bool)>,
    objects: Vec<Vec<String>>,
    storages: Vec<Vec<String>>,
    directions: Vec<String>,
    left_out: Vec<String>,
}

/// What a grammar is to be restricted to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Only {
    /// Commands with this option of the action, the object or the storage.
    Option(Category, usize),
    /// Commands that are forbidden.
    Forbidden,
    /// The name of this option alone, as an answer to a question.
    Name(Category, usize),
    /// Yes.
    Yes,
    /// No, none of them.
    No,
}

impl Phrases {
    /// The phrases of a vocabulary; `pronounced` tells whether the recogniser knows a word. `None`
    /// when the language has no words for speech, or when no action can be pronounced.
    pub fn new(
        lexicon: &Lexicon,
        pack: &Pack,
        mut pronounced: impl FnMut(&str) -> bool,
    ) -> Option<Self> {
        let speech = pack.speech.clone()?;
        let mut left_out = Vec::new();
        let mut of = |category: Category| {
            let entries = lexicon.entries(category).iter();
            let phrases = entries.map(|entry| {
                let said = entry.spoken().map(|p| plain(&p)).collect::<BTreeSet<_>>();
                let (known, unknown): (Vec<_>, Vec<_>) = said
                    .into_iter()
                    .partition(|p| p.split(' ').all(&mut pronounced));
                left_out.extend(unknown);
                known
            });
            phrases.collect::<Vec<Vec<String>>>()
        };
        let (actions, objects) = (of(Category::ACTION), of(Category::OBJECT));
        let (storages, directions) = (of(Category::STORAGE), of(Category::DIRECTION).concat());
        let needs = |action: usize, category: Category| {
            let action = lexicon.vocabulary().actions().get(action);
            action.is_some_and(|a| a.signature.compulsory.contains(category.index()))
        };
        let actions: Vec<_> = actions
            .into_iter()
            .enumerate()
            .map(|(a, phrases)| {
                let object = needs(a, Category::OBJECT);
                (phrases, object, needs(a, Category::STORAGE))
            })
            .collect();
        let said = actions.iter().any(|(phrases, ..)| !phrases.is_empty());
        said.then_some(Self {
            speech,
            actions,
            objects,
            storages,
            directions,
            left_out,
        })
    }

    /// Phrases with a word that the recogniser cannot pronounce.
    #[must_use]
    pub fn left_out(&self) -> &[String] {
        &self.left_out
    }

    /// Every word of every grammar.
    #[must_use]
    pub fn words(&self) -> BTreeSet<&str> {
        let speech = &self.speech;
        let grammar = [
            &speech.polite,
            &speech.not,
            &speech.determiner,
            &speech.pointed,
            &speech.preposition,
            &speech.place,
            &speech.yes,
            &speech.no,
        ];
        let names = self.actions.iter().map(|(phrases, ..)| phrases);
        let names = names.chain(&self.objects).chain(&self.storages);
        let all = grammar.into_iter().chain(names).chain([&self.directions]);
        all.flatten().flat_map(|p| p.split(' ')).collect()
    }

    /// All that commands are held against: every option, and that none is given.
    #[must_use]
    pub fn commands(&self) -> Vec<Only> {
        let options = |category, count: usize| (0..count).map(move |o| Only::Option(category, o));
        options(Category::ACTION, self.actions.len())
            .chain(options(Category::OBJECT, self.objects.len()))
            .chain(options(Category::STORAGE, self.storages.len()))
            .chain([Only::Forbidden])
            .collect()
    }

    /// All that answers are held against.
    #[must_use]
    pub fn answers(&self) -> Vec<Only> {
        let options = |category, count: usize| (0..count).map(move |o| Only::Name(category, o));
        options(Category::ACTION, self.actions.len())
            .chain(options(Category::OBJECT, self.objects.len()))
            .chain(options(Category::STORAGE, self.storages.len()))
            .chain([Only::Yes, Only::No])
            .collect()
    }

    /// The grammar of what is left under a restriction; `None` when nothing is.
    #[must_use]
    pub fn grammar(&self, only: Only) -> Option<String> {
        let list = match only {
            Only::Option(..) | Only::Forbidden => return self.of_commands(only),
            Only::Name(Category::ACTION, o) => &self.actions.get(o)?.0,
            Only::Name(Category::OBJECT, o) => self.objects.get(o)?,
            Only::Name(_, o) => self.storages.get(o)?,
            Only::Yes => &self.speech.yes,
            Only::No => &self.speech.no,
        };
        let determiner = match only {
            Only::Name(c, _) if c != Category::ACTION => optional(&self.speech.determiner),
            _ => String::new(),
        };
        let polite = optional(&self.speech.polite);
        let names = (!list.is_empty()).then(|| list.join(" | "))?;
        Some(format!(
            "{HEAD}public <utterance> = {determiner} ({names}) {polite};\n"
        ))
    }

    fn of_commands(&self, only: Only) -> Option<String> {
        let fits = |category: Category, option: usize| match only {
            Only::Option(c, o) => c != category || o == option,
            _ => true,
        };
        let fixed = |category| matches!(only, Only::Option(c, _) if c == category);
        let (object, storage) = (fixed(Category::OBJECT), fixed(Category::STORAGE));
        let names = |category: Category, all: &[Vec<String>]| {
            let fitting = all.iter().enumerate().filter(|(o, _)| fits(category, *o));
            fitting.flat_map(|(_, p)| p.clone()).collect::<Vec<_>>()
        };
        let verbs = |takes_object: bool, takes_storage: bool| {
            let fitting = self.actions.iter().enumerate().filter(|(a, (_, o, s))| {
                fits(Category::ACTION, *a) && (*o, *s) == (takes_object, takes_storage)
            });
            fitting
                .flat_map(|(_, (p, ..))| p.clone())
                .collect::<Vec<_>>()
        };
        let speech = &self.speech;
        let determiner = optional(&speech.determiner);
        let targets = names(Category::OBJECT, &self.objects);
        let mut target = choice(&targets).map(|names| format!("{determiner} {names}"));
        if let Some(shown) = choice(&speech.pointed).filter(|_| !object) {
            target = Some(target.map_or(shown.clone(), |t| format!("({t} | {shown})")));
        }
        let goals = names(Category::STORAGE, &self.storages);
        let preposition = choice(&speech.preposition).unwrap_or_default();
        let mut goal = choice(&goals).map(|names| format!("{preposition} {determiner} {names}"));
        if let Some(shown) = choice(&speech.place).filter(|_| !storage) {
            goal = Some(goal.map_or(shown.clone(), |g| format!("({g} | {shown})")));
        }
        let aside = match choice(&self.directions) {
            Some(directions) => format!("[{directions}]"),
            None => String::new(),
        };
        let mut commands = Vec::new();
        if let Some(alone) = choice(&verbs(false, false)).filter(|_| !object && !storage) {
            commands.push(alone);
        }
        if let (Some(one), Some(target), false) = (choice(&verbs(true, false)), &target, storage) {
            commands.push(format!("{one} {target} {aside}"));
        }
        if let (Some(two), Some(target), Some(goal)) = (choice(&verbs(true, true)), &target, &goal)
        {
            commands.push(format!("{two} {target} {goal}"));
        }
        let commands = choice(&commands)?;
        let polite = optional(&speech.polite);
        let not = match only {
            Only::Forbidden => choice(&speech.not)?,
            _ => String::new(),
        };
        Some(format!(
            "{HEAD}public <utterance> = {polite} {not} {commands} {polite};\n"
        ))
    }
}

const HEAD: &str = "#JSGF V1.0;\ngrammar commands;\n";

fn choice(list: &[String]) -> Option<String> {
    (!list.is_empty()).then(|| format!("({})", list.join(" | ")))
}

fn optional(list: &[String]) -> String {
    choice(list).map_or_else(String::new, |c| format!("[{c}]"))
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

    fn tabletop() -> (Lexicon, Phrases) {
        let lexicon = Lexicon::tabletop().unwrap();
        let pack = Pack::built_in("en").unwrap();
        let phrases = Phrases::new(&lexicon, &pack, |word| word != "unstick").unwrap();
        (lexicon, phrases)
    }

    #[test]
    fn an_option_has_its_own_words_and_those_of_the_other_categories() {
        let (lexicon, phrases) = tabletop();
        assert_eq!(phrases.left_out(), ["unstick"]);
        let option = |category: Category, name: &str| {
            let entries = lexicon.entries(category).iter();
            let at = entries.enumerate().find(|(_, e)| e.name == name).unwrap().0;
            phrases.grammar(Only::Option(category, at)).unwrap()
        };
        let pick = option(Category::ACTION, "pick");
        assert!(pick.contains("grasp") && !pick.contains("crackers"));
        assert!(pick.contains("mug") && !pick.contains("push") && !pick.contains("stop"));
        let foam = option(Category::STORAGE, "foam");
        assert!(foam.contains("sponge") && !foam.contains("bowl") && !foam.contains("there"));
        assert!(foam.contains("put") && !foam.contains("grasp") && !foam.contains("release"));
        let up = option(Category::ACTION, "move-up");
        assert!(up.contains("go up") && !up.contains("halt"));
        let not = phrases.grammar(Only::Forbidden).unwrap();
        assert!(not.contains("(don't | do not | never) ("));
    }

    #[test]
    fn answers_are_names() {
        let (_, phrases) = tabletop();
        let cup = phrases.grammar(Only::Name(Category::OBJECT, 1)).unwrap();
        assert!(cup.contains("[(the)] (cup | mug)"), "{cup}");
        assert_eq!(phrases.answers().len(), 9 + 5 + 4 + 2);
        assert!(
            phrases
                .answers()
                .iter()
                .all(|&a| phrases.grammar(a).is_some())
        );
        assert_eq!(phrases.grammar(Only::Name(Category::OBJECT, 99)), None);
    }

    #[test]
    fn every_word_of_a_grammar_is_listed() {
        let (_, phrases) = tabletop();
        let words = phrases.words();
        for only in phrases.commands().into_iter().chain(phrases.answers()) {
            let grammar = phrases.grammar(only).unwrap();
            let body = grammar.split_once('=').unwrap().1;
            let listed = body
                .split(|c: char| "()[]|; \n".contains(c))
                .filter(|w| !w.is_empty());
            assert!(listed.clone().all(|w| words.contains(w)), "{grammar}");
        }
    }

    #[test]
    fn a_language_without_words_for_speech_has_no_grammar() {
        let czech = Pack::built_in("cs").unwrap();
        assert!(Phrases::new(&Lexicon::tabletop().unwrap(), &czech, |_| true).is_none());
    }
}
