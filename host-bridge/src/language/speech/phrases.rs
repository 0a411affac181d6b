//! What may be said over a vocabulary, as one rule for all of it or restricted to one meaning.
//!
//! A recogniser whose list of alternatives is mostly one sentence in many wordings gets a rule per
//! option of a category, of all commands that have it: how well the sound fits the best of them tells
//! how probable the option is.

use std::collections::BTreeSet;

use deictic_core::category::{BitSet, Category};

use super::measures::Measures;
use super::rule::{Rule, all};
use crate::language::pack::{Pack, Speech};
use crate::language::token::{Kind, tokens};
use crate::vocabulary::Lexicon;

/// All phrases of a vocabulary that can be said aloud.
#[derive(Clone, Debug)]
pub struct Phrases {
    pub(super) speech: Speech,
    pub(super) actions: Vec<Verbs>,
    pub(super) objects: Vec<Vec<String>>,
    pub(super) storages: Vec<Vec<String>>,
    pub(super) directions: Vec<String>,
    pub(super) measures: Measures,
    /// The action that stops.
    stop: Option<usize>,
    left_out: Vec<String>,
}

/// What an action is called, and what is said with it.
#[derive(Clone, Debug)]
pub(super) struct Verbs {
    pub phrases: Vec<String>,
    pub takes: Takes,
}

/// What is said with an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Takes {
    pub object: bool,
    pub storage: bool,
    /// Whether it may be said where to.
    pub direction: bool,
    /// The categories of which a quantity may be said.
    pub measures: BitSet,
}

/// What somebody is expected to say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// A command.
    Command,
    /// A command, or that what the robot is doing is not to go on.
    Underway,
    /// The answer to a question: a name, yes or no.
    Answer,
}

/// What a rule is to be restricted to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Only {
    /// Any command.
    Command,
    /// Commands with this option of the action, the object or the storage.
    Option(Category, usize),
    /// Commands that are forbidden.
    Forbidden,
    /// The name of this option alone, as an answer to a question.
    Name(Category, usize),
    /// That what is going on is not to go on: "no", "no, stop", "don't".
    Refusal,
    /// What is told the robot itself.
    Order,
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
        let signatures = lexicon.vocabulary().actions().iter().map(|a| a.signature);
        let actions: Vec<_> = actions
            .into_iter()
            .zip(signatures)
            .map(|(mut phrases, signature)| {
                let needs = |c: Category| signature.compulsory.contains(c.index());
                let any = signature.compulsory.union(signature.voluntary);
                let named = [Category::OBJECT, Category::STORAGE, Category::DIRECTION];
                let measured = any.iter().filter(|i| named.iter().all(|c| c.index() != *i));
                let storage = needs(Category::STORAGE);
                // "put on the cup into the drawer" is said by nobody, and sounds like "put the cup".
                let goes = |w: &str| speech.preposition.iter().any(|p| p == w);
                let open = |p: &String| p.split(' ').skip(1).any(goes);
                if storage && !phrases.iter().all(open) {
                    phrases.retain(|p| !open(p));
                }
                let takes = Takes {
                    object: needs(Category::OBJECT),
                    storage,
                    direction: any.contains(Category::DIRECTION.index()),
                    measures: measured.fold(BitSet::EMPTY, BitSet::with),
                };
                Verbs { phrases, takes }
            })
            .collect();
        let said = actions.iter().any(|verbs| !verbs.phrases.is_empty());
        let measures = Measures::new(lexicon, pack, &speech, pronounced);
        said.then_some(Self {
            speech,
            actions,
            objects,
            storages,
            directions,
            measures,
            stop: lexicon.vocabulary().stop().map(usize::from),
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
            &speech.order,
        ];
        let names = self.actions.iter().map(|verbs| &verbs.phrases);
        let names = names.chain(&self.objects).chain(&self.storages);
        let all = grammar.into_iter().chain(names).chain([&self.directions]);
        let all = all.flatten().chain(self.measures.phrases());
        all.flat_map(|p| p.split(' ')).collect()
    }

    /// Words of which no meaning changes when they are left out.
    #[must_use]
    pub fn idle(&self) -> Vec<String> {
        [self.speech.polite.as_slice(), &self.speech.determiner].concat()
    }

    /// All that commands are held against: every option, and that none is given.
    #[must_use]
    pub fn commands(&self) -> Vec<Only> {
        let options = |category, count: usize| (0..count).map(move |o| Only::Option(category, o));
        options(Category::ACTION, self.actions.len())
            .chain(options(Category::OBJECT, self.objects.len()))
            .chain(options(Category::STORAGE, self.storages.len()))
            .chain([Only::Forbidden, Only::Order])
            .collect()
    }

    /// Whatever may be commanded, forbidden, or told the robot itself.
    #[must_use]
    pub fn any_command(&self) -> Vec<Only> {
        vec![Only::Command, Only::Forbidden, Only::Order]
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

    fn refusal(&self) -> Option<Rule> {
        let no = [self.speech.no.as_slice(), &self.speech.not].concat();
        let stop = self.stop.and_then(|stop| self.actions.get(stop));
        let more = [no.as_slice(), stop.map_or(&[], |s| &s.phrases)].concat();
        Some(all([Rule::any_of(&no), Rule::maybe_of(&more)]))
    }

    /// What is left under a restriction; `None` when nothing is.
    #[must_use]
    pub fn rule(&self, only: Only) -> Option<Rule> {
        let list = match only {
            Only::Command | Only::Option(..) | Only::Forbidden => return self.of_commands(only),
            Only::Name(Category::ACTION, o) => &self.actions.get(o)?.phrases,
            Only::Name(Category::OBJECT, o) => self.objects.get(o)?,
            Only::Name(_, o) => self.storages.get(o)?,
            Only::Refusal => return self.refusal(),
            Only::Order => &self.speech.order,
            Only::Yes => &self.speech.yes,
            Only::No => &self.speech.no,
        };
        let determiner = match only {
            Only::Name(c, _) if c != Category::ACTION => Rule::maybe_of(&self.speech.determiner),
            _ => None,
        };
        let polite = Rule::maybe_of(&self.speech.polite);
        let names = Rule::any_of(list)?;
        Some(all([determiner, Some(names), polite]))
    }
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
            phrases
                .rule(Only::Option(category, at))
                .unwrap()
                .to_string()
        };
        let pick = option(Category::ACTION, "pick");
        assert!(pick.contains("grasp") && !pick.contains("crackers"));
        assert!(pick.contains("mug") && !pick.contains("push") && !pick.contains("stop"));
        let foam = option(Category::STORAGE, "foam");
        assert!(foam.contains("sponge") && !foam.contains("bowl") && !foam.contains("there"));
        assert!(foam.contains("put") && !foam.contains("grasp") && !foam.contains("release"));
        let up = option(Category::ACTION, "move-up");
        assert!(up.contains("go up") && !up.contains("halt"));
        let stack = option(Category::ACTION, "stack");
        assert!(stack.contains("pile") && !stack.contains("put on"));
        let not = phrases.rule(Only::Forbidden).unwrap().to_string();
        assert!(not.contains("(don't | do not | never) ("));
        let refused = phrases.rule(Only::Refusal).unwrap().to_string();
        assert!(
            refused.starts_with("(no | ") && refused.contains("halt"),
            "{refused}"
        );
    }

    #[test]
    fn answers_are_names() {
        let (_, phrases) = tabletop();
        let cup = phrases.rule(Only::Name(Category::OBJECT, 1)).unwrap();
        let cup = cup.to_string();
        assert!(cup.contains("[(the)] (cup | mug)"), "{cup}");
        assert_eq!(phrases.answers().len(), 9 + 5 + 4 + 2);
        assert!(phrases.answers().iter().all(|&a| phrases.rule(a).is_some()));
        assert_eq!(phrases.rule(Only::Name(Category::OBJECT, 99)), None);
    }

    #[test]
    fn every_word_of_a_grammar_is_listed() {
        let (_, phrases) = tabletop();
        let words = phrases.words();
        for only in phrases.commands().into_iter().chain(phrases.answers()) {
            let rule = phrases.rule(only).unwrap().to_string();
            let listed = rule
                .split(|c: char| "()[]| ".contains(c))
                .filter(|w| !w.is_empty());
            assert!(listed.clone().all(|w| words.contains(w)), "{rule}");
        }
    }

    #[test]
    fn a_language_without_words_for_speech_has_no_grammar() {
        let czech = Pack::built_in("cs").unwrap();
        assert!(Phrases::new(&Lexicon::tabletop().unwrap(), &czech, |_| true).is_none());
    }
}
