use std::net::TcpListener;
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::board::{self, Board};
use crate::cmd::setup;
use crate::process::find;
use crate::qemu::{self, Link};

/// Boot the unit in QEMU and say how to connect.
///
/// Runs until Ctrl-C. The board's log is decoded where `defmt-print` is installed.
#[derive(Args)]
pub struct Qemu {
    /// Port of the host link on 127.0.0.1; 0 takes a free one
    #[arg(long, default_value_t = 7700)]
    port: u16,
}

impl Qemu {
    pub fn run(self) -> Result<()> {
        let toolchain = setup::ensure()?;
        let image = board::build(&toolchain, Board::Mps2An386)?;
        let port = free_port(self.port)?;
        let decoder = find("defmt-print");

        let mut command = qemu::command(&image, &Link::Tcp(port));
        command.stdout(if decoder.is_some() {
            Stdio::piped()
        } else {
            Stdio::null()
        });
        let mut qemu = command.spawn().context("cannot start QEMU")?;
        println!(
            "The gesture unit runs. Connect with:\n  cargo run -p deictic -- run --board tcp:127.0.0.1:{port}"
        );
        if let Some(decoder) = decoder {
            let frames = qemu.stdout.take().context("QEMU has no output")?;
            Command::new(decoder)
                .arg("-e")
                .arg(&image)
                .arg("stdin")
                .stdin(frames)
                .spawn()?;
        } else {
            println!(
                "Its log is not shown: `cargo install defmt-print --locked` gets the decoder."
            );
        }
        println!("Ctrl-C ends it.");
        let status = qemu.wait()?;
        if !status.success() {
            bail!("the board stopped with a fault ({status}); its log says where");
        }
        Ok(())
    }
}

/// Checks that nobody listens on `port`, or finds one where nobody does.
fn free_port(port: u16) -> Result<u16> {
    let listener = TcpListener::bind(("127.0.0.1", port))
        .with_context(|| format!("port {port} is taken; `--port 0` takes a free one"))?;
    Ok(listener.local_addr()?.port())
}
