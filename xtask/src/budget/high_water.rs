//! The deepest the stack was in whole conversations, measured on the unmodified image in QEMU.

use std::path::Path;
use std::process::Stdio;

use anyhow::{Context, Result, bail};
use object::{Object, ObjectSymbol};

use crate::process::cargo;

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
    for _ in 0..ATTEMPTS {
        let ended = talk.stdin(Stdio::null()).output();
        let ended = ended.context("cannot start cargo")?;
        let said = String::from_utf8_lossy(&ended.stdout);
        let line = said.lines().find_map(|l| l.strip_prefix("high-water "));
        if let Some(used) = line.and_then(|used| used.trim().parse().ok()) {
            return Ok(used);
        }
        eprint!("{}", String::from_utf8_lossy(&ended.stderr));
    }
    bail!("the conversation with the painted board came to nothing {ATTEMPTS} times, as said above")
}
