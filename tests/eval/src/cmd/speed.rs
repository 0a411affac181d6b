//! `deictic-eval speed`

use anyhow::Context;
use deictic_eval::catalogue::Catalogue;
use deictic_eval::dataset::{self, write};
use deictic_eval::generate::{Kind, set};
use deictic_eval::noise::Level;
use deictic_eval::speed::{Track, per_second};
use deictic_eval::variant::{ModelName, ProfileName, Variant};
use deictic_eval::{peer, record::CATEGORIES};
use serde::Serialize;

/// Samples per set; six sets are decided.
const SAMPLES: usize = 500;

/// How often everything is timed; the best counts.
const ROUNDS: usize = 40;

/// Count decisions per second on one core, and set them beside numpy's.
///
/// Python's answers are compared with the core's, so that the ratio is between programs that decide
/// alike.
#[derive(clap::Args)]
pub struct Speed {
    /// Which Python to run the numpy version with
    #[arg(long, default_value = "python3", value_name = "COMMAND")]
    python: String,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What is measured.
#[derive(Serialize)]
struct Figures {
    baseline_per_second: f64,
    m1_per_second: f64,
    m2_per_second: f64,
    m3_per_second: f64,
    joint_per_second: f64,
    /// M3 with the reference's habits, which is what numpy computes.
    m3_reference_per_second: f64,
    numpy_per_second: Option<f64>,
    /// `m3_reference_per_second` over `numpy_per_second`.
    ratio: Option<f64>,
}

impl Speed {
    pub fn run(self) -> anyhow::Result<()> {
        let (catalogue, recipe) = Catalogue::papers();
        let folder = tempfile::tempdir().context("no folder for samples")?;
        write::vocabulary(&folder.path().join("vocab.json"), &catalogue)?;
        for kind in Kind::ALL {
            for level in [Level::N1, Level::N3] {
                let set = set(&catalogue, &recipe, kind, level, SAMPLES, 5);
                let file = folder.path().join(format!("{}.jsonl.gz", set.name));
                write::set(&file, &set, &catalogue)?;
            }
        }
        // Read back, so that both sides see the same six digits.
        let (catalogue, sets) = dataset::read_folder(folder.path())?;
        let tracks: Vec<Track> = sets
            .iter()
            .map(|set| Track::new(set, &catalogue))
            .collect::<anyhow::Result<_>>()?;
        let rate = |model, profile| {
            let settings = Variant::new(model, None, None, profile).settings();
            per_second(&tracks, &settings, ROUNDS)
        };
        let paper = |model| rate(model, ProfileName::Paper);
        let mut figures = Figures {
            baseline_per_second: paper(ModelName::Baseline),
            m1_per_second: paper(ModelName::M1),
            m2_per_second: paper(ModelName::M2),
            m3_per_second: paper(ModelName::M3),
            joint_per_second: paper(ModelName::Joint),
            m3_reference_per_second: rate(ModelName::M3, ProfileName::Reference),
            numpy_per_second: None,
            ratio: None,
        };
        match peer::run(&self.python, folder.path(), 3) {
            Ok(report) => {
                let settings = Variant::new(ModelName::M3, None, None, ProfileName::Reference);
                let (mut same, mut all) = (0, 0);
                for (set, track) in sets.iter().zip(&tracks) {
                    let theirs = report.answers.get(&set.name).context("a set is missing")?;
                    let ours = track.answers(&settings.settings())?;
                    all += CATEGORIES * ours.len();
                    let pairs = ours.iter().flatten().zip(theirs.iter().flatten());
                    same += pairs.filter(|(a, b)| a == b).count();
                }
                anyhow::ensure!(
                    same * 1000 >= all * 999,
                    "numpy decides otherwise in {} of {all} cases, so the ratio would mean nothing",
                    all - same
                );
                let numpy = report.decisions as f64 / report.seconds;
                figures.numpy_per_second = Some(numpy);
                figures.ratio = Some(figures.m3_reference_per_second / numpy);
            }
            Err(error) => eprintln!("numpy is left out: {error}"),
        }
        if self.json {
            return super::print_json(&figures);
        }
        println!("decisions per second on one core");
        for (name, rate) in [
            ("baseline", Some(figures.baseline_per_second)),
            ("m1", Some(figures.m1_per_second)),
            ("m2", Some(figures.m2_per_second)),
            ("m3", Some(figures.m3_per_second)),
            ("joint", Some(figures.joint_per_second)),
            ("m3, reference", Some(figures.m3_reference_per_second)),
            ("numpy", figures.numpy_per_second),
        ] {
            if let Some(rate) = rate {
                println!("{name:<14} {rate:>10.0}");
            }
        }
        if let Some(ratio) = figures.ratio {
            println!("{ratio:.0} times numpy");
        }
        Ok(())
    }
}
