use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::cmd::setup;
use crate::growth::{self, Curves, Fit};
use crate::process::root;
use crate::toolchain::Toolchain;

/// Measure how the cost of a decision grows with actions, objects, modalities and words, on the board in QEMU.
///
/// Fails when growth is not a straight line, or when a figure is more than 3 % above its golden one
/// (tests/expected/growth-COMPILER.json).
#[derive(Args)]
pub struct Growth {
    /// Record the figures as the golden ones, and draw them (docs/growth.svg)
    #[arg(long)]
    bless: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// As the picture shows them.
const DIRECTIONS: [&str; 4] = ["actions", "objects", "modalities", "words"];

/// How far from the straight line a figure may be, as a share of the largest one. Sentences of one or two words, whose
/// actions lack a parameter, take another way through the decision than whole ones.
const OFF: f64 = 0.08;

/// The most by which the best parabola may bend upwards, as a share of the largest figure.
const BEND: f64 = 0.06;

/// How far above a golden figure one may be.
const TOLERANCE: f64 = 1.03;

impl Growth {
    pub fn run(self) -> Result<()> {
        let toolchain = setup::ensure()?;
        let curves = growth::measure(&toolchain)?;
        let golden = golden(&toolchain);
        if self.bless {
            std::fs::write(&golden, serde_json::to_string_pretty(&curves)? + "\n")
                .with_context(|| golden.display().to_string())?;
            let picture = root().join("docs/growth.svg");
            std::fs::write(&picture, growth::draw(&curves, &DIRECTIONS))
                .with_context(|| picture.display().to_string())?;
        }
        if self.json {
            println!("{}", serde_json::to_string_pretty(&curves)?);
        } else {
            print(&curves);
        }
        judge(&curves, &toolchain)
    }

    /// For `cargo xtask test`.
    pub fn check(toolchain: &Toolchain) -> Result<()> {
        let curves = growth::measure(toolchain)?;
        print(&curves);
        judge(&curves, toolchain)
    }
}

fn golden(toolchain: &Toolchain) -> PathBuf {
    let name = format!("growth-{}.json", toolchain.label());
    root().join("tests/expected").join(name)
}

fn print(curves: &Curves) {
    println!(
        "{:<6} {:<11} {:>6} {:>9} {:>9} {:>9} {:>7} {:>7} {:>7}",
        "model", "direction", "sizes", "least", "most", "each", "R2", "off", "bend"
    );
    for (model, by_direction) in curves {
        for (direction, curve) in by_direction {
            let fit = Fit::of(curve);
            let ends = |mut sizes: std::vec::IntoIter<u32>| (sizes.next(), sizes.last());
            let (first, last) = ends(curve.keys().copied().collect::<Vec<_>>().into_iter());
            println!(
                "{model:<6} {direction:<11} {:>6} {:>9} {:>9} {:>9.0} {:>7.4} {:>7.3} {:>+7.3}",
                format!("{}-{}", first.unwrap_or(0), last.unwrap_or(0)),
                curve.values().min().unwrap_or(&0),
                curve.values().max().unwrap_or(&0),
                fit.slope,
                fit.r_squared,
                fit.off,
                fit.bend
            );
        }
    }
}

/// Fails on growth that is no straight line, and on figures above their golden ones.
fn judge(curves: &Curves, toolchain: &Toolchain) -> Result<()> {
    let mut wrong = Vec::new();
    for (model, by_direction) in curves {
        for (direction, curve) in by_direction {
            let fit = Fit::of(curve);
            if fit.off > OFF || fit.bend > BEND {
                wrong.push(format!(
                    "{model} does not grow in a straight line with {direction}: {fit:?}"
                ));
            }
        }
    }
    let path = golden(toolchain);
    if path.is_file() {
        let golden: Curves = serde_json::from_str(&std::fs::read_to_string(&path)?)
            .with_context(|| format!("{} is damaged", path.display()))?;
        let now = |model: &str, direction: &str, size| {
            curves.get(model)?.get(direction)?.get(&size).copied()
        };
        for (model, by_direction) in &golden {
            for (direction, curve) in by_direction {
                for (size, golden) in curve {
                    match now(model, direction, *size) {
                        Some(now) if now as f64 <= *golden as f64 * TOLERANCE => {}
                        now => wrong.push(format!(
                            "{model} takes {now:?} with {size} {direction}, and {golden} when it was recorded"
                        )),
                    }
                }
            }
        }
    } else {
        eprintln!(
            "nothing is recorded under {}: only the shape was checked",
            toolchain.label()
        );
    }
    if !wrong.is_empty() {
        bail!(
            "{}\nMake it cheaper, or record it with `cargo xtask growth --bless` and say why in the commit",
            wrong.join("\n")
        );
    }
    Ok(())
}
