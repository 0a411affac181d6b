//! Tokens to pieces: phrases with their meanings, quantities in metres, radians or pieces, and words
//! that are not known.

use super::error::LanguageError;
use super::forms::is_negated;
use super::pack::Role;
use super::quantity::{Measured, measure};
use super::table::{Longest, Meaning, Table};
use super::token::{Kind, Token};
use deictic_core::category::Category;

/// What a piece is.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// A known phrase, with all that it can mean.
    Known(Vec<Meaning>),
    /// A quantity: the place of its category's name in [`Table::kinds`], and how much.
    Quantity(usize, f32),
    /// A number without unit.
    Number(f32),
    /// A word that is not known.
    Unknown,
    /// A comma.
    Comma,
    /// The end of a sentence.
    Stop,
    /// A question mark.
    Question,
}

/// A stretch of the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// What it is.
    pub what: What,
    /// Its words, folded.
    pub words: String,
    /// Its bytes in the text.
    pub span: std::ops::Range<usize>,
}

impl Piece {
    /// Whether it can be this grammar word.
    #[must_use]
    pub fn is(&self, role: Role) -> bool {
        matches!(&self.what, What::Known(m) if m.contains(&Meaning::Role(role)))
    }

    /// The options of a category that it can name.
    pub fn names(&self, category: Category) -> impl Iterator<Item = u8> + '_ {
        self.meanings().filter_map(move |m| match m {
            Meaning::Name(c, option) if *c == category => Some(*option),
            _ => None,
        })
    }

    /// The actions it can be a form of.
    pub fn forms(&self) -> impl Iterator<Item = u8> + '_ {
        self.meanings().filter_map(|m| match m {
            Meaning::Form(option) => Some(*option),
            _ => None,
        })
    }

    /// Whether it names anything.
    #[must_use]
    pub fn is_name(&self) -> bool {
        self.meanings().any(|m| matches!(m, Meaning::Name(..)))
    }

    /// Whether it can name an action.
    #[must_use]
    pub fn is_action(&self) -> bool {
        self.names(Category::ACTION).next().is_some()
    }

    /// The category that it would name an option of, if the vocabulary had that option.
    #[must_use]
    pub fn lacks(&self) -> Option<Category> {
        self.meanings().find_map(|m| match m {
            Meaning::Lacking(category) => Some(*category),
            _ => None,
        })
    }

    /// Whether it is the verb of an action whose particle comes later.
    #[must_use]
    pub fn is_head(&self) -> bool {
        self.meanings().any(|m| *m == Meaning::Head)
    }

    /// Whether it can name an object or a storage.
    #[must_use]
    pub fn is_thing(&self) -> bool {
        let mut things = self
            .names(Category::OBJECT)
            .chain(self.names(Category::STORAGE));
        things.next().is_some()
    }

    /// Makes forms of the actions that it names: they are told of, not commanded.
    pub fn tell(&mut self) {
        if let What::Known(meanings) = &mut self.what {
            for meaning in meanings {
                if let Meaning::Name(Category::ACTION, option) = *meaning {
                    *meaning = Meaning::Form(option);
                }
            }
        }
    }

    fn meanings(&self) -> impl Iterator<Item = &Meaning> + '_ {
        match &self.what {
            What::Known(meanings) => meanings.iter(),
            _ => [].iter(),
        }
    }
}

/// Reads tokens.
///
/// # Errors
/// [`LanguageError::BadQuantity`].
pub fn read(tokens: &[Token], table: &Table) -> Result<Vec<Piece>, LanguageError> {
    let mut pieces = Vec::new();
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        let rest = tokens.get(at..).unwrap_or_default();
        let (what, used, known) = match token.kind {
            Kind::Comma => (What::Comma, 1, None),
            Kind::Stop => (What::Stop, 1, None),
            Kind::Question => (What::Question, 1, None),
            Kind::Word => word(rest, table)?,
        };
        let used = rest.get(..used).unwrap_or(rest);
        let said = || used.iter().map(|token| token.text.clone()).collect();
        let words = known.unwrap_or_else(said);
        let end = used.last().map_or(token.span.end, |t| t.span.end);
        pieces.push(Piece {
            what,
            words: words.join(" "),
            span: token.span.start..end,
        });
        at += used.len();
    }
    Ok(pieces)
}

/// What a text begins with, how many tokens that is, and the words of the phrase if they may be others
/// than the tokens: "plechovku" is as surely "plechovka" as that itself.
type Begun = (What, usize, Option<Vec<String>>);

fn word(rest: &[Token], table: &Table) -> Result<Begun, LanguageError> {
    let longest = table.longest(rest);
    let length = longest.as_ref().map_or(0, |known| known.words.len());
    match measure(rest, table)? {
        Some((Measured::Quantity(kind, value), used)) if used >= length => {
            return Ok((What::Quantity(kind, value), used, None));
        }
        Some((Measured::Number(value), used)) if used > length => {
            return Ok((What::Number(value), used, None));
        }
        _ => {}
    }
    Ok(match longest {
        Some(Longest { words, meanings }) => {
            let quantity = meanings.iter().find_map(|m| match m {
                Meaning::Quantity(kind, value) => Some(What::Quantity(*kind, *value)),
                _ => None,
            });
            let plain = |m: &Meaning| {
                use Meaning::{Form, Lacking, Name, Role};
                matches!(m, Name(..) | Role(_) | Form(_) | Lacking(_))
            };
            let plain: Vec<_> = meanings.iter().copied().filter(plain).collect();
            let number = meanings.iter().find_map(|m| match m {
                Meaning::Number(value) => Some(What::Number(*value)),
                _ => None,
            });
            if plain.is_empty() {
                (quantity.or(number).unwrap_or(What::Unknown), length, None)
            } else {
                (What::Known(plain), length, Some(words))
            }
        }
        None => match rest.first() {
            Some(t) if is_negated(&t.text, &table.pack().endings) => {
                (What::Known(vec![Meaning::Role(Role::Not)]), 1, None)
            }
            _ if table.is_head(rest) => (What::Known(vec![Meaning::Head]), 1, None),
            _ => (What::Unknown, 1, None),
        },
    })
}

/// What is wrong with a number that says nothing by itself.
pub fn no_unit(piece: &Piece, rest: &[Piece], table: &Table) -> LanguageError {
    let word = piece.words.clone();
    match rest.first().filter(|next| next.what == What::Unknown) {
        None => LanguageError::NoUnit { word },
        Some(next) => {
            let units = table.pack().unit.iter();
            LanguageError::UnknownUnit {
                unit: next.words.clone(),
                known: units
                    .filter_map(|unit| unit.words.first().cloned())
                    .collect(),
            }
        }
    }
}
