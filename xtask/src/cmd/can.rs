use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail, ensure};
use clap::Args;

use crate::process::{self, cargo, find, root};

/// Try the robot's links on a real CAN interface of Linux.
///
/// Makes a virtual interface where this machine's kernel has CAN; elsewhere boots a Linux of its own (Debian's
/// user-mode-linux, with this machine's files read-only) and makes it there. The tests are those of `robot_can` and
/// `robot_wires`; candump, cansend and slcand are the witnesses.
#[derive(Args)]
pub struct Can {
    /// Commands over every link whose acceptance is timed
    #[arg(long, default_value_t = 500)]
    pub commands: u32,
}

/// The kernel that runs as a program.
pub const KERNEL: &str = "linux.uml";

/// The Debian packages of the kernel and of what is called inside.
pub const PACKAGES: [&str; 5] = [
    "user-mode-linux",
    "can-utils",
    "kmod",
    "iproute2",
    "busybox-static",
];

/// What to say where the tests cannot run.
pub const MISSING: &str = "neither this kernel's CAN nor user-mode-linux can be used: `cargo xtask setup` installs the latter and can-utils";

const TESTS: [&str; 2] = ["robot_can", "robot_wires"];

/// The interface that is made.
const INTERFACE: &str = "vcan0";

/// What the guest says last; the tests' exit code follows.
const VERDICT: &str = "guest: tests ended with ";

impl Can {
    pub fn run(self) -> Result<()> {
        if !is_possible() {
            bail!("{MISSING}");
        }
        let tests = build()?;
        if has_can() {
            self.here(&tests)
        } else {
            self.in_a_guest(&tests)
        }
    }

    fn here(&self, tests: &[PathBuf]) -> Result<()> {
        eprintln!("on this machine's {INTERFACE}");
        for test in tests {
            let mut command = Command::new(test);
            command.args(["--nocapture", "--test-threads", "1"]);
            command.env("DEICTIC_CAN", INTERFACE);
            command.env("DEICTIC_COMMANDS", self.commands.to_string());
            process::run(&mut command)?;
        }
        Ok(())
    }

    /// Boots the guest, whose first program is a script that makes the interface and runs the tests.
    fn in_a_guest(&self, tests: &[PathBuf]) -> Result<()> {
        let folder = process::target().join("can");
        fs::create_dir_all(&folder)?;
        let script = folder.join("init.sh");
        fs::write(&script, self.script(tests))?;
        process::run(Command::new("chmod").arg("+x").arg(&script))?;
        eprintln!("in a Linux of its own, as this kernel has no CAN");
        let output = Command::new("timeout")
            .args([
                "--kill-after=5",
                "300",
                KERNEL,
                "mem=256M",
                "rootfstype=hostfs",
                "rootflags=/",
                "ro",
            ])
            .arg(format!("init={}", script.display()))
            .args(["con=null", "con0=null,fd:1", "quiet"])
            .env("TMPDIR", &folder)
            .stdin(Stdio::null())
            .stderr(Stdio::inherit())
            .output()
            .context("cannot start the guest")?;
        let said = String::from_utf8_lossy(&output.stdout);
        println!("{said}");
        let verdict = said
            .lines()
            .find_map(|line| line.trim().strip_prefix(VERDICT));
        ensure!(
            verdict == Some("0"),
            "the tests failed in the guest, or it never came to an end"
        );
        Ok(())
    }

    fn script(&self, tests: &[PathBuf]) -> String {
        let tests: Vec<String> = tests
            .iter()
            .map(|test| format!("'{}' --nocapture --test-threads 1", test.display()))
            .collect();
        format!(
            "#!/bin/sh
export PATH=/usr/sbin:/usr/bin:/sbin:/bin
mount -t proc none /proc
mkdir -p /dev/pts && mount -t devpts none /dev/pts
mount -t tmpfs none /run
mkdir -p /run/modules/lib && ln -s /usr/lib/uml/modules /run/modules/lib/modules
for module in can can-raw vcan slcan; do modprobe -d /run/modules $module; done
ip link set lo up
ip link add {INTERFACE} type vcan && ip link set {INTERFACE} up
export DEICTIC_CAN={INTERFACE} DEICTIC_COMMANDS={}
cd '{}'
{}
echo '{VERDICT}'$?
busybox poweroff -f
",
            self.commands,
            root().join("host-bridge").display(),
            tests.join(" && ")
        )
    }
}

/// Builds the tests; gives their programs.
fn build() -> Result<Vec<PathBuf>> {
    let mut command = cargo();
    command.args([
        "test",
        "--package",
        "deictic",
        "--no-run",
        "--message-format",
        "json",
    ]);
    for test in TESTS {
        command.args(["--test", test]);
    }
    let output = command.stderr(Stdio::inherit()).output()?;
    ensure!(output.status.success(), "the tests cannot be built");
    let said = String::from_utf8_lossy(&output.stdout);
    let programs = said.lines().filter_map(|line| {
        let (_, rest) = line.split_once("\"executable\":\"")?;
        rest.split_once('"')
            .map(|(path, _)| Path::new(path).to_owned())
    });
    let is_test = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        TESTS.iter().any(|test| name.starts_with(test))
    };
    let programs: Vec<_> = programs.filter(is_test).collect();
    ensure!(
        programs.len() == TESTS.len(),
        "cargo names other tests: {programs:?}"
    );
    Ok(programs)
}

/// Whether the tests can run here, on this kernel or in a guest.
pub fn is_possible() -> bool {
    let tools = ["candump", "cansend", "slcand", "ip"];
    let guest = [KERNEL, "busybox", "modprobe"];
    tools.iter().all(|t| find(t).is_some())
        && (has_can() || guest.iter().all(|t| find(t).is_some()))
}

/// Whether there is such an interface, or one can be made.
fn has_can() -> bool {
    let ip = |arguments: &[&str]| {
        let status = Command::new("ip")
            .args(arguments)
            .stderr(Stdio::null())
            .status();
        status.is_ok_and(|s| s.success())
    };
    let _ = ip(&["link", "add", INTERFACE, "type", "vcan"]);
    ip(&["link", "set", INTERFACE, "up"])
}
