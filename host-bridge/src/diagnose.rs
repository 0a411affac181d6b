//! An error in a file a person wrote: which file, where in it, what is wrong and what to do.

use std::fmt;

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceSpan};

/// An error and what is behind it, in one line.
#[must_use]
pub fn in_full(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text = format!("{text}: {error}");
        cause = error.source();
    }
    text
}

/// What can be wrong with a file, apart from where.
pub trait Problem: std::error::Error + 'static {
    /// What the person can do about it.
    fn remedy(&self) -> String;
}

/// A [`Problem`] with its place.
#[derive(Debug)]
pub struct FileError<P>(Box<Found<P>>);

#[derive(Debug)]
struct Found<P> {
    source: NamedSource<String>,
    place: Option<SourceSpan>,
    problem: P,
}

impl<P: Problem> FileError<P> {
    /// A problem at `place` (bytes) of the file `name` with this `text`; without a place it is about
    /// the file as a whole.
    pub fn new(name: &str, text: &str, place: Option<std::ops::Range<usize>>, problem: P) -> Self {
        Self(Box::new(Found {
            source: NamedSource::new(name, text.to_owned()).with_language("TOML"),
            place: place.map(SourceSpan::from),
            problem,
        }))
    }

    /// What is wrong.
    pub fn problem(&self) -> &P {
        &self.0.problem
    }

    /// What is wrong, without its place.
    pub fn into_problem(self) -> P {
        self.0.problem
    }

    /// The bytes of the file that it is about.
    pub fn place(&self) -> Option<std::ops::Range<usize>> {
        self.0.place.map(|p| p.offset()..p.offset() + p.len())
    }
}

impl<P: Problem> fmt::Display for FileError<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.0.source.name(), self.0.problem)
    }
}

impl<P: Problem> std::error::Error for FileError<P> {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.0.problem.source()
    }
}

impl<P: Problem> Diagnostic for FileError<P> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.0.problem.remedy()))
    }

    fn source_code(&self) -> Option<&dyn miette::SourceCode> {
        self.0
            .place
            .map(|_| &self.0.source as &dyn miette::SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let place = self.0.place?;
        Some(Box::new(std::iter::once(LabeledSpan::underline(place))))
    }
}

/// The names among `known` that `wrong` may have been meant for, as the end of a sentence; empty
/// when none is near.
pub fn did_you_mean<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let lower = wrong.to_lowercase();
    known
        .into_iter()
        .map(|name| (strsim::jaro_winkler(&lower, &name.to_lowercase()), name))
        .filter(|(likeness, _)| *likeness > 0.8)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| format!("did you mean \"{name}\"? "))
        .unwrap_or_default()
}

/// What a field may have been meant for that a parser does not know, from its message, which names it
/// and then all that are known, each in backticks.
pub fn misspelt(message: &str) -> String {
    if !message.starts_with("unknown") {
        return String::new();
    }
    let mut names = message.split('`').skip(1).step_by(2);
    let wrong = names.next().unwrap_or_default();
    did_you_mean(wrong, names)
}

/// Names in quotation marks with commas between them.
pub fn quoted<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<_> = names.into_iter().map(|n| format!("\"{n}\"")).collect();
    if names.is_empty() {
        return "none".to_owned();
    }
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_near_name_is_proposed_and_a_far_one_is_not() {
        let known = ["reachable", "stackable", "glued"];
        assert_eq!(
            did_you_mean("reachabel", known),
            "did you mean \"reachable\"? "
        );
        assert_eq!(did_you_mean("liquid", known), "");
        let message = "unknown field `nam`, expected one of `name`, `words`";
        assert_eq!(misspelt(message), "did you mean \"name\"? ");
        assert_eq!(misspelt("invalid type: integer `3`"), "");
        assert_eq!(quoted(known), "\"reachable\", \"stackable\", \"glued\"");
        assert_eq!(quoted([]), "none");
    }
}
