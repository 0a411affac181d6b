//! Instructions of an operation, counted on the board in QEMU.

use std::collections::BTreeMap;

use anyhow::{Context, Result, ensure};

use crate::board;
use crate::qemu;
use crate::toolchain::Toolchain;

/// Boots the measuring image and reads its lines `instructions NAME COUNT`.
pub fn count(toolchain: &Toolchain) -> Result<BTreeMap<String, u64>> {
    let image = board::build_trial(toolchain, "bench")?;
    let mut counts = BTreeMap::new();
    for line in qemu::measured(&image)? {
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
    ensure!(!counts.is_empty(), "the measuring image gave no figures");
    Ok(counts)
}
