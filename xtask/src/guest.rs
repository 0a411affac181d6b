//! A Linux that has CAN: this machine's where its kernel has it, else Debian's user-mode-linux, which is a program and
//! sees this machine's files read-only.

use std::fs;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use crate::process::{self, find, root};

/// The kernel that runs as a program.
const KERNEL: &str = "linux.uml";

/// The Debian packages of the kernel and of what is called inside.
pub const PACKAGES: [&str; 5] = [
    "user-mode-linux",
    "can-utils",
    "kmod",
    "iproute2",
    "busybox-static",
];

/// What to say where there is none.
pub const MISSING: &str = "neither this kernel's CAN nor user-mode-linux can be used: `cargo xtask setup` installs the latter and can-utils";

/// The interface that is made.
pub const INTERFACE: &str = "vcan0";

/// What the guest says last; the exit code of what was run in it follows.
const VERDICT: &str = "guest: ended with ";

/// Whether there can be a CAN interface, on this kernel or in a guest.
pub fn is_possible() -> bool {
    let tools = ["candump", "cansend", "slcand", "ip"];
    let guest = [KERNEL, "busybox", "modprobe"];
    tools.iter().all(|t| find(t).is_some())
        && (has_can() || guest.iter().all(|t| find(t).is_some()))
}

/// Whether this machine has the interface, or it can be made.
pub fn has_can() -> bool {
    let ip = |arguments: &[&str]| {
        let status = Command::new("ip")
            .args(arguments)
            .stderr(Stdio::null())
            .status();
        status.is_ok_and(|s| s.success())
    };
    // With frames of CAN FD; that cannot be set while it is up.
    if ip(&["link", "add", INTERFACE, "type", "vcan"]) {
        let _ = ip(&["link", "set", INTERFACE, "mtu", "72"]);
    }
    ip(&["link", "set", INTERFACE, "up"])
}

/// Boots a guest that makes the interface and runs these lines of shell; gives what was printed. `serial` is a
/// terminal of this machine that is the guest's /dev/ttyS0.
///
/// # Errors
/// When the last of the lines fails, or the guest does not come to an end in `seconds`.
pub fn run(lines: &str, serial: Option<&str>, seconds: u32) -> Result<String> {
    let folder = process::target().join("can");
    fs::create_dir_all(&folder)?;
    let script = folder.join(format!("init-{}.sh", std::process::id()));
    fs::write(&script, first_program(lines))?;
    process::run(Command::new("chmod").arg("+x").arg(&script))?;
    let output = Command::new("timeout")
        .args(["--kill-after=5", &seconds.to_string(), KERNEL, "mem=256M"])
        .args(["rootfstype=hostfs", "rootflags=/", "ro"])
        .arg(format!("init={}", script.display()))
        .args(["con=null", "con0=null,fd:1", "quiet"])
        .args(serial.map(|terminal| format!("ssl0=tty:{terminal}")))
        .env("TMPDIR", &folder)
        .stdin(Stdio::null())
        .stderr(Stdio::inherit())
        .output()
        .context("cannot start the guest")?;
    let _ = fs::remove_file(&script);
    let said = String::from_utf8_lossy(&output.stdout).replace('\r', "");
    let verdict = said.lines().find_map(|l| l.trim().strip_prefix(VERDICT));
    ensure!(
        verdict == Some("0"),
        "what ran in the guest failed, or never came to an end:\n{said}"
    );
    Ok(said)
}

fn first_program(lines: &str) -> String {
    format!(
        "#!/bin/sh
export PATH=/usr/sbin:/usr/bin:/sbin:/bin
export TMPDIR=/run
mount -t proc none /proc
mkdir -p /dev/pts && mount -t devpts none /dev/pts
mount -t tmpfs none /run
mkdir -p /run/modules/lib && ln -s /usr/lib/uml/modules /run/modules/lib/modules
for module in can can-raw vcan slcan; do modprobe -d /run/modules $module; done
ip link set lo up
ip link add {INTERFACE} mtu 72 type vcan && ip link set {INTERFACE} up
cd '{}'
{lines}
echo '{VERDICT}'$?
busybox poweroff -f
",
        root().join("host-bridge").display(),
    )
}
