//! What people say or type, as sentences of the core.
//!
//! [`understand`] takes a text as it comes ("no, put the mug into the drawer, please") and gives a
//! queue of [`Command`]s, each a core sentence whose likelihoods tell what else the words may have
//! been, and a list of what is *not* to be done: prohibitions, questions, conditions, tales, talk.
//! A word that is not known is an error that names it; nothing of the text is executed then.
//!
//! Names and their synonyms come from the vocabulary, grammar words from a language [`pack`].

mod clause;
mod compose;
mod draft;
mod drafter;
mod error;
mod fill;
mod forms;
mod guess;
pub(crate) mod likeness;
mod mood;
pub mod pack;
mod place;
mod quantity;
mod read;
pub mod speech;
mod split;
mod spoken;
pub mod stream;
mod table;
mod taken;
pub(crate) mod token;
mod utter;

use deictic_core::category::Category;
use deictic_core::large::Sentence;
use unicode_normalization::UnicodeNormalization;

pub use compose::{SetAside, Why};
pub use error::{LONGEST, LanguageError};
pub use likeness::{Ear, Sound};
pub use spoken::Spoken;
pub use token::text_of;
pub use utter::Uncertainty;

use crate::vocabulary::{Entry, Lexicon};
use guess::Guesser;
use pack::Pack;
use read::Piece;
use table::Table;
use utter::Utterer;

/// At most this many commands of one utterance are queued.
pub const QUEUE: usize = 16;

/// How often something wrong may be done of what was heard, unless the user says otherwise.
pub const RISK: f64 = 0.01;

/// One command.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// What the core gets.
    pub sentence: Sentence,
    /// Its bytes in the text.
    pub span: std::ops::Range<usize>,
    /// The categories that were left to the hand: "this", "there".
    pub pointed: Vec<Category>,
    /// Whether it corrects an earlier utterance: "no, the cup".
    pub corrects: bool,
}

impl Command {
    /// The option of a category that was most likely said, if one was.
    #[must_use]
    pub fn best(&self, category: Category) -> Option<u8> {
        let word = self
            .sentence
            .words()
            .iter()
            .find(|w| w.category() == Some(category))?;
        let best = deictic_core::math::argmax(word.likelihoods())?;
        u8::try_from(best).ok()
    }

    /// The quantity of a category, if one was said: metres, radians or a number.
    #[must_use]
    pub fn quantity(&self, category: Category) -> Option<f32> {
        let word = self
            .sentence
            .words()
            .iter()
            .find(|w| w.category() == Some(category))?;
        word.quantity()
    }
}

/// What a text says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Utterance {
    /// What to do, in order; empty when nothing is to be done.
    pub commands: Vec<Command>,
    /// The parts that are not to be done, and why.
    pub aside: Vec<SetAside>,
}

/// Understands one language over one vocabulary. Making it costs as much as a hundred utterances, so
/// keep it.
#[derive(Clone, Debug)]
pub struct Listener<'a> {
    lexicon: &'a Lexicon,
    table: Table,
    guesser: Guesser,
    /// How sure a word is.
    pub uncertainty: Uncertainty,
    /// How often something wrong may be done of what was heard, 0..1; [`RISK`] unless it is set.
    pub risk: f64,
}

impl<'a> Listener<'a> {
    /// With the pack of the vocabulary's language.
    ///
    /// # Errors
    /// As [`Pack::of`].
    pub fn new(lexicon: &'a Lexicon) -> Result<Self, LanguageError> {
        Ok(Self::with_pack(lexicon, Pack::of(lexicon)?))
    }

    /// With another pack.
    #[must_use]
    pub fn with_pack(lexicon: &'a Lexicon, pack: Pack) -> Self {
        let table = Table::new(lexicon, pack);
        let guesser = Guesser::new(&table);
        Self {
            lexicon,
            table,
            guesser,
            uncertainty: Uncertainty::default(),
            risk: RISK,
        }
    }

    /// The grammar words that it goes by.
    #[must_use]
    pub fn pack(&self) -> &Pack {
        self.table.pack()
    }

    /// Understands a text.
    ///
    /// # Errors
    /// [`LanguageError`]; nothing of the text is to be done then.
    pub fn understand(&self, text: &str) -> Result<Utterance, LanguageError> {
        let mut pieces = read::read(&token::tokens(text)?, &self.table)?;
        self.guesser.mend(&mut pieces);
        self.told(&mut pieces, text);
        let clauses = mood::clauses(&pieces, &self.table);
        let plan = compose::compose(&clauses, &self.table, self.lexicon);
        let plan = plan.map_err(|e| self.with_nearest(e, text))?;
        if plan.commands.len() > QUEUE {
            let commands = plan.commands.len();
            return Err(LanguageError::TooManyCommands {
                commands,
                limit: QUEUE,
            });
        }
        let utterer = Utterer {
            lexicon: self.lexicon,
            guesser: &self.guesser,
            uncertainty: self.uncertainty,
        };
        let commands = plan.commands.into_iter().map(|planned| {
            let draft = &planned.draft;
            let slots = [&draft.target, &draft.storage].into_iter().flatten();
            Ok(Command {
                sentence: utterer.sentence(draft)?,
                pointed: slots
                    .filter(|s| s.is_pointed())
                    .map(|s| s.category)
                    .collect(),
                span: planned.span,
                corrects: planned.corrects,
            })
        });
        let mut commands: Vec<Command> = commands.collect::<Result<_, LanguageError>>()?;
        // "me, it!" names nothing and points at nothing.
        commands.retain(|c| !c.sentence.words().is_empty() || !c.pointed.is_empty());
        Ok(Utterance {
            commands,
            aside: plan.aside,
        })
    }

    /// Understands bytes as they come over a line.
    ///
    /// # Errors
    /// As [`Listener::understand`], and [`LanguageError::NotText`] for what is not UTF-8.
    pub fn understand_bytes(&self, bytes: &[u8]) -> Result<Utterance, LanguageError> {
        self.understand(text_of(bytes)?)
    }

    /// Takes verbs that only their accents tell from a command for the forms that they are.
    fn told(&self, pieces: &mut [Piece], text: &str) {
        let endings = &self.pack().endings;
        let written = |text: &str| text.nfc().flat_map(char::to_lowercase).collect::<String>();
        for piece in pieces.iter_mut().filter(|piece| piece.is_action()) {
            let said = written(text.get(piece.span.clone()).unwrap_or_default());
            let verb = said.split_whitespace().next().unwrap_or_default();
            let ends = |ending: &String| verb.ends_with(&written(ending));
            let entries = self.lexicon.entries(Category::ACTION).iter();
            let listed = entries
                .flat_map(Entry::spoken)
                .any(|words| written(&words) == said);
            if endings.told.iter().any(ends) && !listed {
                piece.tell();
            }
        }
    }

    /// Adds the nearest words and the spelling of the text to an error about a word.
    fn with_nearest(&self, error: LanguageError, text: &str) -> LanguageError {
        match error {
            LanguageError::UnknownWord { word, at, .. } => {
                let nearest = self.guesser.nearest(&word);
                LanguageError::UnknownWord {
                    word: as_said(text, at).unwrap_or(word),
                    at,
                    nearest,
                }
            }
            other => other,
        }
    }
}

fn as_said(text: &str, at: usize) -> Option<String> {
    let rest = text.get(at..)?;
    let word: String = rest
        .chars()
        .take_while(|c| c.is_alphanumeric() || *c == '\'')
        .collect();
    (!word.is_empty()).then_some(word)
}

/// Understands one text over a vocabulary, with the built-in pack of its language. A [`Listener`]
/// that is kept is faster.
///
/// # Errors
/// [`LanguageError`]; nothing of the text is to be done then.
pub fn understand(text: &str, lexicon: &Lexicon) -> Result<Utterance, LanguageError> {
    Listener::new(lexicon)?.understand(text)
}
