//! What a recogniser heard: several texts, each with a probability, mixed into one utterance whose
//! words are as uncertain as the hearing was.
//!
//! Any recogniser can be plugged in that writes one line per utterance: a plain text, or JSON as Vosk
//! gives it, `{"alternatives": [{"text": "pick the cup", "confidence": 0.8}]}` or `{"text": ...}`.

use deictic_core::category::Category;
use deictic_core::large::{OPTIONS, Sentence, Word};
use deictic_core::math::argmax;
use deictic_core::sentence::{ABSENT_BELOW, LANGUAGE};
use serde::Deserialize;

use super::error::LanguageError;
use super::{Command, Listener, Uncertainty, Utterance};

/// What was heard of one utterance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spoken {
    /// The texts with their probabilities, 0..=1, summing to 1. An empty one stands for whatever may
    /// have been said that is no command.
    pub alternatives: Vec<(String, f64)>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Line {
    Many { alternatives: Vec<Alternative> },
    One(Alternative),
}

#[derive(Deserialize)]
struct Alternative {
    text: String,
    confidence: Option<f64>,
}

impl Spoken {
    /// Reads a recogniser's line. Confidences between 0 and 1 are probabilities, others logarithms.
    ///
    /// # Errors
    /// [`LanguageError::Empty`] for a line that says nothing.
    pub fn read(line: &str) -> Result<Self, LanguageError> {
        let heard = match serde_json::from_str(line) {
            Ok(Line::Many { alternatives }) => alternatives,
            Ok(Line::One(alternative)) => vec![alternative],
            Err(_) => vec![Alternative {
                text: line.to_owned(),
                confidence: None,
            }],
        };
        let figure = |a: &Alternative| a.confidence.filter(|c| c.is_finite()).unwrap_or(1.0);
        let shares = heard.iter().all(|a| (0.0..=1.0).contains(&figure(a)));
        let heard = heard.iter().filter(|a| !a.text.trim().is_empty());
        let figures = heard.map(|a| (a.text.clone(), figure(a)));
        if shares {
            Self::of_shares(figures.collect())
        } else {
            Self::of_scores(figures.collect(), 1.0)
        }
    }

    /// Texts with scores whose difference, divided by `scale`, is the logarithm of how much more
    /// probable one is.
    ///
    /// # Errors
    /// [`LanguageError::Empty`] without any text.
    pub fn of_scores(scores: Vec<(String, f64)>, scale: f64) -> Result<Self, LanguageError> {
        let top = scores.iter().map(|s| s.1).fold(f64::NEG_INFINITY, f64::max);
        let share = |(text, score)| (text, f64::exp((score - top) / scale));
        Self::of_shares(scores.into_iter().map(share).collect())
    }

    /// The likeliest text.
    #[must_use]
    pub fn best(&self) -> &str {
        self.alternatives.first().map_or("", |a| a.0.as_str())
    }

    /// The likeliest text, if all others together are no likelier than `risk`.
    #[must_use]
    pub fn certain(&self, risk: f64) -> Option<&str> {
        let best = self.alternatives.first()?;
        let clear = best.1 >= 1.0 - risk && !best.0.is_empty();
        clear.then_some(best.0.as_str())
    }

    fn of_shares(mut alternatives: Vec<(String, f64)>) -> Result<Self, LanguageError> {
        let sum: f64 = alternatives.iter().map(|a| a.1).sum();
        if alternatives.is_empty() || sum <= 0.0 {
            return Err(LanguageError::Empty);
        }
        alternatives.iter_mut().for_each(|a| a.1 /= sum);
        alternatives.sort_by(|a, b| b.1.total_cmp(&a.1));
        Ok(Self { alternatives })
    }
}

impl Listener<'_> {
    /// Understands what was heard. Whatever has a probability above [`Listener::risk`] stays in
    /// question: options that do are equally likely, for the hand, the scene or the person to choose
    /// from; [`Uncertainty::Likelihood`]s stay as they are. What may have been no command at all is to
    /// be said again.
    ///
    /// # Errors
    /// As [`Listener::understand`] when no alternative is understood, and
    /// [`LanguageError::Unclear`] when too many are no commands, [`LanguageError::OtherCommand`] when too
    /// many are fewer or more commands, or tell other quantities.
    pub fn hear(&self, spoken: &Spoken) -> Result<Utterance, LanguageError> {
        let mut heard: Vec<(Utterance, f64)> = Vec::new();
        let mut error = LanguageError::Empty;
        for (text, share) in spoken.alternatives.iter().rev() {
            let understood = match text.is_empty() {
                // Something was said that is no command.
                true => Ok(Utterance::default()),
                false => self.understand(text),
            };
            match understood {
                // Wordings of one meaning are one alternative, as probable as the best of them.
                Ok(utterance) => match heard.iter_mut().find(|(u, _)| same(u, &utterance)) {
                    Some(known) => known.1 = known.1.max(*share),
                    None => heard.push((utterance, *share)),
                },
                Err(e) => error = e,
            }
        }
        heard.sort_by(|a, b| b.1.total_cmp(&a.1));
        let Some((best, _)) = heard.first() else {
            return Err(error);
        };
        let all: f64 = heard.iter().map(|h| h.1).sum();
        let idle: f64 = heard
            .iter()
            .filter(|(u, _)| u.commands.is_empty())
            .map(|h| h.1)
            .sum();
        if best.commands.is_empty() {
            return Ok(best.clone());
        }
        // Stopping harms nobody, so it needs no such caution.
        if idle > self.risk * all && !self.is_stop(best) {
            let mut texts = spoken.alternatives.iter().map(|a| &a.0);
            let text = texts.find(|t| !t.is_empty()).cloned().unwrap_or_default();
            return Err(LanguageError::Unclear { text });
        }
        let count = best.commands.len();
        let (alike, unlike): (Vec<_>, Vec<_>) =
            heard.iter().partition(|(u, _)| u.commands.len() == count);
        // The hand and the scene tell neither how many commands were meant nor how far.
        let quantities = |u: &Utterance| -> Vec<_> {
            let words = u.commands.iter().flat_map(|c| c.sentence.words());
            words.filter_map(Word::quantity).collect()
        };
        let (meant, far) = (actions(best), quantities(best));
        let otherwise = alike
            .iter()
            .filter(|(u, _)| actions(u) == meant && quantities(u) != far);
        let otherwise = unlike
            .iter()
            .filter(|(u, _)| !u.commands.is_empty())
            .chain(otherwise);
        if otherwise.map(|(_, share)| share).sum::<f64>() > self.risk * all && !self.is_stop(best) {
            let text = spoken.best().to_owned();
            return Err(LanguageError::OtherCommand { text });
        }
        // Where figures are taken for the likelihoods that they are, they stay as they are.
        let alike_above = match self.uncertainty {
            Uncertainty::Likelihood { .. } => f64::INFINITY,
            _ => self.risk,
        };
        let mut mixed = best.clone();
        for (i, command) in mixed.commands.iter_mut().enumerate() {
            let at = alike
                .iter()
                .filter_map(|(u, share)| Some((u.commands.get(i)?, *share)));
            command.sentence = mix(&at.collect::<Vec<_>>(), alike_above)?;
        }
        Ok(mixed)
    }
}

impl Listener<'_> {
    fn is_stop(&self, utterance: &Utterance) -> bool {
        let stop = self.lexicon.vocabulary().stop();
        let first = utterance.commands.first();
        stop.is_some() && first.and_then(|c| c.best(Category::ACTION)) == stop
    }
}

/// The likeliest action of every command.
fn actions(utterance: &Utterance) -> Vec<Option<u8>> {
    let commands = utterance.commands.iter();
    commands.map(|c| c.best(Category::ACTION)).collect()
}

/// Whether two utterances mean the same, however sure they are.
fn same(a: &Utterance, b: &Utterance) -> bool {
    let named = |c: &Command| {
        let words = c.sentence.words().iter().filter_map(|w| w.category());
        let named = words.map(|k| (k, c.best(k), c.quantity(k).map(f32::to_bits)));
        (c.pointed.clone(), named.collect::<Vec<_>>())
    };
    a.commands
        .iter()
        .map(named)
        .eq(b.commands.iter().map(named))
}

/// One sentence of several: every word's likelihoods and category probabilities by the shares of the
/// sentences that have it. The options that are named with more than `alike_above` all become as likely
/// as can be.
fn mix(sentences: &[(&Command, f64)], alike_above: f64) -> Result<Sentence, LanguageError> {
    if let [(only, _)] = sentences {
        return Ok(only.sentence.clone());
    }
    let all: f64 = sentences.iter().map(|s| s.1).sum();
    let mut mixed = Sentence::new(LANGUAGE);
    for category in (0..Category::LIMIT).filter_map(Category::from_index) {
        let mut likelihoods = [0.0_f64; OPTIONS];
        let mut categories = [0.0_f64; Category::LIMIT];
        let mut named = [0.0_f64; OPTIONS];
        let (mut options, mut used, mut share, mut quantity) = (0, 0, 0.0, None);
        for (command, p) in sentences {
            let mut words = command.sentence.words().iter();
            let Some(word) = words.rfind(|w| w.category() == Some(category)) else {
                continue;
            };
            share += p;
            options = word.likelihoods().len();
            used = used.max(word.categories().len());
            quantity = quantity.or(word.quantity());
            let best = argmax(word.likelihoods()).and_then(|best| named.get_mut(best));
            best.into_iter().for_each(|sum| *sum += p);
            let into = likelihoods.iter_mut().zip(word.likelihoods());
            into.for_each(|(sum, l)| *sum += p * f64::from(*l));
            let into = categories.iter_mut().zip(word.categories());
            into.for_each(|(sum, c)| *sum += p * f64::from(*c));
        }
        // A word that hardly anybody would have heard is none.
        if share < f64::from(ABSENT_BELOW) * all {
            continue;
        }
        let mut likelihoods = likelihoods.map(|l| (l / share).min(1.0) as f32);
        let doubtful = likelihoods.iter_mut().zip(named);
        let doubtful = doubtful.filter(|(_, named)| *named > alike_above * share);
        doubtful.for_each(|(likelihood, _)| *likelihood = 1.0);
        let categories = categories.map(|c| (c / all).min(1.0) as f32);
        let word = Word::new(
            categories.get(..used).unwrap_or_default(),
            likelihoods.get(..options).unwrap_or_default(),
        )?;
        mixed.push(match quantity {
            Some(quantity) => word.with_quantity(quantity),
            None => word,
        })?;
    }
    Ok(mixed)
}
