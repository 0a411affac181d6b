use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;

use crate::board::{self, Board};
use crate::cmd::setup;
use crate::process::{self, cargo};
use crate::robots::{self, Bridge, Link, Wanted};

/// Play a tabletop session on the unit in QEMU, with a simulated Panda.
///
/// Sets up what is missing, builds the unit's image and the bridge, boots the board, and plays: what was said and
/// shown, what the board decided and why, what the robot did.
#[derive(Args)]
pub struct Demo {
    /// Play published table set-ups instead: each command aligned and contradicting, 2,000 decisions
    #[arg(long, value_name = "FILE")]
    setups: Option<PathBuf>,
    /// Play it on a robot behind each of its links instead, and compare: one table. Takes some minutes
    #[arg(long, conflicts_with = "setups")]
    robots: bool,
    /// Only over these links: inside, tcp, serial:pty, slcan:pty, can:vcan0, fci:127.0.0.1
    #[arg(long, requires = "robots", value_delimiter = ',', value_parser = link)]
    over: Vec<Link>,
    /// A link that cannot be tried on this machine is an error
    #[arg(long, requires = "robots")]
    required: bool,
    /// Print JSON, for programs
    #[arg(long)]
    json: bool,
    /// Anything else goes to `deictic play`, or to `deictic setups`
    #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
    rest: Vec<String>,
}

impl Demo {
    pub fn run(self) -> Result<()> {
        let toolchain = setup::ensure()?;
        let image = board::build(&toolchain, Board::Mps2An386)?;
        if self.robots {
            let wanted = Wanted {
                json: self.json,
                required: self.required,
            };
            let links = match &self.over[..] {
                [] => &Link::ALL[..],
                some => some,
            };
            return robots::compare(&Bridge::build(Some(image))?, links, &wanted);
        }
        let mut bridge = cargo();
        bridge.args(["run", "--quiet", "--package", "deictic", "--"]);
        match &self.setups {
            Some(file) => {
                // The bridge runs in the project's root, where a relative path would mean another file.
                let file = file
                    .canonicalize()
                    .with_context(|| format!("cannot find {}", file.display()))?;
                bridge.arg("setups").arg(file);
            }
            None => {
                bridge.arg("play");
            }
        }
        bridge.args(["--board", "qemu"]).args(&self.rest);
        bridge.args(self.json.then_some("--json"));
        bridge.env(Board::Mps2An386.image_variable(), image);
        eprintln!("building the bridge, which takes some minutes the first time");
        process::run(&mut bridge)
    }
}

fn link(name: &str) -> Result<Link, String> {
    Link::named(name).ok_or_else(|| format!("`{name}` is none of the links"))
}
