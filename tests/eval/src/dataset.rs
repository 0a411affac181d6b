//! Reading data sets: one JSON object per line, gzip or plain (the format of the reference's
//! exported sets, `i, objects, storages, gesture, language, truth, feas`; the last is not read, as
//! what is feasible follows from the rest).

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;
use thiserror::Error;

use crate::catalogue::{Catalogue, CatalogueError};
use crate::record::Record;

mod line;
pub mod write;

pub use line::Fault;

/// A named list of samples.
#[derive(Clone, Debug)]
pub struct Set {
    /// The file's name without its endings.
    pub name: String,
    /// Its samples.
    pub records: Vec<Record>,
}

/// Why a data set was refused.
#[derive(Debug, Error)]
pub enum DatasetError {
    /// The vocabulary beside the sets is wrong.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// The folder or file cannot be opened.
    #[error("{}: {cause}", file.display())]
    Open {
        /// Its path.
        file: PathBuf,
        /// The system's reason.
        cause: std::io::Error,
    },
    /// The folder has no sets.
    #[error("{}: no files ending in .jsonl or .jsonl.gz", folder.display())]
    NoSets {
        /// Its path.
        folder: PathBuf,
    },
    /// The file has no samples.
    #[error("{}: holds no samples, so there is nothing to score; was it cut short?", file.display())]
    Empty {
        /// Its path.
        file: PathBuf,
    },
    /// The file ends or breaks in the middle of a line.
    #[error("{}, line {line}: cannot be read further: {cause}", file.display())]
    Truncated {
        /// Its path.
        file: PathBuf,
        /// The line that could not be read, from 1.
        line: usize,
        /// The system's reason.
        cause: std::io::Error,
    },
    /// A line says something that cannot be.
    #[error("{}, line {line}: {fault}", file.display())]
    Line {
        /// Its path.
        file: PathBuf,
        /// Its number, from 1.
        line: usize,
        /// What is wrong.
        fault: Fault,
    },
}

/// Reads the `vocab.json` of a folder and all sets in it, by name.
///
/// # Errors
/// [`DatasetError`] with file, line and reason.
pub fn read_folder(folder: &Path) -> Result<(Catalogue, Vec<Set>), DatasetError> {
    let catalogue = Catalogue::read_json(&folder.join("vocab.json"))?;
    let mut sets = Vec::new();
    for file in files(folder)? {
        sets.push(read(&file, &catalogue)?);
    }
    Ok((catalogue, sets))
}

/// The sets in a folder, by name.
///
/// # Errors
/// [`DatasetError::Open`] and [`DatasetError::NoSets`].
pub fn files(folder: &Path) -> Result<Vec<PathBuf>, DatasetError> {
    let open = |cause| DatasetError::Open {
        file: folder.to_owned(),
        cause,
    };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(open)? {
        let path = entry.map_err(open)?.path();
        let name = path.to_string_lossy();
        if name.ends_with(".jsonl") || name.ends_with(".jsonl.gz") {
            files.push(path);
        }
    }
    if files.is_empty() {
        return Err(DatasetError::NoSets {
            folder: folder.to_owned(),
        });
    }
    files.sort();
    Ok(files)
}

/// Reads one set.
///
/// # Errors
/// [`DatasetError`] with file, line and reason.
pub fn read(path: &Path, catalogue: &Catalogue) -> Result<Set, DatasetError> {
    let file = File::open(path).map_err(|cause| DatasetError::Open {
        file: path.to_owned(),
        cause,
    })?;
    let packed = path.extension().is_some_and(|e| e == "gz");
    let stream: Box<dyn Read> = if packed {
        Box::new(MultiGzDecoder::new(file))
    } else {
        Box::new(file)
    };
    let mut records = Vec::new();
    for (i, text) in BufReader::new(stream).lines().enumerate() {
        let text = text.map_err(|cause| DatasetError::Truncated {
            file: path.to_owned(),
            line: i + 1,
            cause,
        })?;
        let record = line::parse(&text, catalogue).map_err(|fault| DatasetError::Line {
            file: path.to_owned(),
            line: i + 1,
            fault,
        })?;
        records.push(record);
    }
    if records.is_empty() {
        return Err(DatasetError::Empty {
            file: path.to_owned(),
        });
    }
    Ok(Set {
        name: name(path),
        records,
    })
}

fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.trim_end_matches(".gz")
        .trim_end_matches(".jsonl")
        .to_owned()
}
