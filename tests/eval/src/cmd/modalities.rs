//! `deictic-eval modalities`

use deictic_eval::gaze;
use deictic_eval::interval::wilson;
use deictic_eval::order::Order;
use deictic_eval::situation::in_order;
use deictic_eval::variant::{ModelName, ProfileName, Variant};
use serde::Serialize;

use super::made::Made;

/// What a third modality is worth: where the person looks, beside hand and voice, for the joint model
/// and for M3.
///
/// A look names the object and the storage, through noise of the set's level. Thresholds and cuts are
/// those for two modalities.
#[derive(clap::Args)]
pub struct Modalities {
    #[command(flatten)]
    made: Made,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What a set comes to, in percent of all commands.
#[derive(Clone, Debug, Serialize)]
struct Figures {
    set: String,
    model: String,
    modalities: usize,
    n: usize,
    /// The likeliest intent is what was meant.
    argmax: f64,
    /// What was executed is.
    executed: f64,
    /// It is not.
    wrong: f64,
    wrong_interval_95: [f64; 2],
}

impl Modalities {
    pub fn run(self) -> anyhow::Result<()> {
        let (catalogue, sets) = self.made.sets()?;
        let order = Order::own(&catalogue);
        let mut all = Vec::new();
        for made in &sets {
            let (maker, set) = made;
            for modalities in [2, 3] {
                let field = self.made.field(made, &catalogue, &order, |record, rng| {
                    let mut observed = record.words.to_vec();
                    if modalities > 2 {
                        observed.push(gaze::words(&catalogue, *maker, record, rng));
                    }
                    observed
                        .iter()
                        .map(|words| in_order(words, &order))
                        .collect()
                })?;
                for model in [ModelName::Joint, ModelName::M3] {
                    let variant = Variant::new(model, None, None, ProfileName::Paper);
                    let t = field.tally(&variant)?;
                    all.push(Figures {
                        set: set.name.clone(),
                        model: model.to_string(),
                        modalities,
                        n: t.n,
                        argmax: t.percent(t.triple_argmax),
                        executed: t.percent(t.triple_decided),
                        wrong: t.percent(t.triple_wrong_executed),
                        wrong_interval_95: wilson(t.triple_wrong_executed, t.n),
                    });
                }
            }
        }
        if self.json {
            return super::print_json(&all);
        }
        println!("set          model  modalities  argmax  executed right   wrong");
        for f in &all {
            println!(
                "{:<12} {:<6} {:>10} {:>7.2} {:>15.2} {:>7.2}",
                f.set, f.model, f.modalities, f.argmax, f.executed, f.wrong
            );
        }
        Ok(())
    }
}

const _: () = assert!(gaze::GAZE == 2, "looks come third, behind hand and voice");
