//! A clause to a draft of a command: which words name the action, the target, the storage and the
//! other parameters, told by their categories, the prepositions before them and their places.

use deictic_core::category::Category;

use super::draft::{Draft, Heard, Slot};
use super::error::LanguageError;
use super::pack::Role;
use super::read::{Piece, What, no_unit};
use super::split::joined;
use super::table::Table;
use crate::vocabulary::Lexicon;

/// What stands between two things.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Between {
    Nothing,
    Comma,
    And,
    Or,
}

/// The commands of one clause: several for "pick the cup and the box".
///
/// # Errors
/// [`LanguageError`] for what has no place in a command.
pub fn drafts(
    pieces: &[Piece],
    temporal: bool,
    table: &Table,
    lexicon: &Lexicon,
) -> Result<Vec<Draft>, LanguageError> {
    let requested = temporal || pieces.iter().any(|p| p.is(Role::Request));
    let mut drafter = Drafter {
        table,
        lexicon,
        list: vec![Draft::default()],
        preposition: None,
        between: Between::Nothing,
        last: None,
        bare: None,
        pair: false,
        said: Vec::new(),
        fresh: 0,
    };
    let verb = verb_of(pieces, requested, table);
    for (i, piece) in pieces.iter().enumerate() {
        let rest = pieces.get(i + 1..).unwrap_or_default();
        if let Some((at, action)) = &verb {
            if *at == i {
                drafter.act(action.clone());
                continue;
            }
            // "stop pushing the box" is about the pushing, which is not done.
            if *at < i && piece.forms().next().is_some() && !piece.is_name() {
                break;
            }
        }
        drafter.take(piece, rest)?;
    }
    drafter.suits(verb.and_then(|(at, heard)| Some((pieces.get(at)?, heard))))?;
    Ok(drafter.finish())
}

/// Which piece names the action, and which: with "up" behind, "pick" may be another one.
fn verb_of(pieces: &[Piece], requested: bool, table: &Table) -> Option<(usize, Heard)> {
    let plain =
        |p: &Piece| (p.is_action() || p.is_head()) && !p.is(Role::Particle) && !p.is(Role::Place);
    let form = |p: &Piece| requested && p.forms().next().is_some();
    let at = pieces.iter().position(plain);
    let at = at.or_else(|| pieces.iter().position(form));
    let at = at.or_else(|| pieces.iter().position(Piece::is_action))?;
    let verb = pieces.get(at)?;
    for later in pieces.get(at + 1..).unwrap_or_default() {
        let whole = joined(verb, later, table);
        if !whole.is_empty() {
            let words = format!("{} {}", verb.words, later.words);
            return Some((
                at,
                Heard {
                    words,
                    options: whole,
                },
            ));
        }
    }
    let mut options: Vec<_> = verb.names(Category::ACTION).collect();
    if options.is_empty() {
        options.extend(verb.forms());
    }
    Some((
        at,
        Heard {
            words: verb.words.clone(),
            options,
        },
    ))
}

pub(super) struct Drafter<'a> {
    pub(super) table: &'a Table,
    pub(super) lexicon: &'a Lexicon,
    pub(super) list: Vec<Draft>,
    pub(super) preposition: Option<Role>,
    pub(super) between: Between,
    /// The category of the slot that was filled last.
    pub(super) last: Option<Category>,
    /// A storage that was named without a preposition, where a thing to act on stands.
    pub(super) bare: Option<String>,
    /// Whether the thing between whose like something is was named, and its like comes next.
    pub(super) pair: bool,
    /// What was said of which category.
    pub(super) said: Vec<(Category, String)>,
    /// How much of that was said before the last draft began.
    pub(super) fresh: usize,
}

impl Drafter<'_> {
    pub(super) fn now(&mut self) -> &mut Draft {
        if self.list.is_empty() {
            self.list.push(Draft::default());
        }
        let last = self.list.len() - 1;
        &mut self.list[last]
    }

    fn act(&mut self, heard: Heard) {
        self.now().action = Some(Slot::new(Category::ACTION, vec![heard]));
        self.preposition = None;
    }

    pub(super) fn has_signature(&self, category: Category) -> bool {
        let action = self.list.last().and_then(|d| d.action.as_ref());
        let options = action
            .into_iter()
            .flat_map(|a| &a.heard)
            .flat_map(|h| &h.options);
        let actions = self.lexicon.vocabulary().actions();
        options
            .filter_map(|&o| actions.get(usize::from(o)))
            .any(|a| {
                a.signature
                    .compulsory
                    .union(a.signature.voluntary)
                    .contains(category.index())
            })
    }

    fn take(&mut self, piece: &Piece, rest: &[Piece]) -> Result<(), LanguageError> {
        match &piece.what {
            // In "the cup, the box and the can" a comma means "and".
            What::Comma if rest.iter().any(|p| p.is(Role::And)) => {
                self.between = self.between_or(Between::And);
            }
            What::Comma => self.between = self.between_or(Between::Comma),
            What::Quantity(kind, value) => self.quantity(piece, *kind, *value)?,
            What::Number(value) => self.number(piece, *value, rest)?,
            What::Known(_) => self.known(piece, rest)?,
            What::Unknown | What::Stop | What::Question => {}
        }
        Ok(())
    }

    fn between_or(&self, weaker: Between) -> Between {
        if self.between == Between::Nothing {
            weaker
        } else {
            self.between
        }
    }

    fn known(&mut self, piece: &Piece, rest: &[Piece]) -> Result<(), LanguageError> {
        let determines = rest
            .iter()
            .find(|p| !p.is(Role::Filler))
            .is_some_and(Piece::is_thing);
        let parameter = self.parameter(piece);
        if piece.is_thing() {
            return self.thing(piece);
        }
        if let Some((category, options)) = parameter
            && (self.has_signature(category) || !piece.is(Role::Particle) && !piece.is(Role::Place))
        {
            let heard = Heard {
                words: piece.words.clone(),
                options,
            };
            self.parameter_slot(Slot::new(category, vec![heard]), piece)?;
            self.preposition = None;
        } else if piece.is(Role::Bound) {
            let next = rest.iter().find(|p| !p.is(Role::Filler));
            let next = next.map_or("", |p| p.words.as_str());
            let word = format!("{} {next}", piece.words).trim_end().to_owned();
            return Err(LanguageError::NotExact { word });
        } else if piece.is(Role::Several) && self.is_several(piece, rest) {
            let next = rest.iter().find(|p| !p.is(Role::Filler));
            let next = next.map_or("", |p| p.words.as_str());
            let word = format!("{} {next}", piece.words);
            return Err(LanguageError::Several { word });
        } else if let Some(category) = self.lacking(piece) {
            return Err(self.no_such_option(piece, category));
        } else if piece.is(Role::Storage) || piece.is(Role::Aside) {
            let role = if piece.is(Role::Storage) {
                Role::Storage
            } else {
                Role::Aside
            };
            self.preposition = Some(role);
            self.pair = piece.is(Role::Pair);
        } else if piece.is(Role::Pointed) && !determines {
            self.pointed(Category::OBJECT, piece)?;
        } else if piece.is(Role::Place) && !determines {
            self.pointed(Category::STORAGE, piece)?;
        } else if piece.is(Role::Again) {
            match self.preposition {
                Some(Role::Storage) => self.pointed(Category::STORAGE, piece)?,
                Some(_) => {}
                None => self.now().again = true,
            }
            self.preposition = None;
        } else if piece.is(Role::And) {
            self.between = Between::And;
        } else if piece.is(Role::Or) {
            self.between = Between::Or;
        }
        Ok(())
    }

    /// The option of a further parameter that a piece names.
    fn parameter(&self, piece: &Piece) -> Option<(Category, Vec<u8>)> {
        let categories = self.lexicon.categories().iter().map(|c| c.category);
        let mut further = categories.filter(|c| *c != Category::ACTION && !c.is_entity());
        further.find_map(|category| {
            let options: Vec<_> = piece.names(category).collect();
            (!options.is_empty() && !self.lexicon.is_quantity_only(category))
                .then_some((category, options))
        })
    }

    fn quantity(&mut self, piece: &Piece, kind: usize, value: f32) -> Result<(), LanguageError> {
        let (name, category) = self.table.kinds.get(kind).cloned().unwrap_or_default();
        let Some(category) = category else {
            return Err(LanguageError::NoSuchCategory {
                word: piece.words.clone(),
                category: name,
            });
        };
        let slot = Slot {
            quantity: Some(value),
            ..Slot::new(category, Vec::new())
        };
        // "under 5 cm", "to 5 cm" says where rather than how far.
        if self.preposition.is_some() && category != Category::AMOUNT {
            let word = piece.words.clone();
            return Err(LanguageError::NotExact { word });
        }
        self.parameter_slot(slot, piece)?;
        self.preposition = None;
        Ok(())
    }

    fn number(&mut self, piece: &Piece, value: f32, rest: &[Piece]) -> Result<(), LanguageError> {
        let kind = self
            .table
            .kinds
            .iter()
            .position(|(name, _)| name == "amount");
        let counted = |p: &Piece| p.is_thing() || value < 1.0 && p.is(Role::Again);
        let counts = rest
            .iter()
            .find(|p| !p.is(Role::Filler))
            .is_some_and(counted);
        match kind {
            Some(kind) if counts || self.has_signature(Category::AMOUNT) => {
                self.quantity(piece, kind, value)
            }
            _ => Err(no_unit(piece, rest, self.table)),
        }
    }

    /// A storage named once at the end is meant for every thing of the list.
    fn finish(mut self) -> Vec<Draft> {
        let shared = self
            .list
            .last()
            .map(|d| (d.storage.clone(), d.others.clone()));
        if let Some((storage, others)) = shared {
            for draft in &mut self.list {
                if draft.storage.is_none() {
                    draft.storage.clone_from(&storage);
                }
                if draft.others.is_empty() {
                    draft.others.clone_from(&others);
                }
            }
        }
        self.list
    }
}
