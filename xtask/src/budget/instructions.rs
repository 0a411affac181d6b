//! Instructions of an operation, counted on the board in QEMU.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

use anyhow::{Context, Result, bail};

use crate::board;
use crate::qemu::{self, Link};
use crate::toolchain::Toolchain;

/// Boots the measuring image and reads its lines `instructions NAME COUNT`.
pub fn count(toolchain: &Toolchain) -> Result<BTreeMap<String, u64>> {
    let image = board::build_trial(toolchain, "bench")?;
    let mut command = qemu::command(&image, &Link::Null);
    qemu::count_instructions(&mut command);
    let mut qemu = command
        .stdout(Stdio::piped())
        .spawn()
        .context("cannot start QEMU")?;
    let output = qemu.stdout.take().context("QEMU has no output")?;
    let mut counts = BTreeMap::new();
    for line in BufReader::new(output).lines() {
        let line = line?;
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            ["stack", ..] => {}
            ["instructions", name, count] => {
                let count = count
                    .parse()
                    .with_context(|| format!("the measuring image said `{line}`"))?;
                counts.insert((*name).to_owned(), count);
            }
            _ => eprintln!("measuring image: {line}"),
        }
    }
    let status = qemu.wait()?;
    if !status.success() || counts.is_empty() {
        bail!(
            "the measuring image did not end well ({status}) after {} figures",
            counts.len()
        );
    }
    Ok(counts)
}
