use std::process::Command;

use anyhow::{Context, Result, ensure};
use clap::Args;

use crate::board::{self, Board};
use crate::cmd::{budget::Budget, can::Can, growth::Growth, key, setup};
use crate::guest;
use crate::moonshine;
use crate::process::{self, cargo};
use crate::python;
use crate::qemu::{self, Link};
use crate::robots::{self, Bridge, Wanted};
use crate::toolchain::Toolchain;

/// Check everything: formatting, lints, all tests, both images, budgets.
#[derive(Args)]
pub struct Test;

impl Test {
    pub fn run(self) -> Result<()> {
        let toolchain = setup::ensure()?;
        if let Err(why) = setup::ensure_speech() {
            eprintln!("tests of speech will be skipped: {why:#}");
        }
        setup::for_tests();
        for (title, mut command) in lints(&toolchain) {
            step(&title);
            process::run(&mut command)?;
        }
        let mut tests = cargo();
        tests.args(["test", "--workspace"]);
        for board in Board::ALL {
            step(&format!("image for {} on a CAN bus", board.name()));
            let image = board::build_on_can(&toolchain, board)?;
            eprintln!("{}", image.display());
            tests.env(format!("{}_CAN", board.image_variable()), image);
            step(&format!("image for {}", board.name()));
            let image = board::build(&toolchain, board)?;
            eprintln!("{}", image.display());
            tests.env(board.image_variable(), image);
        }
        step("image with a key");
        let key = key::for_trials()?;
        let keyed = board::build_keyed(&toolchain, Board::Mps2An386, &key)?;
        tests.env("DEICTIC_IMAGE_MPS2_AN386_KEYED", keyed);
        tests.env("DEICTIC_IMAGE_KEY", key);
        step("image in a hurry");
        tests.env("DEICTIC_IMAGE_HASTY", board::build_hasty(&toolchain)?);
        match python::with_can() {
            Ok(python) => {
                tests.env("DEICTIC_PYTHON", python);
            }
            Err(error) => {
                eprintln!("no python-can and cantools, so their test is skipped: {error:#}")
            }
        }
        match moonshine::install() {
            Ok(place) => {
                tests.env(moonshine::VARIABLE, place);
            }
            Err(why) => eprintln!("no Moonshine, so its tests are skipped: {why:#}"),
        }
        step("tests");
        process::run(&mut tests)?;
        step("the board decides bit for bit as the host");
        trial(&toolchain, "bits", true)?;
        step("a stack that grows too far stops the board");
        trial(&toolchain, "faults", false)?;
        step("nothing in the core can panic or format text");
        board::check_interface(&toolchain)?;
        step("the robot's links on a CAN bus");
        if guest::is_possible() {
            Can.run()?;
            step("the demo on a CAN bus, decided by the emulated board");
            let image = board::build(&toolchain, Board::Mps2An386)?;
            let wanted = Wanted {
                json: false,
                required: true,
            };
            let links = [robots::Link::Inside, robots::Link::Can];
            robots::compare(&Bridge::build(Some(image))?, &links, &wanted)?;
        } else {
            eprintln!("skipped: {}", guest::MISSING);
        }
        step("the cost of a decision grows in straight lines");
        Growth::check(&toolchain)?;
        step("budgets");
        Budget::check(&toolchain)
    }
}

/// Runs an image that tries something on the board in QEMU, which must end well or, where it is to fail, end with a
/// failure after having logged why.
fn trial(toolchain: &Toolchain, name: &str, ends_well: bool) -> Result<()> {
    let image = board::build_trial(toolchain, name)?;
    let output = qemu::command(&image, &Link::Null)
        .output()
        .context("cannot start QEMU")?;
    let as_expected = output.status.success() == ends_well && !output.stdout.is_empty();
    ensure!(
        as_expected,
        "the image `{name}` ended with {} on the board: {}{}",
        output.status,
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
    Ok(())
}

fn step(title: &str) {
    eprintln!("\n== {title}");
}

/// Formatting and lints, where this machine has them: they belong to rustup's toolchain.
fn lints(toolchain: &Toolchain) -> Vec<(String, Command)> {
    let host = |title: &str, arguments: &[&str]| {
        let mut command = cargo();
        command.args(arguments);
        (title.to_owned(), command)
    };
    let mut steps = Vec::new();
    if process::find("cargo-fmt").is_some() {
        steps.push(host("formatting", &["fmt", "--all", "--check"]));
    }
    if process::find("cargo-clippy").is_some() {
        steps.push(host(
            "lints",
            &[
                "clippy",
                "--workspace",
                "--all-targets",
                "--",
                "-D",
                "warnings",
            ],
        ));
    }
    let mut docs = host("docs", &["doc", "--workspace", "--no-deps", "--quiet"]);
    docs.1.env("RUSTDOCFLAGS", "-D warnings");
    steps.push(docs);
    if toolchain.has_clippy() {
        for feature in [
            "mps2-an386",
            "mps2-an386,can",
            "bench",
            "nucleo-g474re",
            "nucleo-g474re,can",
        ] {
            let mut command = toolchain.firmware_cargo("clippy");
            command.args(["--release", "--features", feature, "--", "-D", "warnings"]);
            steps.push((format!("lints of the firmware, {feature}"), command));
        }
    }
    steps
}
