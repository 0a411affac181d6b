//! Which compiler builds the firmware.
//!
//! rustup's pinned toolchain where it has the target or can download it; else Debian's own compiler (packages
//! `rustc-web`, `cargo-web`, `rust-web-src`), which builds `core` for the target from source. `DEICTIC_TOOLCHAIN=rustup`
//! or `=debian` forces one. [`Toolchain::ensure`] is quick when nothing is missing.

use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::process::{self, find, output, root};

/// The firmware's target.
pub const TARGET: &str = "thumbv7em-none-eabihf";

/// The oldest compiler that builds the workspace (`rust-version` in Cargo.toml), as (major, minor).
const OLDEST: (u32, u32) = (1, 95);

/// Debian's compiler, wherever PATH leads.
const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_CARGO: &str = "/usr/bin/cargo";

/// A compiler that can build the firmware.
#[derive(Clone, Debug)]
pub struct Toolchain {
    route: Route,
    /// rustc's version, as "1.95.0".
    version: String,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Route {
    /// The compiler on PATH, which has the target.
    Rustup,
    /// Debian's, with `core` built from source and this linker.
    Debian { linker: PathBuf },
}

impl fmt::Display for Toolchain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.route {
            Route::Rustup => write!(f, "rustc {} with the target {TARGET}", self.version),
            Route::Debian { .. } => write!(
                f,
                "Debian's rustc {}, which builds core for {TARGET} from source",
                self.version
            ),
        }
    }
}

impl Toolchain {
    /// Finds a compiler or gets one.
    pub fn ensure() -> Result<Self> {
        match std::env::var("DEICTIC_TOOLCHAIN").as_deref() {
            Ok("rustup") => present().or_else(add_target).context(
                "DEICTIC_TOOLCHAIN=rustup, but the compiler on PATH lacks the target and rustup cannot add it; unset \
                 the variable to use Debian's compiler, or run `rustup target add thumbv7em-none-eabihf` where \
                 downloads work",
            ),
            Ok("debian") => debian(),
            Ok(other) => bail!("DEICTIC_TOOLCHAIN={other}: it is either `rustup` or `debian`"),
            // What is there comes before what would have to be fetched.
            Err(_) => match present()
                .or_else(|| complete_debian(&mut Vec::new()))
                .or_else(add_target)
            {
                Some(toolchain) => Ok(toolchain),
                None => debian(),
            },
        }
    }

    /// Names the compiler in the golden figures' file name.
    pub fn label(&self) -> String {
        match self.route {
            Route::Rustup => format!("rustc-{}", self.version),
            Route::Debian { .. } => format!("rustc-{}-debian", self.version),
        }
    }

    /// Clippy checks the firmware too; Debian's compiler comes without it.
    pub fn has_clippy(&self) -> bool {
        self.route == Route::Rustup && find("cargo-clippy").is_some()
    }

    /// `cargo SUBCOMMAND` in `firmware/`, whose .cargo/config.toml fixes target and profile.
    pub fn firmware_cargo(&self, subcommand: &str) -> Command {
        let mut cargo = match &self.route {
            Route::Rustup => process::cargo(),
            Route::Debian { .. } => Command::new(DEBIAN_CARGO),
        };
        cargo.current_dir(root().join("firmware")).arg(subcommand);
        // The flags of the host's build, and what cargo and rustup told this program about it.
        for variable in [
            "RUSTFLAGS",
            "CARGO_ENCODED_RUSTFLAGS",
            "CARGO_BUILD_RUSTFLAGS",
            "CARGO_BUILD_TARGET",
            "LD_LIBRARY_PATH",
        ] {
            cargo.env_remove(variable);
        }
        if let Route::Debian { linker } = &self.route {
            cargo
                .arg("-Zbuild-std=core")
                .env("RUSTC_BOOTSTRAP", "1")
                .env("RUSTC", DEBIAN_RUSTC)
                .env("CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER", linker)
                .env_remove("RUSTC_WRAPPER");
        }
        cargo
    }
}

/// The compiler on PATH, if it has the target.
fn present() -> Option<Toolchain> {
    let sysroot = output(rustc("rustc").args(["--print", "sysroot"]))?;
    let libraries = Path::new(sysroot.trim()).join("lib/rustlib").join(TARGET);
    libraries.join("lib").is_dir().then_some(())?;
    Some(Toolchain {
        route: Route::Rustup,
        version: version("rustc")?.release,
    })
}

/// The compiler on PATH after rustup has added the target, if it can.
fn add_target() -> Option<Toolchain> {
    find("rustup")?;
    eprintln!("setup: adding the target {TARGET} with rustup");
    let added = process::run(
        Command::new("rustup")
            .args(["target", "add", TARGET])
            .env("RUST_BACKTRACE", "0")
            .current_dir(root()),
    );
    let toolchain = added.ok().and_then(|()| present());
    if toolchain.is_none() {
        eprintln!("setup: rustup cannot add it");
    }
    toolchain
}

/// Debian's compiler, installed if it is missing.
fn debian() -> Result<Toolchain> {
    // The linker's version is known once the compiler is there, so there may be two rounds.
    for _ in 0..3 {
        let mut missing = Vec::new();
        if let Some(toolchain) = complete_debian(&mut missing) {
            return Ok(toolchain);
        }
        apt_install(&missing).with_context(|| {
            format!(
                "no compiler for {TARGET}: rustup cannot add the target and Debian's packages {} cannot be installed. \
                 Either makes `cargo xtask setup` succeed: `rustup target add {TARGET}` on a machine that can \
                 download, or `apt-get install {}` on Debian 12 or later",
                missing.join(", "),
                missing.join(" ")
            )
        })?;
    }
    bail!(
        "Debian's compiler is installed but still not usable: `{DEBIAN_RUSTC} -vV` must say {}.{} or later",
        OLDEST.0,
        OLDEST.1
    )
}

/// Debian's compiler if all of it is there; else adds the packages that are missing to `missing`.
fn complete_debian(missing: &mut Vec<String>) -> Option<Toolchain> {
    let version = version(DEBIAN_RUSTC).filter(|version| version.number() >= OLDEST);
    let source = Path::new("/usr/lib/rustlib/src/rust/library/core/Cargo.toml").is_file();
    if version.is_none() || !source || !Path::new(DEBIAN_CARGO).is_file() {
        missing.extend(["rustc-web", "cargo-web", "rust-web-src"].map(String::from));
    }
    let version = version?;
    // An older linker than the compiler's LLVM keeps code that nothing calls, defmt's default panic among it.
    let linker = PathBuf::from(format!("/usr/bin/ld.lld-{}", version.llvm));
    if !linker.is_file() {
        missing.push(format!("lld-{}", version.llvm));
    }
    missing.is_empty().then_some(Toolchain {
        route: Route::Debian { linker },
        version: version.release,
    })
}

/// Installs packages, as root or through sudo.
pub fn apt_install(packages: &[String]) -> Result<()> {
    if find("apt-get").is_none() {
        bail!("there is no apt-get here");
    }
    let root = output(Command::new("id").arg("-u")).is_some_and(|id| id.trim() == "0");
    if !root && find("sudo").is_none() {
        bail!("installing needs root or sudo");
    }
    let apt = |arguments: &[&str]| {
        let mut command = Command::new(if root { "apt-get" } else { "sudo" });
        if !root {
            command.args(["DEBIAN_FRONTEND=noninteractive", "apt-get"]);
        }
        command
            .args(["-qq", "-o", "Dpkg::Use-Pty=0"])
            .args(arguments)
            .env("DEBIAN_FRONTEND", "noninteractive");
        command
    };
    eprintln!(
        "setup: apt-get install {}{}",
        packages.join(" "),
        if root { "" } else { " (through sudo)" }
    );
    // A stale package list is no reason to fail when the list that is there has the packages.
    let _updated = process::run(&mut apt(&["update"]));
    let mut install = apt(&["install", "-y", "--no-install-recommends"]);
    process::run(install.args(packages))
}

fn rustc(program: &str) -> Command {
    let mut command = Command::new(program);
    command.current_dir(root()).env_remove("LD_LIBRARY_PATH");
    command
}

/// What `rustc -vV` says.
struct Version {
    /// "1.95.0"
    release: String,
    /// Major version of its LLVM.
    llvm: u32,
}

impl Version {
    fn number(&self) -> (u32, u32) {
        let mut parts = self
            .release
            .split('.')
            .map(|part| part.parse().unwrap_or(0));
        (parts.next().unwrap_or(0), parts.next().unwrap_or(0))
    }
}

fn version(program: &str) -> Option<Version> {
    parse_version(&output(rustc(program).arg("-vV"))?)
}

fn parse_version(text: &str) -> Option<Version> {
    let field = |name: &str| {
        text.lines()
            .find_map(|line| line.strip_prefix(name))
            .map(str::trim)
    };
    Some(Version {
        release: field("release:")?.to_owned(),
        llvm: field("LLVM version:")?.split('.').next()?.parse().ok()?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_rustc_says_of_itself() {
        let text = "rustc 1.96.0 (built from a source tarball)\nbinary: rustc\nhost: x86_64-unknown-linux-gnu\n\
                    release: 1.96.0\nLLVM version: 22.1.8\n";
        let version = parse_version(text).expect("a complete answer");
        assert_eq!(version.release, "1.96.0");
        assert_eq!(version.llvm, 22);
        assert!(version.number() >= OLDEST);
        assert!(parse_version("rustc 1.96.0\n").is_none());
    }
}
