//! `deictic-eval generate`

use std::path::PathBuf;

use anyhow::Context;
use deictic_eval::catalogue::Catalogue;
use deictic_eval::dataset::write;
use deictic_eval::free;
use deictic_eval::generate::{Kind, set};
use deictic_eval::noise::Level;
use deictic_eval::phonetic;
use rayon::prelude::*;

/// Make the paper's sets anew: D_A, D_arity and D_prop at n0 to n4, and the fairer D_free.
#[derive(clap::Args)]
pub struct Generate {
    /// Folder to write vocab.json and the sets to
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Vocabulary in the form of tests/eval/vocabularies/paper.toml, which also says by what chance things have
    /// their features; not `deictic`'s form [default: the paper's]
    #[arg(long, value_name = "FILE")]
    vocabulary: Option<PathBuf>,
    /// Samples per set
    #[arg(long, default_value_t = 1000, value_parser = super::at_least_one)]
    samples: usize,
    /// Seed; the same seed gives the same sets
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Whose similarity table language follows
    #[arg(long, value_enum, default_value = "published")]
    language: Language,
}

/// Where the language table comes from.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Language {
    /// From the vocabulary file.
    Published,
    /// From how its names sound.
    Phonetic,
}

impl Generate {
    pub fn run(self) -> anyhow::Result<()> {
        let (mut catalogue, recipe) = match &self.vocabulary {
            Some(file) => Catalogue::read_toml(file).context(
                "a vocabulary of sets has the form of tests/eval/vocabularies/paper.toml, not that of `deictic`",
            )?,
            None => Catalogue::papers(),
        };
        if matches!(self.language, Language::Phonetic) {
            phonetic::correct(&mut catalogue);
        }
        std::fs::create_dir_all(&self.out)
            .with_context(|| format!("cannot make {}", self.out.display()))?;
        let to = |name: &str| self.out.join(name);
        write::vocabulary(&to("vocab.json"), &catalogue).context("cannot write vocab.json")?;
        let kinds = Kind::ALL.into_iter().map(Some).chain([None]);
        let all: Vec<(Option<Kind>, Level)> = kinds
            .flat_map(|kind| Level::ALL.map(|level| (kind, level)))
            .collect();
        let (n, seed) = (self.samples, self.seed);
        all.into_par_iter().try_for_each(|(kind, level)| {
            let set = match kind {
                Some(kind) => set(&catalogue, &recipe, kind, level, n, seed),
                None => free::set(&catalogue, &recipe, level, n, seed),
            };
            let file = to(&format!("{}.jsonl.gz", set.name));
            write::set(&file, &set, &catalogue)
                .with_context(|| format!("cannot write {}", file.display()))
        })
    }
}
