use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use clap::Args;

use crate::process::{self, cargo};

/// See that the oldest compiler and the oldest libraries that the manifests allow still do.
///
/// The oldest compiler is the one that all is tested with. For the libraries a copy of the workspace
/// is resolved to the least version of each direct dependency, and checked.
#[derive(Args)]
pub struct Versions;

/// What the workspace is made of.
const PARTS: [&str; 9] = [
    "Cargo.toml",
    "core",
    "firmware",
    "host-bridge",
    "memory.x",
    "rust-toolchain.toml",
    "tests",
    "xtask",
    "docs",
];

impl Versions {
    pub fn run(self) -> Result<()> {
        let root = process::root();
        let stated = field(&root.join("Cargo.toml"), "rust-version")?;
        let used = field(&root.join("rust-toolchain.toml"), "channel")?;
        ensure!(
            used.strip_prefix(&stated)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('.')),
            "Cargo.toml says that Rust {stated} will do, and Rust {used} is what it is tested with"
        );
        let folder = process::target().join("least-versions");
        let place = folder.join("workspace");
        if place.exists() {
            fs::remove_dir_all(&place)?;
        }
        fs::create_dir_all(&place)?;
        for part in PARTS {
            copy(&root.join(part), &place.join(part))?;
        }
        // The resolver's option is not stable, and needs a compiler that is told so.
        let mut resolve = cargo();
        resolve
            .args(["update", "--quiet", "-Z", "direct-minimal-versions"])
            .env("RUSTC_BOOTSTRAP", "1")
            .current_dir(&place);
        process::run(&mut resolve)
            .context("the least versions in the manifests contradict each other")?;
        // In a folder of its own: cargo takes what two copies of one workspace build for the same.
        let mut check = cargo();
        check
            .args([
                "check",
                "--quiet",
                "--workspace",
                "--exclude",
                "deictic-firmware",
                "--all-targets",
            ])
            .env("CARGO_TARGET_DIR", folder.join("build"))
            .current_dir(&place);
        process::run(&mut check)?;
        println!("Rust {stated} and the least version of every library will do");
        Ok(())
    }
}

/// The value of the line `key = "value"`.
fn field(file: &Path, key: &str) -> Result<String> {
    let text = fs::read_to_string(file)?;
    let value = text.lines().find_map(|line| {
        let rest = line.strip_prefix(key)?.trim_start().strip_prefix('=')?;
        rest.trim().strip_prefix('"')?.strip_suffix('"')
    });
    let missing = || format!("{} has no {key}", file.display());
    Ok(value.with_context(missing)?.to_owned())
}

/// Copies a file, or a folder without what was built in it.
fn copy(from: &Path, to: &Path) -> Result<()> {
    if !from.is_dir() {
        fs::copy(from, to).with_context(|| format!("cannot copy {}", from.display()))?;
        return Ok(());
    }
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let name = entry?.file_name();
        if name != "target" {
            copy(&from.join(&name), &to.join(&name))?;
        }
    }
    Ok(())
}
