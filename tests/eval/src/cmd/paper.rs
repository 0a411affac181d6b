//! `deictic-eval paper`

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::Context;
use deictic_eval::catalogue::Catalogue;
use deictic_eval::dataset;
use deictic_eval::free;
use deictic_eval::generate::{self, Kind};
use deictic_eval::noise::Level;
use deictic_eval::paper::recorded::Recorded;
use deictic_eval::paper::report::{Material, html};
use deictic_eval::paper::{Group, csv, draw, run, steps, studies};
use deictic_eval::setups::Setups;
use deictic_eval::situation::FeatureForm;
use indicatif::{ProgressBar, ProgressStyle};

/// How often each set-up's command is drawn.
const DRAWS: usize = 100;

/// Run every experiment of the paper; write figures, tables and a report.
#[derive(clap::Args)]
pub struct Paper {
    /// Folder to write report.html, figures (SVG, PNG, CSV) and all counts to
    #[arg(long, default_value = "paper-report", value_name = "DIR")]
    out: PathBuf,
    /// Folder with the paper's 15 sets and their vocab.json [default: sets made here]
    #[arg(long, value_name = "DIR")]
    sets: Option<PathBuf>,
    /// Folder with the reference's accuracy.csv and bayes_bound.csv, to set beside
    #[arg(long, value_name = "DIR")]
    reference: Option<PathBuf>,
    /// The user study's set-ups (JSON)
    #[arg(long, value_name = "FILE")]
    setups: Option<PathBuf>,
    /// Samples per set where sets are made
    #[arg(long, default_value_t = 4000, value_parser = super::at_least_one)]
    samples: usize,
    /// Seed of sets made here
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

impl Paper {
    pub fn run(self) -> anyhow::Result<()> {
        let started = Instant::now();
        let (groups, source) = self.groups()?;
        let recorded = self.reference.as_deref().map(Recorded::read).transpose()?;
        std::fs::create_dir_all(&self.out)
            .with_context(|| format!("cannot make {}", self.out.display()))?;

        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} sets decided, {eta} left")?;
        let bar = ProgressBar::new(steps(&groups) as u64).with_style(style);
        let results = run(&groups, &|| bar.inc(1))?;
        bar.finish_and_clear();

        draw::noise_levels(&self.out)?;
        let mut figures = Vec::new();
        for figure in studies::figures(&results) {
            draw::figure(&self.out, &figure)?;
            csv::figure(&self.out.join(format!("{}.csv", figure.name)), &figure)?;
            let svg = self.read(&format!("{}.svg", figure.name))?;
            figures.push((figure, svg));
        }
        csv::scores(&self.out.join("scores.csv"), &results)?;
        csv::bounds(&self.out.join("bounds.csv"), &results)?;
        let material = Material {
            results: &results,
            recorded: recorded.as_ref(),
            figures: &figures,
            noise_levels: &self.read("noise-levels.svg")?,
            source: &source,
        };
        let report = self.out.join("report.html");
        std::fs::write(&report, html(&material))
            .with_context(|| format!("cannot write {}", report.display()))?;
        println!(
            "{} figures and {} in {:.1} s",
            figures.len() + 1,
            report.display(),
            started.elapsed().as_secs_f64()
        );
        Ok(())
    }

    fn read(&self, name: &str) -> anyhow::Result<String> {
        let file = self.out.join(name);
        std::fs::read_to_string(&file).with_context(|| format!("cannot read {}", file.display()))
    }

    fn groups(&self) -> anyhow::Result<(Vec<Group>, String)> {
        let (papers, recipe) = Catalogue::papers();
        let (n, seed) = (self.samples, self.seed);
        let mut source;
        let simulated = match &self.sets {
            Some(folder) => {
                let (catalogue, sets) = dataset::read_folder(folder)?;
                source = format!(
                    "The simulated sets are those of {}; D_free is made here where it has none.",
                    name(folder)
                );
                Group {
                    catalogue,
                    sets,
                    form: FeatureForm::Sure,
                }
            }
            None => {
                source =
                    format!("The simulated sets were made anew, {n} samples each, seed {seed}.");
                let all = Kind::ALL
                    .into_iter()
                    .flat_map(|kind| Level::ALL.map(|level| (kind, level)));
                Group {
                    sets: all
                        .map(|(kind, level)| generate::set(&papers, &recipe, kind, level, n, seed))
                        .collect(),
                    catalogue: papers.clone(),
                    form: FeatureForm::Sure,
                }
            }
        };
        let sets = Level::ALL.map(|level| free::set(&papers, &recipe, level, n, seed));
        let mut groups = vec![
            simulated,
            Group {
                catalogue: papers,
                sets: sets.to_vec(),
                form: FeatureForm::Graded,
            },
        ];
        if let Some(file) = &self.setups {
            let setups = Setups::read(file)?;
            source += &format!(
                " The user study's set-ups are played {DRAWS} times each, with likelihoods drawn at \
                 noise n1, as its recordings are not public."
            );
            groups.push(Group {
                sets: setups.all(Level::N1.into(), DRAWS, seed),
                catalogue: setups.catalogue,
                form: FeatureForm::Sure,
            });
        }
        Ok((groups, source))
    }
}

fn name(folder: &Path) -> String {
    let name = folder.file_name().unwrap_or_default();
    format!("the folder {}", name.to_string_lossy())
}
