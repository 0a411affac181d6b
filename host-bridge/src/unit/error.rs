//! Why a conversation with a unit cannot be.

use deictic_core::protocol::message::Fault;

use crate::link::WireError;

/// A conversation could not be opened.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
pub enum UnitError {
    /// The wire could not be opened.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Wire(#[from] WireError),
    /// The wire failed.
    #[error("the link to the unit failed")]
    #[diagnostic(help(
        "look at the cable and the board's power; the bridge connects again by itself once it runs"
    ))]
    Broken(#[source] std::io::Error),
    /// The unit did not answer.
    #[error("nothing that speaks our protocol answers")]
    #[diagnostic(help(
        "does the board run the unit's firmware, and is it the right port and speed?"
    ))]
    NoAnswer,
    /// The unit speaks another version of the protocol.
    #[error(
        "the unit speaks version {} of the protocol (schema {:#010x}), this bridge version {} (schema {:#010x})",
        .unit.0, .unit.1, .host.0, .host.1
    )]
    #[diagnostic(help(
        "flash the firmware that belongs to this bridge: `cargo run --release` in firmware/, or use the bridge \
         that belongs to the firmware"
    ))]
    Schema {
        /// The unit's version and schema.
        unit: (u16, u32),
        /// This bridge's.
        host: (u16, u32),
    },
    /// There is a key here, and the unit does not ask for one.
    #[error("the unit has no key, and this bridge does")]
    #[diagnostic(help(
        "anybody on the line could speak for such a unit: flash it with the key (`DEICTIC_KEY=FILE cargo run --release` in \
         firmware/), or leave --key out"
    ))]
    NoKey,
    /// The unit asks for a key, and there is none here.
    #[error("the unit wants to see a key")]
    #[diagnostic(help("give the file that it was flashed with: --key FILE"))]
    WantsKey,
    /// The unit does not show that it has the same key.
    #[error("the unit has another key")]
    #[diagnostic(help(
        "is it the board that this key was made for? Flash it anew with `DEICTIC_KEY=FILE`, or give its own --key FILE"
    ))]
    OtherKey,
    /// The vocabulary or scene is larger than the unit can hold.
    #[error("the unit holds {capacity} {what}, and there are {wanted}")]
    #[diagnostic(help(
        "leave some out, or flash a unit built with larger capacities (core/src/capacity.rs)"
    ))]
    TooLarge {
        /// Of what there is too much.
        what: &'static str,
        /// How many the unit holds.
        capacity: u16,
        /// How many there are.
        wanted: usize,
    },
    /// The unit refused what it was told.
    #[error("the unit refuses what it was told: {}", crate::explain::fault(.0).what)]
    #[diagnostic(help("{}", crate::explain::fault(.0).remedy))]
    Refused(Fault),
}

impl UnitError {
    /// It and its causes in one line.
    pub(super) fn in_full(&self) -> String {
        crate::diagnose::in_full(self)
    }
}
