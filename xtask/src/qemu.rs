//! The command line that boots an image in QEMU.
//!
//! ```text
//! qemu-system-arm -M mps2-an386 -kernel IMAGE -display none -monitor none
//!   -chardev stdio,id=log -semihosting-config enable=on,target=native,chardev=log
//!   -serial tcp:127.0.0.1:PORT,server=on,wait=off,nodelay=on     UART0, the host link
//!   -serial null                                                 UART1, not used
//!   -serial null                                                 UART2, the hand sensor
//!   [-icount shift=10]                                           1 instruction = 1024 ns of the board's time
//! ```

use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use crate::cmd::setup::QEMU;

/// Where UART0, the host link, goes.
pub enum Link {
    /// Listens on this port of the loopback interface, one host at a time, as often as one comes.
    Tcp(u16),
    /// A pseudo-terminal, which QEMU names on stdout.
    Terminal,
    /// Nowhere.
    Null,
}

/// QEMU with an image, its log or text on stdout. Ends by itself only when the image ends it.
pub fn command(image: &Path, link: &Link) -> Command {
    let mut qemu = Command::new(QEMU);
    qemu.args(["-M", "mps2-an386", "-display", "none", "-monitor", "none"])
        .args(["-chardev", "stdio,id=log,signal=off"])
        .args(["-semihosting-config", "enable=on,target=native,chardev=log"])
        .arg("-kernel")
        .arg(image);
    let link = match link {
        Link::Tcp(port) => format!("tcp:127.0.0.1:{port},server=on,wait=off,nodelay=on"),
        Link::Terminal => "pty".to_owned(),
        Link::Null => "null".to_owned(),
    };
    qemu.args(["-serial", &link, "-serial", "null", "-serial", "null"]);
    qemu.stdin(Stdio::null());
    qemu
}

/// Boots a measuring image and gives the lines it says. The board's clock counts instructions: 1024 ns each, so 25.6
/// ticks of its 25 MHz SysTick.
pub fn measured(image: &Path) -> Result<Vec<String>> {
    let output = command(image, &Link::Null)
        .args(["-icount", "shift=10"])
        .output()
        .context("cannot start QEMU")?;
    let said = String::from_utf8_lossy(&output.stdout);
    ensure!(
        output.status.success(),
        "the measuring image did not end well ({}): {said}{}",
        output.status,
        String::from_utf8_lossy(&output.stderr)
    );
    Ok(said.lines().map(str::to_owned).collect())
}
