//! The sets that a study runs on: those of a folder, or sets made here.

use std::path::PathBuf;

use deictic_core::board::Word;
use deictic_eval::catalogue::Catalogue;
use deictic_eval::dataset::{self, Set};
use deictic_eval::free;
use deictic_eval::generate::{self, Kind};
use deictic_eval::maker::Maker;
use deictic_eval::noise::Level;
use deictic_eval::order::Order;
use deictic_eval::record::Record;
use deictic_eval::score::Field;
use deictic_eval::variant::ProfileName;
use rand_chacha::ChaCha8Rng;

/// Which sets.
#[derive(clap::Args)]
pub struct Made {
    /// Folder with sets of the usual names (D_A_n0 ... D_free_n4) [default: sets made here]
    #[arg(long, value_name = "DIR")]
    sets: Option<PathBuf>,
    /// Samples per set where sets are made
    #[arg(long, default_value_t = 1000, value_parser = super::at_least_one)]
    samples: usize,
    /// Seed of sets made here, and of what else is drawn
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

impl Made {
    /// The sets with how they were made, by name.
    pub fn sets(&self) -> anyhow::Result<(Catalogue, Vec<(Maker, Set)>)> {
        let (catalogue, sets) = match &self.sets {
            Some(folder) => dataset::read_folder(folder)?,
            None => self.made(),
        };
        let known = |set: Set| match Maker::of(&set.name) {
            Some(maker) => Ok((maker, set)),
            None => anyhow::bail!("{}: it is not known how this set was made", set.name),
        };
        Ok((
            catalogue,
            sets.into_iter().map(known).collect::<anyhow::Result<_>>()?,
        ))
    }

    /// Translates one of the sets, each sample of which is observed in a way of its own
    /// ([`Field::observed`]).
    pub fn field<'a>(
        &self,
        (maker, set): &(Maker, Set),
        catalogue: &'a Catalogue,
        order: &Order,
        words: impl Fn(&Record, &mut ChaCha8Rng) -> anyhow::Result<Vec<Vec<Word>>>,
    ) -> anyhow::Result<Field<'a>> {
        let (habits, form) = (ProfileName::Paper, maker.form());
        Field::observed(set, catalogue, habits, order, form, self.seed, words)
    }

    fn made(&self) -> (Catalogue, Vec<Set>) {
        let (catalogue, recipe) = Catalogue::papers();
        let (n, seed) = (self.samples, self.seed);
        let mut sets = Vec::new();
        for level in Level::ALL {
            for kind in Kind::ALL {
                sets.push(generate::set(&catalogue, &recipe, kind, level, n, seed));
            }
            sets.push(free::set(&catalogue, &recipe, level, n, seed));
        }
        sets.sort_by(|a, b| a.name.cmp(&b.name));
        (catalogue, sets)
    }
}
