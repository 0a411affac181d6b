//! The two files that every command works on.

use std::path::PathBuf;

use clap::Args;
use miette::Result;

use crate::scene::{SceneFile, Tabletop};
use crate::vocabulary::Lexicon;

/// Which vocabulary and which scene.
#[derive(Args, Clone, Debug, Default)]
pub struct Files {
    /// What can be said and shown (TOML); without it the one the scene names, or the tabletop's
    #[arg(long, value_name = "FILE")]
    pub vocabulary: Option<PathBuf>,
    /// What is on the table (TOML); without it the table that comes with the program
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
}

impl Files {
    /// Reads both.
    pub fn read(&self) -> Result<(Lexicon, Tabletop)> {
        let scene = match &self.scene {
            Some(path) => Some(SceneFile::read(path)?),
            None => None,
        };
        let named = self
            .vocabulary
            .clone()
            .or_else(|| scene.as_ref().and_then(SceneFile::vocabulary));
        let lexicon = match named {
            Some(path) => Lexicon::read(&path)?,
            None => Lexicon::tabletop()?,
        };
        let scene = match scene {
            Some(scene) => scene,
            None => SceneFile::table()?,
        };
        let table = scene.tabletop(&lexicon)?;
        Ok((lexicon, table))
    }
}
