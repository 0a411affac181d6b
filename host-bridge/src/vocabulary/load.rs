//! From a vocabulary file to a checked [`Lexicon`].

use std::ops::Range;
use std::path::Path;

use deictic_core::category::{BitSet, CategorySet};
use deictic_core::large;
use deictic_core::vocabulary::{Action, Requirement, Signature, VocabularyError};
use toml::Spanned;

use super::entries::{categories, check_name, known, saturate};
use super::error::{Found, VocabularyProblem as Problem};
use super::file::{self, File, Name};
use super::said::{motion_places, said};
use super::{CategoryEntries, Entry, Lexicon, TABLETOP};
use crate::diagnose::FileError;

/// A [`Problem`] with its place in a vocabulary file.
pub type VocabularyFileError = FileError<Problem>;

impl Lexicon {
    /// Reads a vocabulary file.
    ///
    /// # Errors
    /// [`VocabularyFileError`] with the place of the first thing that is wrong.
    pub fn read(path: &Path) -> Result<Self, VocabularyFileError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|e| FileError::new(&name, "", None, Problem::Unreadable(e)))?;
        let mut lexicon = Self::parse(&name, &text)?;
        // A pack of the user's own is beside the vocabulary, and comes before one that is built in.
        if let Some(folder) = path.parent() {
            let stem = lexicon.language.strip_suffix(".toml");
            let beside = stem.unwrap_or(&lexicon.language);
            let beside = folder.join(format!("{beside}.toml"));
            if stem.is_some() || beside.is_file() {
                lexicon.language = beside.display().to_string();
            }
        }
        Ok(lexicon)
    }

    /// The vocabulary that comes with the program.
    ///
    /// # Errors
    /// As [`Lexicon::parse`]; a test holds that there is none.
    pub fn tabletop() -> Result<Self, VocabularyFileError> {
        Self::parse("tabletop.toml", TABLETOP)
    }

    /// The vocabulary that a file called `name` with this `text` describes.
    ///
    /// # Errors
    /// [`VocabularyFileError`] with the place of the first thing that is wrong.
    pub fn parse(name: &str, text: &str) -> Result<Self, VocabularyFileError> {
        let fail = |(place, problem)| FileError::new(name, text, place, problem);
        let file = toml::from_str(text)
            .map_err(|e| fail((e.span(), Problem::Syntax(e.message().to_owned()))))?;
        build(file).map_err(fail)
    }
}

fn build(file: File) -> Found<Lexicon> {
    let categories = categories(&file)?;
    let features = features(&file.features)?;
    let mut actions = Vec::new();
    for action in &file.action {
        actions.push(checked_action(action, &categories, &features)?);
    }
    let names = &categories[0].entries;
    let stop = match &file.stop {
        None => None,
        Some(stop) => Some(index_of(names, stop.as_ref()).ok_or_else(|| {
            let problem = Problem::UnknownStop {
                name: stop.as_ref().clone(),
                known: names.iter().map(|e| e.name.clone()).collect(),
            };
            (Some(stop.span()), problem)
        })?),
    };
    let counts: Vec<u8> = categories[1..]
        .iter()
        .map(|c| saturate(c.entries.len()))
        .collect();
    let fingerprint = fingerprint(&categories, &features, &actions, stop);
    let vocabulary = large::Vocabulary::new(
        &actions,
        &counts,
        saturate(features.len()),
        stop,
        fingerprint,
    )
    .map_err(|e| (place_of(&file, &e), Problem::Refused(e)))?;
    let similarity = super::similarity::load(&file.similarity, &categories)?;
    let said = said(&file)?;
    let motions = file.action.iter().map(|a| {
        let motion = a.motion.as_ref().unwrap_or(&a.name);
        motion.as_ref().clone()
    });
    Ok(Lexicon {
        motions: motions.collect(),
        motion_places: motion_places(&file),
        said,
        name: file.name,
        language_place: file.language.as_ref().map(Spanned::span),
        language: file
            .language
            .map_or_else(|| "en".to_owned(), Spanned::into_inner),
        vocabulary,
        categories,
        features,
        fillers: file.fillers,
        similarity,
    })
}

fn features(names: &[Name]) -> Found<Vec<String>> {
    let mut features: Vec<String> = Vec::new();
    for name in names {
        check_name(name.as_ref(), &name.span())?;
        if features.contains(name.as_ref()) {
            let twice = Problem::Twice {
                category: "feature".to_owned(),
                name: name.as_ref().clone(),
            };
            return Err((Some(name.span()), twice));
        }
        features.push(name.as_ref().clone());
    }
    Ok(features)
}

fn checked_action(
    action: &file::Action,
    categories: &[CategoryEntries],
    features: &[String],
) -> Found<Action> {
    let compulsory = category_set(&action.compulsory, categories, CategorySet::EMPTY)?;
    let voluntary = category_set(&action.voluntary, categories, compulsory)?;
    Ok(Action {
        signature: Signature {
            compulsory,
            voluntary,
        },
        object: requirement(&action.object, features)?,
        storage: requirement(&action.storage, features)?,
    })
}

fn category_set(
    names: &[Name],
    categories: &[CategoryEntries],
    taken: CategorySet,
) -> Found<CategorySet> {
    let mut set = CategorySet::EMPTY;
    for name in names {
        let found = categories[1..]
            .iter()
            .find(|c| c.name == *name.as_ref() && !c.entries.is_empty());
        let Some(found) = found else {
            let problem = Problem::UnknownCategory {
                name: name.as_ref().clone(),
                known: known(&categories[1..]),
            };
            return Err((Some(name.span()), problem));
        };
        let member = found.category.index();
        if taken.union(set).contains(member) {
            let problem = Problem::Contradiction(name.as_ref().clone());
            return Err((Some(name.span()), problem));
        }
        set = set.with(member);
    }
    Ok(set)
}

fn requirement(names: &[Name], features: &[String]) -> Found<Requirement> {
    let (mut wanted, mut unwanted) = (BitSet::EMPTY, BitSet::EMPTY);
    for name in names {
        let (feature, set) = match name.as_ref().strip_prefix('!') {
            Some(feature) => (feature, &mut unwanted),
            None => (name.as_ref().as_str(), &mut wanted),
        };
        let Some(at) = features.iter().position(|f| f == feature) else {
            let problem = Problem::UnknownFeature {
                name: feature.to_owned(),
                known: features.to_vec(),
            };
            return Err((Some(name.span()), problem));
        };
        *set = set.with(at);
        if !wanted.intersection(unwanted).is_empty() {
            let problem = Problem::Contradiction(feature.to_owned());
            return Err((Some(name.span()), problem));
        }
    }
    Ok(Requirement { wanted, unwanted })
}

/// CRC-32 over all names and what every action needs, so that board and host can tell whether they
/// mean the same words.
fn fingerprint(
    categories: &[CategoryEntries],
    features: &[String],
    actions: &[Action],
    stop: Option<u8>,
) -> u32 {
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    let mut digest = crc.digest();
    let mut line = |text: &str| {
        digest.update(text.as_bytes());
        digest.update(b"\n");
    };
    for list in categories {
        line(&format!("category {}", list.name));
        list.entries.iter().for_each(|e| line(&e.name));
    }
    line("features");
    features.iter().for_each(|f| line(f));
    for a in actions {
        let sets = [
            a.signature.compulsory,
            a.signature.voluntary,
            a.object.wanted,
            a.object.unwanted,
            a.storage.wanted,
            a.storage.unwanted,
        ];
        line(&format!("{:x?}", sets.map(|s| s.0)));
    }
    line(&format!("stop {stop:?}"));
    digest.finalize()
}

/// Where in the file the core's complaint belongs.
fn place_of(file: &File, error: &VocabularyError) -> Option<Range<usize>> {
    match error {
        VocabularyError::UnknownCategory { action }
        | VocabularyError::Contradiction { action }
        | VocabularyError::UnknownFeature { action } => {
            file.action.get(usize::from(*action)).map(|a| a.name.span())
        }
        VocabularyError::BadStop => file.stop.as_ref().map(Spanned::span),
        _ => None,
    }
}

fn index_of(entries: &[Entry], name: &str) -> Option<u8> {
    let at = entries.iter().position(|e| e.name == name)?;
    u8::try_from(at).ok()
}
