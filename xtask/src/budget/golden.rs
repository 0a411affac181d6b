//! The figures a change may not raise unnoticed.

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};

use crate::board::Board;
use crate::process::root;

/// What an image takes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Figures {
    /// Bytes in flash.
    pub flash_bytes: u64,
    /// Bytes of variables.
    pub ram_bytes: u64,
    /// Most bytes of stack.
    pub stack_bytes: u64,
    /// Bytes in flash that the seal of frames takes, those that are part of other functions not among them.
    #[serde(default)]
    pub seal_flash_bytes: u64,
    /// Instructions of an operation, by its name.
    pub instructions: BTreeMap<String, u64>,
}

impl Figures {
    /// What the project promises at most, whatever the compiler.
    pub fn limits() -> Self {
        Self {
            flash_bytes: 128 * 1024,
            ram_bytes: 24 * 1024,
            stack_bytes: 4 * 1024,
            seal_flash_bytes: 4 * 1024,
            instructions: BTreeMap::from([("hand".to_owned(), 60_000), ("m3".to_owned(), 12_000)]),
        }
    }

    /// Every figure with its name.
    pub fn named(&self) -> impl Iterator<Item = (String, u64)> {
        [
            ("flash_bytes".to_owned(), self.flash_bytes),
            ("ram_bytes".to_owned(), self.ram_bytes),
            ("stack_bytes".to_owned(), self.stack_bytes),
            ("seal_flash_bytes".to_owned(), self.seal_flash_bytes),
        ]
        .into_iter()
        .chain(
            self.instructions
                .iter()
                .map(|(name, count)| (format!("instructions.{name}"), *count)),
        )
    }

    /// The figure of that name.
    pub fn get(&self, name: &str) -> Option<u64> {
        self.named()
            .find_map(|(found, value)| (found == name).then_some(value))
    }
}

/// A board's golden figures under one compiler, as a file in `tests/expected/`.
pub struct Golden {
    path: PathBuf,
}

impl Golden {
    /// The file for a board and a compiler's label.
    pub fn new(board: Board, toolchain: &str) -> Self {
        let name = format!("budget-{}-{toolchain}.json", board.name());
        Self {
            path: root().join("tests/expected").join(name),
        }
    }

    /// The figures; none when this compiler was never recorded.
    pub fn read(&self) -> Result<Option<Figures>> {
        if !self.path.is_file() {
            return Ok(None);
        }
        let text = std::fs::read_to_string(&self.path)?;
        let figures = serde_json::from_str(&text)
            .with_context(|| format!("{} is damaged", self.path.display()))?;
        Ok(Some(figures))
    }

    /// Records figures as the golden ones.
    pub fn write(&self, figures: &Figures) -> Result<()> {
        if let Some(directory) = self.path.parent() {
            std::fs::create_dir_all(directory)?;
        }
        std::fs::write(&self.path, serde_json::to_string_pretty(figures)? + "\n")
            .with_context(|| format!("cannot write {}", self.path.display()))
    }
}
