//! A scene file that is read again whenever it changes.
//!
//! It is looked at five times a second instead of asking the system to tell: editors replace files instead
//! of writing them, and network and container file systems tell nothing, so whoever asks has to look anyway.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

use deictic_core::large;

use super::file::{SceneFile, SceneFileError};
use crate::clock;
use crate::vocabulary::Lexicon;

/// How often the file is looked at.
const EVERY: Duration = Duration::from_millis(200);

/// What tells a file from what it was.
type Mark = Option<(SystemTime, u64)>;

/// A watched scene file.
#[derive(Debug)]
pub struct Watch {
    path: PathBuf,
    mark: Mark,
    /// What was seen last, and not yet twice: a file that is being written changes at every look.
    fresh: Mark,
    looked: Instant,
}

fn mark(path: &Path) -> Mark {
    let about = std::fs::metadata(path).ok()?;
    Some((about.modified().ok()?, about.len()))
}

impl Watch {
    /// Watches a file from now on.
    #[must_use]
    pub fn new(path: &Path) -> Self {
        let mark = mark(path);
        Self {
            path: path.to_owned(),
            mark,
            fresh: mark,
            looked: clock::now(),
        }
    }

    /// The things of the file when it has changed and has been left alone since the last look.
    ///
    /// # Errors
    /// [`SceneFileError`] when what it says now is no scene; it is then told once.
    pub fn look(
        &mut self,
        lexicon: &Lexicon,
    ) -> Result<Option<Vec<large::Entity>>, SceneFileError> {
        if clock::since(self.looked) < EVERY {
            return Ok(None);
        }
        self.looked = clock::now();
        let now = mark(&self.path);
        let still = now == self.fresh;
        self.fresh = now;
        // A file that is gone for a moment is about to be replaced.
        if now == self.mark || !still || now.is_none() {
            return Ok(None);
        }
        self.mark = now;
        SceneFile::read(&self.path)?.things(lexicon).map(Some)
    }
}
