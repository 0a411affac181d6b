//! Why a text was not understood, and what the person can do about it.

use deictic_core::sentence::SentenceError;

use super::pack::PackProblem;
use crate::diagnose::Problem;

/// The longest text that is taken for one utterance, in bytes: some eight minutes of speech.
pub const LONGEST: usize = 8 * 1024;

/// Why a text was not understood. Nothing of it is executed then.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LanguageError {
    /// No word in it.
    #[error("there is no word in it")]
    Empty,
    /// Not UTF-8.
    #[error("the text is not UTF-8 from byte {at} on")]
    NotText {
        /// The first bad byte.
        at: usize,
    },
    /// Longer than [`LONGEST`].
    #[error("the text has {bytes} bytes, at most {LONGEST} make one utterance")]
    TooLong {
        /// How long it is.
        bytes: usize,
    },
    /// A word that neither the vocabulary nor the language pack has, and that is like none of them.
    #[error("unknown word \"{word}\"")]
    UnknownWord {
        /// As it was said.
        word: String,
        /// Its first byte in the text.
        at: usize,
        /// The nearest known words, the nearest first.
        nearest: Vec<String>,
    },
    /// A quantity, number or place that the vocabulary has no category for.
    #[error(
        "\"{word}\" is {} {category}, which this vocabulary does not have",
        article(category)
    )]
    NoSuchCategory {
        /// As it was said.
        word: String,
        /// What it would be.
        category: String,
    },
    /// A thing named where only other things can go.
    #[error("\"{word}\" is not {} {category}", article(category))]
    WrongPlace {
        /// As it was said.
        word: String,
        /// What is wanted there.
        category: String,
        /// What could be there.
        known: Vec<String>,
    },
    /// A number without a unit, where a number alone says nothing.
    #[error("\"{word}\" has no unit")]
    NoUnit {
        /// As it was said.
        word: String,
    },
    /// A number with a word behind it that is no unit.
    #[error("\"{unit}\" is no unit that is known here")]
    UnknownUnit {
        /// What stands behind the number.
        unit: String,
        /// The units that are known, one word for each.
        known: Vec<String>,
    },
    /// A number that is not finite, or larger than anything on a table.
    #[error("\"{word}\" is out of range")]
    BadQuantity {
        /// As it was said.
        word: String,
    },
    /// More than one value for what an action takes once.
    #[error("\"{word}\" is one {category} too many for one action")]
    Twice {
        /// The one too many, as it was said.
        word: String,
        /// What it is.
        category: String,
    },
    /// Something that the action takes no such thing of.
    #[error("\"{action}\" takes no {category}, and \"{word}\" is one")]
    NotTaken {
        /// As it was said.
        word: String,
        /// What it is.
        category: String,
        /// The action, as it was said.
        action: String,
    },
    /// An option that the vocabulary's category does not have.
    #[error("\"{word}\" is no {category} of this vocabulary")]
    NoSuchOption {
        /// As it was said.
        word: String,
        /// What it would be.
        category: String,
        /// What there is.
        known: Vec<String>,
    },
    /// All things of a name at once.
    #[error("\"{word}\" may be several things, and a command is for one")]
    Several {
        /// As it was said.
        word: String,
    },
    /// A bound, which says how much it is not.
    #[error("\"{word}\" leaves open how much")]
    NotExact {
        /// As it was said.
        word: String,
    },
    /// Digits that may be more than one number.
    #[error("\"{word}\" may be more than one number")]
    UnclearNumber {
        /// As it was said.
        word: String,
    },
    /// More commands than one utterance may queue.
    #[error("{commands} commands in one utterance, at most {limit} are queued")]
    TooManyCommands {
        /// How many there are.
        commands: usize,
        /// How many may be.
        limit: usize,
    },
    /// Heard alternatives of which too many are no commands.
    #[error("\"{text}\" may not have been a command")]
    Unclear {
        /// The likeliest alternative.
        text: String,
    },
    /// What may have been said instead differs in what the hand and the scene do not tell.
    #[error("\"{text}\" may have been another command")]
    OtherCommand {
        /// The likeliest alternative.
        text: String,
    },
    /// The vocabulary asks for a language that no pack was found for.
    #[error("no language pack \"{language}\"")]
    NoPack {
        /// What it asks for.
        language: String,
    },
    /// A language pack that cannot be read.
    #[error("the language pack \"{file}\" is not sound: {}{problem}", at_line(*line))]
    BadPack {
        /// Its file.
        file: String,
        /// The line that it is about, from 1, if it is about one.
        line: Option<usize>,
        /// The bytes of the file that it is about.
        place: Option<std::ops::Range<usize>>,
        /// What is wrong.
        problem: PackProblem,
    },
    /// The core's sentence cannot hold it.
    #[error("the sentence does not fit: {0:?}")]
    Sentence(SentenceError),
}

impl LanguageError {
    /// What the person can do about it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Empty => "say an action and what it is for, as in \"pick the cup\"".into(),
            Self::NotText { .. } => "send UTF-8, one utterance a line".into(),
            Self::TooLong { .. } => "say less at once".into(),
            Self::UnknownWord { nearest, .. } if nearest.is_empty() => {
                "add it to the words or fillers of the vocabulary".into()
            }
            Self::UnknownWord { nearest, .. } => format!(
                "did you mean {}? Other words go into the words or fillers of the vocabulary",
                list(nearest)
            ),
            Self::NoSuchCategory { category, .. } => {
                format!(
                    "leave it out, or add [[parameter]] category = \"{category}\" to the vocabulary"
                )
            }
            Self::WrongPlace { known, .. } => format!("known here: {}", list(known)),
            Self::NoUnit { .. } => "say the unit too, as in \"5 cm\" or \"30 degrees\"".into(),
            Self::UnknownUnit { known, .. } => format!("known units: {}", known.join(", ")),
            Self::BadQuantity { .. } => "give a number below a million".into(),
            Self::Twice { .. } => "say it in a command of its own, one after the other".into(),
            Self::NotTaken { .. } => {
                "say the command without it, if that alone is to be done".into()
            }
            Self::NoSuchOption { known, .. } => format!("known here: {}", list(known)),
            Self::Several { .. } => {
                "name them one by one, as in \"pick the cup and the can\"".into()
            }
            Self::NotExact { .. } => "say how much, as in \"5 cm\"".into(),
            Self::UnclearNumber { .. } => {
                "write thousands without a mark, and a fraction with one: 1000 and 1.5".into()
            }
            Self::TooManyCommands { .. } => "give them a few at a time".into(),
            Self::Unclear { .. } | Self::OtherCommand { .. } => "say it again".into(),
            Self::NoPack { .. } => {
                "use language = \"en\", \"cs\" or the name of a pack's file beside the vocabulary: \"de\" for \
                 de.toml"
                    .into()
            }
            Self::BadPack { problem, .. } => problem.remedy(),
            Self::Sentence(_) => "say it in two sentences".into(),
        }
    }
}

impl Problem for LanguageError {
    fn remedy(&self) -> String {
        self.remedy()
    }
}

/// "line 2: ", or nothing.
fn at_line(line: Option<usize>) -> String {
    line.map_or_else(String::new, |line| format!("line {line}: "))
}

/// "an angle", "a distance".
fn article(noun: &str) -> &'static str {
    match noun.chars().next() {
        Some('a' | 'e' | 'i' | 'o' | 'u') => "an",
        _ => "a",
    }
}

fn list(words: &[String]) -> String {
    let quoted: Vec<_> = words.iter().map(|w| format!("\"{w}\"")).collect();
    quoted.join(", ")
}

impl From<SentenceError> for LanguageError {
    fn from(error: SentenceError) -> Self {
        Self::Sentence(error)
    }
}
