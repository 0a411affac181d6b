//! The figures behind a decision as text: a line per category, or a table.

use std::fmt;

use deictic_core::category::Category;

use super::{Choice, Penalty, Reasons, Whole, Word};

/// So many options of a category are told in a line.
const TOLD: usize = 4;

/// An option with less than this is not told in a line.
const COUNTS: f32 = 0.05;

/// An option with less than this, which would be printed as 0.000, is left out of the table.
const SHOWN: f32 = 5e-4;

impl Reasons {
    /// The reasons in a line per category: the options that count, those that are clear with a star,
    /// actions with what was heard of them and what alpha and beta left of it. Of the joint model every
    /// option's share of the posterior, after a line on the whole intent.
    #[must_use]
    pub fn brief(&self) -> Vec<String> {
        let whole = self.whole.iter().map(ToString::to_string);
        let words = self.words.iter().filter_map(|word| {
            let mut options: Vec<_> = word.options.iter().enumerate().collect();
            options.retain(|(i, o)| o.clear || self.weight(word, *i, o) >= COUNTS);
            options.sort_by(|a, b| {
                self.weight(word, b.0, b.1)
                    .total_cmp(&self.weight(word, a.0, a.1))
            });
            let told = options.into_iter().take(TOLD).map(|(i, o)| {
                let star = if o.clear { "*" } else { "" };
                match self.penalty(word, i).filter(|_| self.whole.is_none()) {
                    Some(p) => format!(
                        "{} {:.2} x alpha {:.2} x beta {:.2} = {:.2}{star}",
                        o.name, p.heard, p.alpha, p.beta, o.merged
                    ),
                    None => format!("{} {:.2}{star}", o.name, o.merged),
                }
            });
            let told: Vec<_> = told.collect();
            (!told.is_empty()).then(|| format!("{}: {}", word.category, told.join(", ")))
        });
        whole.chain(words).collect()
    }

    /// How much an option has to do with the decision: what was heard of it, or what came of it.
    fn weight(&self, word: &Word, at: usize, option: &Choice) -> f32 {
        let heard = self.penalty(word, at).map_or(0.0, |p| p.heard);
        heard.max(option.merged)
    }

    fn penalty(&self, word: &Word, at: usize) -> Option<&Penalty> {
        self.actions.get(at).filter(|_| word.of == Category::ACTION)
    }
}

impl fmt::Display for Whole {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            posterior,
            confidence,
            cut,
        } = self;
        write!(
            f,
            "whole intent: posterior {posterior:.3}, confidence {confidence:.3}"
        )?;
        match cut {
            None => write!(f, ", no cut"),
            Some(cut) => write!(f, ", cut {cut:.3}"),
        }
    }
}

/// The reasons as a table, a line per option, those without weight left out.
impl fmt::Display for Reasons {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(whole) = &self.whole {
            writeln!(f, "{whole}")?;
        }
        for word in &self.words {
            let (name, present) = (&word.category, word.present);
            match self.whole {
                Some(_) => writeln!(f, "{name} (present {present:.2})")?,
                None => writeln!(
                    f,
                    "{name} (present {present:.2}, entropy {:.3}, threshold {:.3})",
                    word.entropy, word.threshold
                )?,
            }
            let mut lines: Vec<_> = word.options.iter().enumerate().collect();
            lines.sort_by(|a, b| b.1.merged.total_cmp(&a.1.merged));
            for (i, option) in lines {
                if !option.clear && self.weight(word, i, option) < SHOWN {
                    continue;
                }
                self.row(f, word, i, option)?;
            }
        }
        Ok(())
    }
}

impl Reasons {
    fn row(
        &self,
        f: &mut fmt::Formatter<'_>,
        word: &Word,
        at: usize,
        option: &Choice,
    ) -> fmt::Result {
        let mark = if option.clear { "clear" } else { "" };
        let mut row = format!("  {:<12} {:>6.3}", option.name, option.merged);
        let penalty = self.penalty(word, at);
        match self.whole {
            Some(_) => {
                row += &format!("  {mark:<5}");
                if let Some(p) = penalty {
                    row += &format!("  presence {:.3}  things {:.3}", p.alpha, p.beta);
                }
            }
            None => {
                row += &format!("  h {:>6.3}  {mark:<5}", option.h);
                if let Some(Penalty {
                    heard, alpha, beta, ..
                }) = penalty
                {
                    row += &format!("  heard {heard:>6.3}  alpha {alpha:.3}  beta {beta:.3}");
                }
            }
        }
        writeln!(f, "{}", row.trim_end())
    }
}
