use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use crate::robots::{self, Bridge, Link, Wanted};

/// Play the demo on an arm that speaks its own network interface, and compare.
///
/// Installs franka-sim (MuJoCo, about 100 MB from PyPI) beside the other build products, starts it in a network
/// namespace of its own, as it listens on all addresses, and plays the same commands on it and on the simulated arm:
/// the outcomes must be the same. Takes some minutes, as that arm moves in real time. Where PyPI, Python's venv or
/// namespaces are missing it says so and ends well.
#[derive(Args)]
pub struct Fci {
    /// End with an error where it cannot be tried
    #[arg(long)]
    required: bool,
    /// Print one line of JSON, for programs
    #[arg(long)]
    json: bool,
    /// Where franka-sim was installed; set by the command itself inside the network namespace
    #[arg(long, hide = true, requires = "image")]
    inside: Option<PathBuf>,
    /// The unit's image, likewise
    #[arg(long, hide = true)]
    image: Option<PathBuf>,
}

impl Fci {
    pub fn run(self) -> Result<()> {
        if let (Some(place), Some(image)) = (&self.inside, &self.image) {
            return robots::play_in_namespace(place, image);
        }
        let wanted = Wanted {
            json: self.json,
            required: self.required,
        };
        robots::compare(&Bridge::build(None)?, &[Link::Inside, Link::Fci], &wanted)
    }
}
