//! `deictic-eval align`

use clap::ValueEnum;
use deictic_core::profile::{Align as Rule, Profile};
use deictic_eval::disturb::Disturbance;
use deictic_eval::order::Order;
use deictic_eval::score::Tally;
use deictic_eval::variant::{AlignName, ModelName, ProfileName, Variant};
use serde::Serialize;

use super::made::Made;

/// How often words that are out of step are understood, aligned by category and by position, by the
/// joint model and by M3.
///
/// The words of every sample are shuffled, dropped, said twice, corrected, or of a category that is
/// not sure, in each modality on its own. Figures are means over the sets of a noise level.
#[derive(clap::Args)]
pub struct Align {
    #[command(flatten)]
    made: Made,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What a level comes to, in percent of all commands.
#[derive(Clone, Debug, Serialize)]
struct Figures {
    words: Disturbance,
    model: String,
    align: String,
    level: usize,
    /// Whether these are the fairer sets, D_free, or the paper's kinds.
    free: bool,
    n: usize,
    /// The likeliest intent is what was meant.
    argmax: f64,
    /// What was executed is.
    executed: f64,
    /// It is not.
    wrong: f64,
}

impl Align {
    pub fn run(self) -> anyhow::Result<()> {
        let (catalogue, sets) = self.made.sets()?;
        let order = Order::own(&catalogue);
        let mut all: Vec<Figures> = Vec::new();
        for &words in Disturbance::value_variants() {
            let mut tallies = Vec::new();
            for made in &sets {
                let maker = made.0;
                let field = self.made.field(made, &catalogue, &order, |record, rng| {
                    words
                        .sentences(&catalogue, &order, maker, record, rng)
                        .map_err(|e| anyhow::anyhow!("the core refuses a word: {e:?}"))
                })?;
                let key = (maker.is_free(), maker.level().number());
                for (model, align) in cases() {
                    let variant = Variant::new(model, None, None, ProfileName::Paper);
                    let profile = Profile {
                        align: Rule::from(align),
                        ..variant.settings()
                    };
                    tallies.push((key, model, align, field.decide(&profile)?));
                }
            }
            all.extend(figures(words, &tallies));
        }
        if self.json {
            return super::print_json(&all);
        }
        println!("words      sets     model  aligned by  argmax  executed right   wrong");
        for f in &all {
            println!(
                "{:<10} {:<8} {:<6} {:<10} {:>7.2} {:>15.2} {:>7.2}",
                f.words
                    .to_possible_value()
                    .map_or_else(String::new, |v| v.get_name().to_owned()),
                format!("{}n{}", if f.free { "free " } else { "" }, f.level),
                f.model,
                f.align,
                f.argmax,
                f.executed,
                f.wrong
            );
        }
        Ok(())
    }
}

fn cases() -> impl Iterator<Item = (ModelName, AlignName)> {
    let rules = [AlignName::Category, AlignName::Position];
    [ModelName::Joint, ModelName::M3]
        .into_iter()
        .flat_map(move |model| rules.map(|rule| (model, rule)))
}

type Key = (bool, usize);

fn figures(words: Disturbance, tallies: &[(Key, ModelName, AlignName, Tally)]) -> Vec<Figures> {
    let mut keys: Vec<Key> = tallies.iter().map(|(key, ..)| *key).collect();
    keys.sort_unstable();
    keys.dedup();
    let mut all = Vec::new();
    for (model, align) in cases() {
        for &(free, level) in &keys {
            let of = tallies
                .iter()
                .filter(|(key, m, a, _)| (*key, *m, *a) == ((free, level), model, align));
            let of: Vec<Tally> = of.map(|(.., tally)| *tally).collect();
            let mean = |count: fn(&Tally) -> usize| {
                of.iter().map(|t| t.percent(count(t))).sum::<f64>() / of.len().max(1) as f64
            };
            all.push(Figures {
                words,
                model: model.to_string(),
                align: align.to_string(),
                level,
                free,
                n: of.iter().map(|t| t.n).sum(),
                argmax: mean(|t| t.triple_argmax),
                executed: mean(|t| t.triple_decided),
                wrong: mean(|t| t.triple_wrong_executed),
            });
        }
    }
    all
}
