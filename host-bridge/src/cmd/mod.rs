//! The commands, one file each.

mod aiming;
mod conversation;
pub mod decide;
mod ears;
mod files;
pub mod gestures;
pub mod hand;
mod interrupts;
mod json;
mod lines;
mod log;
mod paint;
mod pictures;
pub mod play;
mod printer;
mod profile;
pub mod robot_sim;
pub mod run;
pub mod scene;
mod scenes;
mod sensing;
pub mod setups;
mod trust;
pub mod understand;

use miette::Report;

/// So many of something: "1 movement", "2 movements".
fn counted(count: usize, what: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {what}{ending}")
}

/// How many times as fast as a careful arm a simulated one moves.
fn haste(text: &str) -> Result<f32, String> {
    match text.parse() {
        Ok(haste) if (0.01..=1e6).contains(&haste) => Ok(haste),
        _ => Err("it is a number of 0.01 to 1000000; 1 is a careful arm".into()),
    }
}

/// An error in words with what to do about it.
fn advice(what: impl std::fmt::Display, remedy: impl std::fmt::Display) -> Report {
    miette::miette!(help = remedy.to_string(), "{what}")
}
