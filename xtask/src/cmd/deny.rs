use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result};
use clap::Args;

use crate::process::{self, cargo};

/// See that everything that is built in has a licence that allows it and comes from the registry
/// (`deny.toml`), with cargo-deny, which is built first where it is missing: that takes minutes.
#[derive(Args)]
pub struct Deny {
    /// Look for known security advisories as well; fetches their list
    #[arg(long)]
    advisories: bool,
}

/// The release that `deny.toml` was written for.
const RELEASE: &str = "0.20.2";

impl Deny {
    pub fn run(self) -> Result<()> {
        let program = program()?;
        let mut checks = vec!["bans", "licenses", "sources"];
        if self.advisories {
            checks.push("advisories");
        }
        for manifest in ["Cargo.toml", "tests/fuzz/Cargo.toml"] {
            let mut deny = Command::new(&program);
            deny.current_dir(process::root());
            deny.args(["--all-features", "--manifest-path", manifest, "check"]);
            deny.args(&checks);
            process::run(&mut deny)?;
        }
        Ok(())
    }
}

/// cargo-deny, beside the other build products.
fn program() -> Result<PathBuf> {
    let place = process::target().join("cargo-deny");
    let program = place.join("bin/cargo-deny");
    if !program.is_file() {
        let mut install = cargo();
        install.args([
            "install",
            "--quiet",
            "--locked",
            "--no-default-features",
            "cargo-deny",
        ]);
        install.args(["--version", RELEASE, "--root"]).arg(&place);
        process::run(&mut install).context("cargo-deny could not be built")?;
    }
    Ok(program)
}
