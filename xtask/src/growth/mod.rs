//! How the instructions of a decision grow with what there is.

mod chart;
mod fit;

use std::collections::BTreeMap;

use anyhow::{Context, Result, ensure};

use crate::board;
use crate::qemu;
use crate::toolchain::Toolchain;

pub use chart::draw;
pub use fit::Fit;

/// Instructions by model, direction and size.
pub type Curves = BTreeMap<String, BTreeMap<String, BTreeMap<u32, u64>>>;

/// Boots the measuring image and reads its lines `growth MODEL DIRECTION SIZE INSTRUCTIONS`.
pub fn measure(toolchain: &Toolchain) -> Result<Curves> {
    let image = board::build_trial(toolchain, "growth")?;
    let mut curves = Curves::new();
    for line in qemu::measured(&image)? {
        let words: Vec<&str> = line.split_whitespace().collect();
        let ["growth", model, direction, size, count] = words.as_slice() else {
            eprintln!("measuring image: {line}");
            continue;
        };
        let said = || format!("the measuring image said `{line}`");
        curves
            .entry((*model).to_owned())
            .or_default()
            .entry((*direction).to_owned())
            .or_default()
            .insert(
                size.parse().with_context(said)?,
                count.parse().with_context(said)?,
            );
    }
    ensure!(!curves.is_empty(), "the measuring image gave no figures");
    Ok(curves)
}
