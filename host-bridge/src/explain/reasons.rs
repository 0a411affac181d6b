//! The figures behind a decision, whether it was made here or on the unit.

use deictic_core::category::Category;
use deictic_core::large;
use deictic_core::protocol::message::{Why, WhyActions};
use serde::Serialize;

use crate::vocabulary::Lexicon;

/// Why a decision came out as it did.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Reasons {
    /// What was merged, a word per category that was expressed, actions first.
    pub words: Vec<Word>,
    /// What penalties made of the actions; as many as the vocabulary has.
    pub actions: Vec<Penalty>,
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
    /// Its merged likelihood; of an action after alpha and beta.
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
    /// Its merged likelihood before any penalty.
    pub heard: f32,
    /// alpha: what the signature left of it (eq. 7).
    pub alpha: f32,
    /// beta: what the things there left of it (eq. 10).
    pub beta: f32,
}

impl Reasons {
    /// The reasons of a decision made here.
    #[must_use]
    pub fn of_trace(trace: &large::Trace, lexicon: &Lexicon) -> Self {
        let mut reasons = Self::default();
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

    /// The reasons in a line per category: the options that count, those that are clear with a star,
    /// actions with what was heard of them and what alpha and beta left of it.
    #[must_use]
    pub fn brief(&self) -> Vec<String> {
        let lines = self.words.iter().map(|word| {
            let mut options: Vec<_> = word.options.iter().enumerate().collect();
            let penalty = |i: usize| self.actions.get(i).filter(|_| word.of == Category::ACTION);
            let weight = |i: usize, o: &Choice| penalty(i).map_or(o.merged, |p| p.heard);
            options.sort_by(|a, b| weight(b.0, b.1).total_cmp(&weight(a.0, a.1)));
            let counting = options
                .into_iter()
                .filter(|(i, o)| weight(*i, o) >= 0.05 || o.merged >= 0.05);
            let told = counting.take(4).map(|(i, o)| {
                let star = if o.clear { "*" } else { "" };
                match penalty(i) {
                    Some(p) => format!(
                        "{} {:.2} x alpha {:.2} x beta {:.2} = {:.2}{star}",
                        o.name, p.heard, p.alpha, p.beta, o.merged
                    ),
                    None => format!("{} {:.2}{star}", o.name, o.merged),
                }
            });
            format!("{}: {}", word.category, told.collect::<Vec<_>>().join(", "))
        });
        lines.collect()
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

/// The reasons as a table, a line per option, those without weight left out.
impl std::fmt::Display for Reasons {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for word in &self.words {
            writeln!(
                f,
                "{} (present {:.2}, entropy {:.3}, threshold {:.3})",
                word.category, word.present, word.entropy, word.threshold
            )?;
            let mut lines: Vec<_> = word.options.iter().enumerate().collect();
            lines.sort_by(|a, b| b.1.merged.total_cmp(&a.1.merged));
            for (i, option) in lines {
                let penalty = self.actions.get(i).filter(|_| word.of == Category::ACTION);
                if option.merged < 5e-4 && penalty.is_none_or(|p| p.heard < 5e-4) {
                    continue;
                }
                let mark = if option.clear { "clear" } else { "" };
                write!(
                    f,
                    "  {:<12} {:>6.3}  h {:>6.3}  {mark:<5}",
                    option.name, option.merged, option.h
                )?;
                if let Some(p) = penalty {
                    write!(
                        f,
                        "  heard {:>6.3}  alpha {:.3}  beta {:.3}",
                        p.heard, p.alpha, p.beta
                    )?;
                }
                writeln!(f)?;
            }
        }
        Ok(())
    }
}
