//! The most probable sentence of two streams, or what has to be asked.

use super::Streams;
use super::align::{Alignment, align};
use super::evidence::{COVERED, Shown, Token, shown, tokens};
use super::grammar::{Class, Grammar, Signature};

/// A gesture belongs to a word at about its time: e times less probable per second between them.
const PER_SECOND: f64 = 1.0;
/// Beyond this many seconds it makes no difference, since people point long before and after.
const FARTHEST: f64 = 1.5;
/// ln of the cost of a gesture that belongs to nothing.
const IDLE: f64 = -5.0;
/// ln of the cost of each pair of parts that are out of the usual order.
const SWAP: f64 = -4.0;
/// An option is clear when it is so many times as probable as the next.
const CLEAR: f64 = 2.0;
/// A sentence is clear when ln of its probability leads all others by this.
const LEAD: f64 = 1.0;
/// ln of the cost of one thing as object and storage.
const SAME: f64 = -8.0;

/// One part of a sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// What it is.
    pub class: Class,
    /// Which of its options; `None` when that stays open.
    pub option: Option<usize>,
}

/// What stays open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Open {
    /// Which part.
    pub class: Class,
    /// The options that come into question, the most probable first, at most [`Open::CANDIDATES`].
    pub candidates: Vec<usize>,
}

impl Open {
    /// As many as a person can be asked about.
    pub const CANDIDATES: usize = 5;
}

/// What follows from the streams.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// A sentence, to be done.
    Sentence,
    /// A question.
    Ask(Open),
    /// Nothing was said or shown.
    Repeat,
}

/// The most probable sentence.
#[derive(Clone, Debug, PartialEq)]
pub struct Fused {
    /// Its parts, in the grammar's usual order.
    pub parts: Vec<Part>,
    /// What follows.
    pub outcome: Outcome,
    /// ln of how much more probable it is than the next different one; infinite without any.
    pub lead: f64,
}

struct Reading {
    score: f64,
    slots: Vec<(Class, Vec<f64>)>,
}

impl Grammar {
    /// The most probable sentence of these streams.
    ///
    /// About 200 alignments of five words each: some 100 microseconds.
    #[must_use]
    pub fn fuse(&self, streams: &Streams) -> Fused {
        let voice = tokens(streams, self);
        let shown = shown(streams, self);
        let mut readings = Vec::new();
        if !(voice.is_empty() && shown.is_empty()) {
            let mut seen: Vec<&Signature> = Vec::new();
            for signature in &self.words().signatures {
                if !seen.contains(&signature) {
                    seen.push(signature);
                    self.read(signature, &voice, &shown, &mut readings);
                }
            }
        }
        readings.sort_by(|a: &Reading, b| b.score.total_cmp(&a.score));
        let Some(best) = readings.first() else {
            return Fused {
                parts: Vec::new(),
                outcome: Outcome::Repeat,
                lead: f64::INFINITY,
            };
        };
        let parts = parts(best);
        let rival = readings.iter().find(|r| self::parts(r) != parts);
        let lead = rival.map_or(f64::INFINITY, |r| best.score - r.score);
        let open = parts.iter().find(|p| p.option.is_none()).map(|p| p.class);
        let contested = || {
            rival
                .filter(|_| lead < LEAD)
                .and_then(|r| difference(best, r))
        };
        let outcome = match open.or_else(contested) {
            Some(class) => Outcome::Ask(self.open(class, &readings)),
            None => Outcome::Sentence,
        };
        Fused {
            parts,
            outcome,
            lead,
        }
    }

    /// All readings with one signature: every order, and every gesture in every slot.
    fn read(
        &self,
        signature: &Signature,
        voice: &[Token],
        shown: &[Shown],
        readings: &mut Vec<Reading>,
    ) {
        let takes = |i: usize| self.words().signatures.get(i) == Some(signature);
        for (slots, swaps) in self.shapes(signature) {
            for holders in assignments(&slots, shown) {
                let idle = holders.iter().filter(|h| h.is_none()).count();
                let gesture = |slot: usize| {
                    let at = holders.iter().position(|h| *h == Some(slot))?;
                    shown.get(at)
                };
                let evidence = |slot: usize, token: Option<usize>| {
                    let class = slots.get(slot).copied().unwrap_or(Class::Action);
                    let mut all = vec![1.0; self.options(class)];
                    let word = token.and_then(|t| voice.get(t));
                    let word = word.map(|w| w.evidence(class, all.len()));
                    let sign = gesture(slot).map(|g| g.evidence(class, all.len()));
                    for source in [word, sign].into_iter().flatten() {
                        all.iter_mut().zip(source).for_each(|(p, e)| *p *= e);
                    }
                    if class == Class::Action {
                        let others = all.iter_mut().enumerate().filter(|(i, _)| !takes(*i));
                        others.for_each(|(_, p)| *p = 0.0);
                    }
                    all
                };
                let fit = |slot: usize, token: Option<usize>| {
                    let top = evidence(slot, token).into_iter().fold(0.0, f64::max);
                    let apart = match (token.and_then(|t| voice.get(t)), gesture(slot)) {
                        (Some(word), Some(sign)) => (word.time - sign.time).abs(),
                        (None, Some(_)) => FARTHEST,
                        _ => 0.0,
                    };
                    top.max(1e-9).ln() - apart.min(FARTHEST) * PER_SECOND
                };
                let Alignment { score, tokens } = align(slots.len(), voice.len(), fit);
                let mut known: Vec<_> = slots
                    .iter()
                    .enumerate()
                    .filter(|(_, class)| **class != Class::Preposition)
                    .map(|(s, class)| (*class, evidence(s, tokens.get(s).copied().flatten())))
                    .collect();
                known.sort_by_key(|(class, _)| order(*class));
                let score = score + SWAP * swaps as f64 + IDLE * idle as f64 + self.doubled(&known);
                readings.push(Reading {
                    score,
                    slots: known,
                });
            }
        }
    }

    /// The cost of one thing in two places.
    fn doubled(&self, slots: &[(Class, Vec<f64>)]) -> f64 {
        let name = |wanted: Class| {
            let slot = slots.iter().find(|(class, _)| *class == wanted)?;
            self.names(wanted).get(clear(&slot.1)?)
        };
        match (name(Class::Object), name(Class::Storage)) {
            (Some(a), Some(b)) if a == b => SAME,
            _ => 0.0,
        }
    }

    fn open(&self, class: Class, readings: &[Reading]) -> Open {
        let options = self.options(class);
        let mut best = vec![f64::NEG_INFINITY; options];
        for reading in readings {
            let slots = reading.slots.iter().filter(|(c, _)| *c == class);
            for (_, evidence) in slots {
                let top = evidence.iter().copied().fold(1e-9, f64::max);
                for (place, p) in best.iter_mut().zip(evidence) {
                    *place = place.max(reading.score + (p.max(1e-9) / top).ln());
                }
            }
        }
        let mut candidates: Vec<_> = (0..options).collect();
        candidates.sort_by(|&a, &b| best[b].total_cmp(&best[a]));
        let top = candidates.first().map_or(0.0, |&c| best[c]);
        candidates.retain(|&c| best[c] > top - 3.0);
        candidates.truncate(Open::CANDIDATES);
        Open { class, candidates }
    }
}

/// Every way to give each gesture a slot of its kind, or none, no slot twice.
fn assignments(slots: &[Class], shown: &[Shown]) -> Vec<Vec<Option<usize>>> {
    let mut all = vec![Vec::new()];
    for sign in shown {
        let fits = |class: &Class| match class {
            Class::Action => sign.is_action,
            Class::Object | Class::Storage => !sign.is_action,
            _ => false,
        };
        let places: Vec<_> = (0..slots.len())
            .filter(|&s| slots.get(s).is_some_and(fits))
            .collect();
        let longer = all.iter().flat_map(|done: &Vec<Option<usize>>| {
            let free = places
                .iter()
                .filter(|p| !done.contains(&Some(**p)))
                .map(|&p| Some(p));
            free.chain([None]).map(|place| {
                let mut next = done.clone();
                next.push(place);
                next
            })
        });
        all = longer.take(MOST).collect();
    }
    all
}

/// A hand that never rests must not cost more than time allows: two pointings have 7 ways.
const MOST: usize = 64;

fn order(class: Class) -> usize {
    match class {
        Class::Further(place) => place,
        Class::Action => usize::MAX - 3,
        Class::Object => usize::MAX - 2,
        Class::Preposition | Class::Storage => usize::MAX - 1,
    }
}

/// The option that leads clearly and was not merely left over by a hesitation.
fn clear(evidence: &[f64]) -> Option<usize> {
    let mut order: Vec<_> = (0..evidence.len()).collect();
    order.sort_by(|&a, &b| evidence[b].total_cmp(&evidence[a]));
    let top = *order.first()?;
    let next = order.get(1).map_or(0.0, |&o| evidence[o]);
    let known = evidence.len() > 1 || evidence[top] != COVERED;
    (known && evidence[top] >= CLEAR * next).then_some(top)
}

fn parts(reading: &Reading) -> Vec<Part> {
    let part = |(class, evidence): &(Class, Vec<f64>)| Part {
        class: *class,
        option: clear(evidence),
    };
    reading.slots.iter().map(part).collect()
}

/// The first part in which two readings differ.
fn difference(a: &Reading, b: &Reading) -> Option<Class> {
    let (a, b) = (parts(a), parts(b));
    let missing = a
        .iter()
        .find(|p| !b.contains(p))
        .or_else(|| b.iter().find(|p| !a.contains(p)));
    missing.map(|p| p.class)
}
