//! The boards and how their images are built.

use std::path::{Path, PathBuf};
use std::process::Stdio;

use anyhow::{Context, Result, bail};
use clap::ValueEnum;
use object::{Object, ObjectSymbol};
use serde_json::Value;

use crate::toolchain::Toolchain;

/// A board that the firmware has a module for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Board {
    /// QEMU's Cortex-M4F, on which tests, demo and budgets run.
    Mps2An386,
    /// The real board.
    NucleoG474re,
}

impl Board {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Mps2An386, Self::NucleoG474re];

    /// Its cargo feature and the name of its image.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mps2An386 => "mps2-an386",
            Self::NucleoG474re => "nucleo-g474re",
        }
    }

    /// The environment variable through which tests of the whole learn where the image is.
    pub fn image_variable(self) -> &'static str {
        match self {
            Self::Mps2An386 => "DEICTIC_IMAGE_MPS2_AN386",
            Self::NucleoG474re => "DEICTIC_IMAGE_NUCLEO_G474RE",
        }
    }
}

/// Builds the unit's release image for a board and says where it is.
pub fn build(toolchain: &Toolchain, board: Board) -> Result<PathBuf> {
    build_image(toolchain, board.name(), board.name(), None)
}

/// Builds the unit's release image with a key, and says where it is: beside the plain one.
pub fn build_keyed(toolchain: &Toolchain, board: Board, key: &Path) -> Result<PathBuf> {
    build_beside(toolchain, board, (board.name(), "keyed"), Some(key))
}

/// Builds the unit's release image whose host link is a CAN bus, and says where it is: beside the other one.
pub fn build_on_can(toolchain: &Toolchain, board: Board) -> Result<PathBuf> {
    build_variant(toolchain, board, "can")
}

/// Builds an image with one more feature, and says where it is: beside the plain one.
fn build_variant(toolchain: &Toolchain, board: Board, feature: &str) -> Result<PathBuf> {
    let features = format!("{},{feature}", board.name());
    build_beside(toolchain, board, (&features, feature), None)
}

/// Builds an image with these features, or this key, and says where it is: beside the plain one under its name and that
/// of the variant. The plain one is built after it, as cargo puts both at the same place and that is where everyone
/// looks for the plain one.
fn build_beside(
    toolchain: &Toolchain,
    board: Board,
    (features, variant): (&str, &str),
    key: Option<&Path>,
) -> Result<PathBuf> {
    let name = board.name();
    let built = build_image(toolchain, features, name, key)?;
    let kept = built.with_file_name(format!("{name}-{variant}"));
    std::fs::copy(&built, &kept).with_context(|| format!("cannot write {}", kept.display()))?;
    build(toolchain, board)?;
    Ok(kept)
}

/// Builds the unit's release image for QEMU whose time passes 25 times as fast, and says where it is.
pub fn build_hasty(toolchain: &Toolchain) -> Result<PathBuf> {
    build_variant(toolchain, Board::Mps2An386, "hasty")
}

/// Builds one of the images that try the board in QEMU: `bench`, `bits` or `faults`.
pub fn build_trial(toolchain: &Toolchain, name: &str) -> Result<PathBuf> {
    build_image(toolchain, "bench", name, None)
}

/// Whether the image that calls all of the core links, holds no formatting, and does not link any more once an index that can
/// panic is added.
pub fn check_interface(toolchain: &Toolchain) -> Result<()> {
    let image = build_image(toolchain, "interface", "interface", None)?;
    let bytes = std::fs::read(&image)?;
    let file = object::File::parse(&*bytes)?;
    let formats: Vec<String> = file
        .symbols()
        .filter_map(|symbol| symbol.name().ok())
        .map(|name| format!("{:#}", rustc_demangle::demangle(name)))
        .filter(|name| name.contains("core::fmt::"))
        .collect();
    if !formats.is_empty() {
        bail!(
            "the core can be brought to format text: {}",
            formats.join(", ")
        );
    }
    let mut cargo = toolchain.firmware_cargo("build");
    cargo.args(["--release", "--features", "indexing", "--bin", "interface"]);
    let output = cargo.output().context("cannot start cargo")?;
    let said = String::from_utf8_lossy(&output.stderr);
    if output.status.success() || !said.contains("deictic_panic_path_reachable") {
        bail!("an index that can panic went unnoticed by the linker: {said}");
    }
    Ok(())
}

fn build_image(
    toolchain: &Toolchain,
    feature: &str,
    image: &str,
    key: Option<&Path>,
) -> Result<PathBuf> {
    let mut cargo = toolchain.firmware_cargo("build");
    match key {
        Some(key) => cargo.env("DEICTIC_KEY", key),
        // What is meant for a board on the desk is not for those that are tried here.
        None => cargo.env_remove("DEICTIC_KEY"),
    };
    cargo.args(["--release", "--features", feature, "--bin", image]);
    cargo.arg("--message-format=json-render-diagnostics");
    let output = cargo
        .stderr(Stdio::inherit())
        .output()
        .context("cannot start cargo")?;
    if !output.status.success() {
        bail!(
            "the image `{image}` does not build, for the reason above; an undefined `deictic_panic_path_reachable` there \
             means that some code in the image can panic"
        );
    }
    String::from_utf8_lossy(&output.stdout)
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .filter(|message| message["target"]["name"] == image)
        .find_map(|message| message["executable"].as_str().map(PathBuf::from))
        .with_context(|| format!("cargo built no executable `{image}`"))
}
