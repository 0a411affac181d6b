//! The two files that every command works on.

use std::path::PathBuf;

use clap::Args;
use miette::Result;

use super::advice;
use crate::diagnose::FileError;
use crate::language::LanguageError;
use crate::language::pack::Pack;
use crate::robot::Skill;
use crate::scene::{SceneFile, Tabletop};
use crate::vocabulary::{Lexicon, VocabularyProblem};

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
        let lexicon = self.lexicon(scene.as_ref())?;
        let table = match (scene, &self.vocabulary) {
            (Some(scene), _) => scene.tabletop(&lexicon)?,
            (None, None) => SceneFile::table()?.tabletop(&lexicon)?,
            (None, Some(path)) => SceneFile::table()?.tabletop(&lexicon).map_err(|error| {
                let path = path.display();
                advice(
                    format!(
                        "the table that comes with the program is not one of {path}: {}",
                        error.problem()
                    ),
                    "give the table that goes with the vocabulary: --scene FILE",
                )
            })?,
        };
        Ok((lexicon, table))
    }

    /// The vocabulary that is given, that the scene names, or the tabletop's.
    fn lexicon(&self, scene: Option<&SceneFile>) -> Result<Lexicon> {
        let named = scene.and_then(SceneFile::vocabulary);
        let Some(path) = self.vocabulary.as_ref().or(named.as_ref()) else {
            return Ok(Lexicon::tabletop()?);
        };
        let lexicon = match (Lexicon::read(path), scene, &self.vocabulary) {
            (Err(error), Some(scene), None) => match error.problem() {
                VocabularyProblem::Unreadable(cause) => {
                    return Err(scene.without_vocabulary(cause.to_string()).into());
                }
                _ => return Err(error.into()),
            },
            (read, ..) => read?,
        };
        let (name, text) = (path.display().to_string(), || {
            std::fs::read_to_string(path).unwrap_or_default()
        });
        let pack = match Pack::of(&lexicon) {
            Ok(pack) => pack,
            Err(LanguageError::BadPack {
                file,
                place,
                problem,
                ..
            }) => {
                let text = std::fs::read_to_string(&file).unwrap_or_default();
                return Err(FileError::new(&file, &text, place, problem).into());
            }
            Err(error) => {
                let place = lexicon.language_place();
                return Err(FileError::new(&name, &text(), place, error).into());
            }
        };
        match pack.names(&lexicon).and_then(|()| Skill::check(&lexicon)) {
            Ok(()) => Ok(lexicon),
            Err((place, problem)) => {
                Err(FileError::new(&name, &text(), Some(place), problem).into())
            }
        }
    }
}
