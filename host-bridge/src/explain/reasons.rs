//! The figures behind a decision, whether it was made here or on the unit.

mod told;

use deictic_core::category::Category;
use deictic_core::joint::belief::Look;
use deictic_core::large;
use deictic_core::math;
use deictic_core::profile::{Model, Profile, Threshold};
use deictic_core::protocol::message::{Why, WhyActions, WhyWhole};
use serde::Serialize;

use crate::vocabulary::Lexicon;

/// Why a decision came out as it did.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Reasons {
    /// What was merged, a word per category that was expressed, actions first.
    pub words: Vec<Word>,
    /// What penalties made of the actions; as many as the vocabulary has.
    pub actions: Vec<Penalty>,
    /// How far the likeliest whole intent is believed; of the joint model alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub whole: Option<Whole>,
}

/// How far the joint model believes its likeliest intent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Whole {
    /// Its share of the posterior over all intents, 0..=1.
    pub posterior: f32,
    /// The calibrated probability that it is what was meant, 0..=1.
    pub confidence: f32,
    /// From which confidence on it is executed, 0..=1; `None` when it is executed however sure.
    pub cut: Option<f32>,
}

impl Whole {
    /// From logits, as the core has them.
    fn new(posterior: f32, confidence: f32, cut: Option<f32>) -> Self {
        let share = |logit: f32| 1.0 / (1.0 + math::exp(-logit));
        Self {
            posterior,
            confidence: share(confidence),
            cut: cut.map(share),
        }
    }
}

/// One category's merged word.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Word {
    /// Its category, by index.
    #[serde(skip)]
    pub of: Category,
    /// Its category's name.
    pub category: String,
    /// Probability that the category is in the merged sentence.
    pub present: f32,
    /// The normalised entropy of the word.
    pub entropy: f32,
    /// Against what clarity was judged: t_E on `h`, or t_C on `merged`.
    pub threshold: f32,
    /// Its options, in the vocabulary's order.
    pub options: Vec<Choice>,
}

/// One option of a merged word.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Choice {
    /// Its name.
    pub name: String,
    /// Its merged likelihood; of an action after alpha and beta. Of the joint model its share of the
    /// posterior.
    pub merged: f32,
    /// Its diagonal cross-entropy.
    pub h: f32,
    /// Whether it is clear.
    pub clear: bool,
}

/// What penalties made of an action.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Penalty {
    /// Its name.
    pub name: String,
    /// Its merged likelihood before any penalty; 0 of the joint model, which merges nothing.
    pub heard: f32,
    /// alpha: what the signature left of it (eq. 7).
    pub alpha: f32,
    /// beta: what the things there left of it (eq. 10).
    pub beta: f32,
}

impl Reasons {
    /// The reasons of a decision made here by `profile`, before any question.
    #[must_use]
    pub fn of_trace(trace: &large::Trace, profile: &Profile, lexicon: &Lexicon) -> Self {
        let mut reasons = Self::default();
        if profile.model == Model::Joint {
            let belief = &trace.belief;
            let look = Look::of(profile.questions, profile.questions);
            let cut = match profile.threshold {
                Threshold::Risk { rate } => Some(belief.cut(rate, look)),
                _ => None,
            };
            reasons.whole = Some(Whole::new(belief.posterior, belief.logit(), cut));
        }
        let actions = lexicon.vocabulary().actions().len();
        let figures = trace.heard.iter().zip(&trace.alpha).zip(&trace.beta);
        reasons.penalties(
            figures.take(actions).map(|((h, a), b)| (*h, *a, *b)),
            lexicon,
        );
        for (q, word) in trace.categories().iter().enumerate() {
            let Some(of) = Category::from_index(q).filter(|_| word.present > 0.0) else {
                continue;
            };
            reasons.words.push(Word {
                of,
                category: lexicon.category_name(of),
                present: word.present,
                entropy: word.entropy,
                threshold: word.threshold,
                options: choices(lexicon, of, word.merged(), word.h(), word.judgement.clear),
            });
        }
        reasons
    }

    /// Takes the unit's account of one category.
    pub fn add(&mut self, why: &Why<{ large::OPTIONS }>, lexicon: &Lexicon) {
        self.words.push(Word {
            of: why.category,
            category: lexicon.category_name(why.category),
            present: why.present,
            entropy: why.entropy,
            threshold: why.threshold,
            options: choices(lexicon, why.category, &why.merged, &why.h, why.clear),
        });
    }

    /// Takes the unit's account of the actions' penalties.
    pub fn add_actions(&mut self, why: &WhyActions<{ large::OPTIONS }>, lexicon: &Lexicon) {
        let figures = why.heard.iter().zip(&why.alpha).zip(&why.beta);
        self.penalties(figures.map(|((h, a), b)| (*h, *a, *b)), lexicon);
    }

    /// Takes the unit's account of the whole intent.
    pub fn add_whole(&mut self, why: &WhyWhole) {
        self.whole = Some(Whole::new(why.posterior, why.confidence, why.cut));
    }

    fn penalties(&mut self, figures: impl Iterator<Item = (f32, f32, f32)>, lexicon: &Lexicon) {
        let names = lexicon.entries(Category::ACTION);
        self.actions = figures
            .zip(names)
            .map(|((heard, alpha, beta), entry)| Penalty {
                name: entry.name.clone(),
                heard,
                alpha,
                beta,
            })
            .collect();
    }
}

fn choices(
    lexicon: &Lexicon,
    category: Category,
    merged: &[f32],
    h: &[f32],
    clear: u64,
) -> Vec<Choice> {
    let figures = merged.iter().zip(h).zip(lexicon.entries(category));
    figures
        .enumerate()
        .map(|(i, ((&merged, &h), entry))| Choice {
            name: entry.name.clone(),
            merged,
            h,
            clear: clear >> i & 1 == 1,
        })
        .collect()
}
