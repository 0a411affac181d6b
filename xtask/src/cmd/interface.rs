use anyhow::Result;
use clap::Args;

use crate::board;
use crate::cmd::setup;

/// See that nothing in the core's whole public interface can panic or format text.
///
/// Links an image that calls all of it, for which no panic may be reachable, looks for formatting in it, and sees that one
/// added index that can panic keeps it from linking.
#[derive(Args)]
pub struct Interface;

impl Interface {
    pub fn run(self) -> Result<()> {
        board::check_interface(&setup::ensure()?)?;
        println!(
            "no panic and no formatting can be reached in the core, and an x[i] was found out"
        );
        Ok(())
    }
}
