use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail, ensure};
use clap::Args;

use crate::process::{self, cargo, output, root};
use crate::toolchain::apt_install;

/// What libFuzzer needs to see which edges an input takes: stable flags of rustc, those that cargo-fuzz gives.
const INSTRUMENTED: &str = "-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares --cfg fuzzing";

/// Fuzz the core and the bridge's doors, each target for some seconds.
///
/// Builds tests/fuzz with the pinned compiler (no nightly is needed), starts from the corpora that are committed there,
/// and keeps what it finds under target/fuzz. Needs a C++ compiler for libFuzzer. An input that breaks something is
/// kept and named; `cargo test -p deictic-tests --test corpus` replays it once it is copied to the target's corpus.
#[derive(Args)]
pub struct Fuzz {
    /// How long each target runs.
    #[arg(long, default_value_t = 10)]
    seconds: u64,
    /// Only these targets; all without it.
    #[arg(long)]
    target: Vec<String>,
    /// Make the committed corpora of what covers most, with at most this many inputs each.
    #[arg(long, value_name = "INPUTS")]
    shrink: Option<usize>,
}

impl Fuzz {
    pub fn run(self) -> Result<()> {
        if process::find("c++").is_none() {
            apt_install(&["g++".to_owned()])
                .context("libFuzzer is written in C++ and there is no c++ on PATH")?;
        }
        let all = targets()?;
        if let Some(unknown) = self.target.iter().find(|t| !all.contains(t)) {
            bail!("there is no target {unknown}; there are {}", all.join(", "));
        }
        let work = build_folder();
        build(&work)?;
        println!(
            "{:<10} {:>12} {:>9} {:>7} {:>7}",
            "target", "executions", "per s", "edges", "inputs"
        );
        let mut broken = Vec::new();
        for target in all
            .iter()
            .filter(|t| self.target.is_empty() || self.target.contains(t))
        {
            let runner = Runner::new(&work, target)?;
            let report = runner.fuzz(self.seconds)?;
            println!(
                "{target:<10} {:>12} {:>9} {:>7} {:>7}",
                report.executions, report.per_second, report.edges, report.inputs
            );
            broken.extend(report.broken);
            if let Some(most) = self.shrink {
                runner.shrink(most)?;
            }
        }
        ensure!(
            broken.is_empty(),
            "these inputs break something: {}",
            broken.join(" ")
        );
        Ok(())
    }
}

/// The targets' names: those of the sources.
fn targets() -> Result<Vec<String>> {
    let sources = root().join("tests/fuzz/fuzz_targets");
    let mut names = Vec::new();
    for entry in std::fs::read_dir(&sources).with_context(|| sources.display().to_string())? {
        let path = entry?.path();
        names.extend(
            path.file_stem()
                .map(|name| name.to_string_lossy().into_owned()),
        );
    }
    names.sort();
    Ok(names)
}

fn build_folder() -> PathBuf {
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
    target.join("fuzz")
}

/// The host's target: named, so that the flags do not go to build scripts and macros.
fn host() -> Result<String> {
    output(Command::new("rustc").arg("-vV").current_dir(root()))
        .and_then(|text| {
            Some(
                text.lines()
                    .find_map(|l| l.strip_prefix("host: "))?
                    .to_owned(),
            )
        })
        .context("rustc does not say which host it runs on")
}

fn build(work: &Path) -> Result<()> {
    let mut build = cargo();
    build
        .current_dir(root().join("tests/fuzz"))
        .args(["build", "--release", "--target", &host()?])
        .env("CARGO_TARGET_DIR", work)
        .env("RUSTFLAGS", INSTRUMENTED)
        .env_remove("CARGO_ENCODED_RUSTFLAGS");
    process::run(&mut build)
}

struct Runner {
    program: PathBuf,
    /// What is committed.
    seeds: PathBuf,
    /// What grows.
    corpus: PathBuf,
    artifacts: PathBuf,
    longest: usize,
}

struct Report {
    executions: u64,
    per_second: u64,
    edges: u64,
    inputs: usize,
    broken: Vec<String>,
}

impl Runner {
    fn new(work: &Path, target: &str) -> Result<Self> {
        let runner = Self {
            program: work.join(host()?).join("release").join(target),
            seeds: root().join("tests/fuzz/corpus").join(target),
            corpus: work.join("corpus").join(target),
            artifacts: work.join("artifacts").join(target),
            longest: longest(target)?,
        };
        for folder in [&runner.seeds, &runner.corpus, &runner.artifacts] {
            std::fs::create_dir_all(folder)?;
        }
        Ok(runner)
    }

    fn command(&self) -> Command {
        let mut command = Command::new(&self.program);
        command
            .arg(format!("-max_len={}", self.longest))
            .arg(format!("-artifact_prefix={}/", self.artifacts.display()))
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
        command
    }

    fn fuzz(&self, seconds: u64) -> Result<Report> {
        let mut command = self.command();
        command
            .args([&self.corpus, &self.seeds])
            .arg(format!("-max_total_time={seconds}"))
            .args(["-len_control=0", "-print_final_stats=1", "-timeout=20"]);
        let ended = command
            .output()
            .with_context(|| self.program.display().to_string())?;
        let said = String::from_utf8_lossy(&ended.stderr);
        let number = |name: &str| {
            said.lines()
                .find_map(|l| l.strip_prefix(name)?.trim().parse().ok())
                .unwrap_or(0)
        };
        let edges = said
            .lines()
            .rev()
            .find_map(|l| l.split_once("cov: ")?.1.split(' ').next()?.parse().ok())
            .unwrap_or(0);
        let broken = if ended.status.success() {
            Vec::new()
        } else {
            for line in said
                .lines()
                .filter(|l| l.contains("panicked at") || l.contains("ERROR"))
            {
                eprintln!("{line}");
            }
            said.lines()
                .find_map(|l| {
                    l.split_once("Test unit written to ")
                        .map(|(_, path)| path.to_owned())
                })
                .map_or_else(
                    || vec![self.program.display().to_string()],
                    |path| vec![path],
                )
        };
        Ok(Report {
            executions: number("stat::number_of_executed_units:"),
            per_second: number("stat::average_exec_per_sec:"),
            edges,
            inputs: std::fs::read_dir(&self.corpus)?.count(),
            broken,
        })
    }

    /// Puts into the committed corpus the smallest set of inputs that covers what all cover, or the beginning of it.
    fn shrink(&self, most: usize) -> Result<()> {
        let merged = self.corpus.with_extension("merged");
        let _ = std::fs::remove_dir_all(&merged);
        std::fs::create_dir_all(&merged)?;
        let mut merge = self.command();
        merge
            .arg("-merge=1")
            .arg(&merged)
            .args([&self.seeds, &self.corpus])
            .stderr(Stdio::null());
        process::run(&mut merge)?;
        let mut inputs: Vec<PathBuf> = std::fs::read_dir(&merged)?
            .map(|entry| entry.map(|e| e.path()))
            .collect::<std::io::Result<_>>()?;
        inputs.sort();
        // Names are hashes, so that the first of them are any of them.
        for input in inputs.iter().take(most) {
            if let Some(name) = input.file_name() {
                std::fs::copy(input, self.seeds.join(name))?;
            }
        }
        Ok(())
    }
}

/// How long an input may be: what deictic-tests says of the target.
fn longest(target: &str) -> Result<usize> {
    let table = root().join("tests/src/fuzz/mod.rs");
    let text = std::fs::read_to_string(&table)?;
    let entry = format!("target(\"{target}\", ");
    text.lines()
        .find_map(|l| {
            l.trim()
                .strip_prefix(&entry)?
                .split(',')
                .next()?
                .trim()
                .parse()
                .ok()
        })
        .with_context(|| format!("{} does not name {target}", table.display()))
}
