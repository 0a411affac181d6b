use anyhow::{Context, Result};
use clap::Args;

use crate::guest;
use crate::moonshine;
use crate::process::{find, output};
use crate::toolchain::{Toolchain, apt_install};

/// Get what is missing: the target or a compiler that can build it, QEMU, a Linux with CAN, Python's venv.
///
/// Changes nothing when nothing is missing. Installs Debian packages as root or through sudo and says which. The other
/// commands call it themselves.
#[derive(Args)]
pub struct Setup;

impl Setup {
    pub fn run(self) -> Result<()> {
        let toolchain = ensure()?;
        println!("compiler: {toolchain}");
        let qemu = output(std::process::Command::new(QEMU).arg("--version")).unwrap_or_default();
        println!("emulator: {}", qemu.lines().next().unwrap_or("unknown"));
        for_tests();
        match find("defmt-print") {
            Some(path) => println!("board log: decoded by {}", path.display()),
            None => println!(
                "board log: not decoded; optional, `cargo install defmt-print --locked` gets the decoder"
            ),
        }
        match ensure_speech() {
            Ok(()) => println!("speech: pocketsphinx"),
            Err(why) => println!("speech: not here, its tests will be skipped: {why:#}"),
        }
        match moonshine::install() {
            Ok(place) => println!("speech, heard better: Moonshine in {}", place.display()),
            Err(why) => println!("speech, heard better: not here: {why:#}"),
        }
        println!("All set: try `cargo xtask demo`.");
        Ok(())
    }
}

/// The emulator's program.
pub const QEMU: &str = "qemu-system-arm";

/// What every other command needs first. Quick when nothing is missing.
pub fn ensure() -> Result<Toolchain> {
    let toolchain = Toolchain::ensure()?;
    if find(QEMU).is_none() {
        apt_install(&["qemu-system-arm".to_owned()]).context(
            "QEMU for Arm is missing and cannot be installed: install it so that `qemu-system-arm` is on PATH, for \
             example with `apt-get install qemu-system-arm`",
        )?;
    }
    Ok(toolchain)
}

/// Programs that hear, speak and disturb speech, and the packages they are in.
const SPEECH: [(&str, &[&str]); 3] = [
    (
        "pocketsphinx_batch",
        &["pocketsphinx", "pocketsphinx-en-us"],
    ),
    ("espeak-ng", &["espeak-ng"]),
    ("sox", &["sox"]),
];

/// What the tests of speech need; only they do.
pub fn ensure_speech() -> Result<()> {
    let missing = SPEECH.iter().filter(|(program, _)| find(program).is_none());
    let packages: Vec<_> = missing
        .flat_map(|(_, packages)| packages.iter().map(|&p| p.to_owned()))
        .collect();
    if packages.is_empty() {
        return Ok(());
    }
    apt_install(&packages)
}

/// What only `test` and `can` need. What cannot be had is told there too, when its tests are skipped.
pub fn for_tests() {
    let packages = guest::PACKAGES.map(str::to_owned);
    if !guest::is_possible()
        && let Err(error) = apt_install(&packages)
    {
        eprintln!("setup: no CAN bus for the tests: {error:#}");
    }
    if !has_venv()
        && let Err(error) = apt_install(&["python3-venv".to_owned()])
    {
        eprintln!("setup: no Python for the tests: {error:#}");
    }
}

fn has_venv() -> bool {
    output(std::process::Command::new("python3").args(["-c", "import venv, ensurepip"])).is_some()
}
