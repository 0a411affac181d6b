//! Where a thing that was named belongs in a command: target or storage, told by the preposition
//! before it, by what its name can be, and by what was named before.

use deictic_core::category::Category;

use super::draft::{Heard, Slot};
use super::drafter::{Between, Drafter};
use super::error::LanguageError;
use super::pack::Role;
use super::read::Piece;

impl Drafter<'_> {
    pub(super) fn thing(&mut self, piece: &Piece) -> Result<(), LanguageError> {
        let preposition = self.preposition.take();
        let between = std::mem::replace(&mut self.between, Between::Nothing);
        // "between the bowl and the drawer"
        let second = self.pair;
        self.pair &= preposition.is_some();
        let beside = second && preposition.is_none() && between != Between::Nothing;
        if preposition == Some(Role::Aside) || beside {
            return Ok(());
        }
        let objects: Vec<_> = piece.names(Category::OBJECT).collect();
        let storages: Vec<_> = piece.names(Category::STORAGE).collect();
        let heard = |options: &[u8]| Heard {
            words: piece.words.clone(),
            options: options.to_vec(),
        };
        let (has_target, has_storage) = self.list.last().map_or((false, false), |d| {
            (d.target.is_some(), d.storage.is_some())
        });
        let listed = between != Between::Nothing && preposition.is_none();
        if listed && self.join(between, &objects, &storages, piece)? {
            return Ok(());
        }
        let wants_storage = preposition == Some(Role::Storage) || has_target;
        if preposition == Some(Role::Storage)
            && let Some(bare) = &self.bare
        {
            return Err(self.not_a(Category::OBJECT, bare));
        }
        if has_storage && objects.is_empty() && self.stored(between, &storages, piece)? {
            return Ok(());
        }
        let slot = match (wants_storage, objects.is_empty(), storages.is_empty()) {
            // "put it into the bowl", "stack the cup box" with a box that is both
            (true, only, false) if !has_storage || only => Slot {
                belief: if only { 1.0 } else { 0.9 },
                instead: (!only).then_some(Category::OBJECT),
                ..Slot::new(Category::STORAGE, vec![heard(&storages)])
            },
            // "push to the cup": a slip of the tongue, as nothing else is there to push
            (true, false, _) if !has_target => Slot {
                belief: 0.6,
                instead: Some(Category::STORAGE),
                ..Slot::new(Category::OBJECT, vec![heard(&objects)])
            },
            (false, false, none) => Slot {
                belief: if none { 1.0 } else { 0.9 },
                instead: (!none).then_some(Category::STORAGE),
                ..Slot::new(Category::OBJECT, vec![heard(&objects)])
            },
            // "push the drawer": only a storage by its name
            (false, true, _) => Slot {
                belief: 0.6,
                instead: Some(Category::OBJECT),
                ..Slot::new(Category::STORAGE, vec![heard(&storages)])
            },
            _ => return Err(self.wrong_place(piece, has_storage)),
        };
        self.last = Some(slot.category);
        self.said.push((slot.category, piece.words.clone()));
        if slot.category == Category::STORAGE && preposition.is_none() && !has_target {
            self.bare = Some(piece.words.clone());
        }
        let draft = self.now();
        if slot.category == Category::STORAGE {
            draft.storage = Some(slot);
        } else {
            draft.target = Some(slot);
        }
        Ok(())
    }

    /// Takes a thing of a list: "the cup and the box", "the cup or the box", "the cup into the bowl
    /// and the box into the drawer".
    fn join(
        &mut self,
        between: Between,
        objects: &[u8],
        storages: &[u8],
        piece: &Piece,
    ) -> Result<bool, LanguageError> {
        let heard = |options: &[u8]| Heard {
            words: piece.words.clone(),
            options: options.to_vec(),
        };
        let twice = self.twice(&piece.words, self.last.unwrap_or(Category::OBJECT));
        let Some(draft) = self.list.last_mut() else {
            return Ok(false);
        };
        let (options, slot) = match self.last {
            Some(Category::STORAGE) if objects.is_empty() => (storages, draft.storage.as_mut()),
            Some(Category::OBJECT) => (objects, draft.target.as_mut()),
            Some(Category::STORAGE) if draft.target.is_some() => (objects, draft.target.as_mut()),
            _ => return Ok(false),
        };
        let Some(slot) = slot.filter(|_| !options.is_empty()) else {
            return Ok(false);
        };
        if between == Between::And {
            let mut next = draft.clone();
            let slot = Slot::new(
                if self.last == Some(Category::STORAGE) && objects.is_empty() {
                    Category::STORAGE
                } else {
                    Category::OBJECT
                },
                vec![heard(options)],
            );
            if slot.category == Category::STORAGE {
                next.storage = Some(slot);
            } else {
                if self.last == Some(Category::STORAGE) {
                    next.storage = None;
                }
                next.target = Some(slot);
                self.last = Some(Category::OBJECT);
            }
            self.list.push(next);
            self.fresh = self.said.len();
        } else if slot.is_pointed() {
            return Err(twice);
        } else {
            slot.heard.push(heard(options));
        }
        Ok(true)
    }

    /// A second storage: "in the drawer or in the bowl" leaves it open, and what was left to the hand may
    /// be named.
    fn stored(
        &mut self,
        between: Between,
        storages: &[u8],
        piece: &Piece,
    ) -> Result<bool, LanguageError> {
        let twice = self.twice(&piece.words, Category::STORAGE);
        let slot = self
            .list
            .last_mut()
            .and_then(|draft| draft.storage.as_mut());
        match slot.filter(|slot| !slot.is_pointed()) {
            None => Ok(false),
            Some(slot) if between == Between::Or => {
                slot.heard.push(Heard {
                    words: piece.words.clone(),
                    options: storages.to_vec(),
                });
                Ok(true)
            }
            Some(_) => Err(twice),
        }
    }

    /// Takes what the hand shows.
    pub(super) fn pointed(
        &mut self,
        category: Category,
        piece: &Piece,
    ) -> Result<(), LanguageError> {
        let preposition = self.preposition.take();
        let storage = category == Category::STORAGE || preposition == Some(Role::Storage);
        if preposition == Some(Role::Aside) {
            return Ok(());
        }
        if let Some(bare) = self.bare.as_ref().filter(|_| storage) {
            return Err(self.not_a(Category::OBJECT, bare));
        }
        let twice = self.twice(&piece.words, category);
        let choice = self.between == Between::Or;
        self.last = Some(if storage {
            Category::STORAGE
        } else {
            Category::OBJECT
        });
        let slot = |category| Slot::new(category, Vec::new());
        let draft = self.now();
        let taken = if storage {
            &draft.storage
        } else {
            &draft.target
        };
        if choice && taken.is_some() {
            return Err(twice);
        }
        if storage {
            draft.storage.get_or_insert(slot(Category::STORAGE));
        } else if draft.target.is_none() {
            draft.target = Some(slot(Category::OBJECT));
        } else {
            draft.storage.get_or_insert(slot(Category::STORAGE));
        }
        Ok(())
    }

    fn wrong_place(&self, piece: &Piece, has_storage: bool) -> LanguageError {
        let category = if has_storage {
            Category::OBJECT
        } else {
            Category::STORAGE
        };
        self.not_a(category, &piece.words)
    }

    fn not_a(&self, category: Category, word: &str) -> LanguageError {
        let entries = self.lexicon.entries(category).iter();
        LanguageError::WrongPlace {
            word: word.to_owned(),
            category: self.lexicon.category_name(category),
            known: entries.map(|e| e.name.clone()).collect(),
        }
    }
}
