//! Colours. `anstream` takes them out where the output is no terminal or `NO_COLOR` is set.

use std::fmt::Display;

use owo_colors::OwoColorize;

/// Something that went as it should.
pub fn good(text: impl Display) -> String {
    text.green().bold().to_string()
}

/// Something the person is to look at.
pub fn ask(text: impl Display) -> String {
    text.yellow().bold().to_string()
}

/// Something that did not go.
pub fn bad(text: impl Display) -> String {
    text.red().bold().to_string()
}

/// Something that is there for whoever wants to know.
pub fn dim(text: impl Display) -> String {
    text.dimmed().to_string()
}
