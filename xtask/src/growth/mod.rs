//! How the instructions of a decision grow with what there is.

mod chart;
mod fit;

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

use anyhow::{Context, Result, ensure};

use crate::board;
use crate::qemu::{self, Link};
use crate::toolchain::Toolchain;

pub use chart::draw;
pub use fit::Fit;

/// Instructions by model, direction and size.
pub type Curves = BTreeMap<String, BTreeMap<String, BTreeMap<u32, u64>>>;

/// Boots the measuring image and reads its lines `growth MODEL DIRECTION SIZE INSTRUCTIONS`.
pub fn measure(toolchain: &Toolchain) -> Result<Curves> {
    let image = board::build_trial(toolchain, "growth")?;
    let mut command = qemu::command(&image, &Link::Null);
    qemu::count_instructions(&mut command);
    let mut qemu = command
        .stdout(Stdio::piped())
        .spawn()
        .context("cannot start QEMU")?;
    let output = qemu.stdout.take().context("QEMU has no output")?;
    let mut curves = Curves::new();
    for line in BufReader::new(output).lines() {
        let line = line?;
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
    let status = qemu.wait()?;
    ensure!(
        status.success() && !curves.is_empty(),
        "the measuring image did not end well ({status})"
    );
    Ok(curves)
}
