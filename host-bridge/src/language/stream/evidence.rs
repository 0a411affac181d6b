//! What a hypothesis says about the options of each class.

use super::grammar::{Class, Grammar};
use super::{Hypothesis, Streams};

/// Probability of an option that a recogniser does not name: it has errors that it does not list.
pub(super) const UNNAMED: f64 = 0.02;

/// Probability that a word was covered by a hesitation.
pub(super) const COVERED: f64 = 0.3;

/// A token of the voice.
#[derive(Clone, Debug)]
pub(super) struct Token {
    pub time: f64,
    /// Whether it names nothing: a hesitation, which may cover any word, or none.
    covered: bool,
    words: Vec<(Class, usize, f64)>,
}

/// A gesture: probabilities over the options of one class; things may be object or storage.
#[derive(Clone, Debug)]
pub(super) struct Shown {
    pub time: f64,
    pub is_action: bool,
    options: Vec<(Class, usize, f64)>,
}

/// The tokens of the voice, without what says nothing.
pub(super) fn tokens(streams: &Streams, grammar: &Grammar) -> Vec<Token> {
    let filler = |w: &String| {
        grammar
            .words()
            .fillers
            .iter()
            .any(|f| f.eq_ignore_ascii_case(w))
    };
    let heard = streams.voice.iter().filter(|h| h.time.is_finite());
    let says = heard.filter(|h| h.words.iter().any(|(word, _)| !filler(word)));
    let mut tokens: Vec<_> = says
        .map(|hypothesis| {
            let words = named(hypothesis, grammar);
            let covered = words.is_empty();
            Token {
                time: hypothesis.time,
                covered,
                words,
            }
        })
        .collect();
    tokens.sort_by(|a, b| a.time.total_cmp(&b.time));
    tokens
}

/// The gestures.
pub(super) fn shown(streams: &Streams, grammar: &Grammar) -> Vec<Shown> {
    let hypotheses = streams.gesture.iter().filter(|h| h.time.is_finite());
    let mut shown: Vec<_> = hypotheses
        .filter_map(|hypothesis| {
            let options = named(hypothesis, grammar);
            let actions = options.iter().filter(|(c, ..)| *c == Class::Action);
            let action: f64 = actions.map(|(.., p)| p).sum();
            let things = options
                .iter()
                .filter(|(c, ..)| matches!(c, Class::Object | Class::Storage));
            let thing: f64 = things.map(|(.., p)| p).sum();
            let is_action = action > thing;
            (action + thing > 0.0).then_some(Shown {
                time: hypothesis.time,
                is_action,
                options,
            })
        })
        .collect();
    shown.sort_by(|a, b| a.time.total_cmp(&b.time));
    shown
}

fn named(hypothesis: &Hypothesis, grammar: &Grammar) -> Vec<(Class, usize, f64)> {
    let sound = hypothesis
        .words
        .iter()
        .filter(|(_, p)| (0.0..=1.0).contains(p));
    let all = sound.flat_map(|(word, p)| grammar.named(word).iter().map(|&(c, o)| (c, o, *p)));
    all.collect()
}

impl Token {
    /// How probable the token is for each option of a class.
    pub fn evidence(&self, class: Class, options: usize) -> Vec<f64> {
        if self.covered {
            return vec![COVERED; options];
        }
        spread(&self.words, class, options)
    }
}

impl Shown {
    /// How probable the gesture is for each option of a class.
    pub fn evidence(&self, class: Class, options: usize) -> Vec<f64> {
        spread(&self.options, class, options)
    }
}

fn spread(named: &[(Class, usize, f64)], class: Class, options: usize) -> Vec<f64> {
    let mut out = vec![UNNAMED; options];
    for (_, option, p) in named.iter().filter(|(c, ..)| *c == class) {
        if let Some(place) = out.get_mut(*option) {
            *place = place.max(*p);
        }
    }
    out
}
