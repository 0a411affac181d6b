//! The deepest the stack was in whole conversations, measured on the unmodified image in QEMU.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use object::{Object, ObjectSymbol};

use crate::process::{self, cargo};

/// How often the conversations are begun.
const ATTEMPTS: usize = 3;

/// Has the image hold conversations with its stack painted; gives the bytes that were used. The program that talks is
/// `high-water` of the tests.
pub fn high_water(image: &Path) -> Result<u32> {
    let bytes = std::fs::read(image)?;
    let file = object::File::parse(&*bytes)?;
    let address = |name: &str| {
        file.symbol_by_name(name)
            .map(|symbol| symbol.address().to_string())
            .with_context(|| format!("{} has no symbol {name}", image.display()))
    };
    let mut talk = cargo();
    talk.args(["run", "--quiet", "--package", "deictic-tests"])
        .args(["--bin", "high-water", "--"])
        .arg(image)
        .args([address("__sheap")?, address("_stack_start")?]);
    // An emulated board that gets no time to run answers too late.
    let used = (0..ATTEMPTS).find_map(|_| {
        let said = process::output(&mut talk)?;
        let line = said.lines().find_map(|l| l.strip_prefix("high-water "))?;
        line.trim().parse().ok()
    });
    ensure!(
        used.is_some(),
        "the conversation with the painted board came to nothing: `cargo run -p deictic-tests --bin high-water -- {} \
         START END` says why",
        image.display()
    );
    Ok(used.unwrap_or_default())
}
